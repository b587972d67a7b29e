// SPDX-License-Identifier: Apache-2.0
#include "tools/materials/MaterialValues.h"

#include "filament_core/base/Result.h"

#include <cmath>
#include <cstdlib>
#include <optional>

namespace filament::tools {
namespace {

using shader::ParameterType;

/// Nothing if one of the words is no number.
std::optional<std::vector<double>> numbersOf(std::string const& words) {
    std::vector<double> numbers;
    for (size_t begin = 0; begin <= words.size();) {
        const size_t end = std::min(words.find(',', begin), words.size());
        const std::string word = words.substr(begin, end - begin);
        char* last = nullptr;
        double number = std::strtod(word.c_str(), &last);
        if (word == "true" || word == "false")
            number = word == "true";
        else if (word.empty() || *last != '\0' || !std::isfinite(number))
            return std::nullopt;
        numbers.push_back(number);
        begin = end + 1;
    }
    return numbers;
}

size_t componentsOf(ParameterType type) {
    if (type == ParameterType::Float3x3) return 9;
    if (type == ParameterType::Float4x4) return 16;
    return (static_cast<size_t>(type) - static_cast<size_t>(ParameterType::Bool)) % 4 + 1;
}

template <class V, class Scalar>
V vectorOf(const double* numbers) {
    V value{};
    for (int i = 0; i < V::length(); ++i) value[i] = static_cast<Scalar>(numbers[i]);
    return value;
}

template <class M>
M matrixOf(const double* numbers) {
    M value{};
    for (int column = 0; column < M::length(); ++column) {
        for (int row = 0; row < M::length(); ++row)
            value[column][row] = static_cast<float>(numbers[column * M::length() + row]);
    }
    return value;
}

/// Nothing for types that the engine does not take alone.
std::optional<ParameterValue> valueOf(ParameterType type, const double* numbers) {
    switch (type) {
    case ParameterType::Bool:
        return numbers[0] != 0;
    case ParameterType::Int:
        return static_cast<int32_t>(numbers[0]);
    case ParameterType::Uint:
        return static_cast<uint32_t>(numbers[0]);
    case ParameterType::Float:
        return static_cast<float>(numbers[0]);
    case ParameterType::Float2:
        return vectorOf<float2, float>(numbers);
    case ParameterType::Float3:
        return vectorOf<float3, float>(numbers);
    case ParameterType::Float4:
        return vectorOf<float4, float>(numbers);
    case ParameterType::Float3x3:
        return matrixOf<float3x3>(numbers);
    case ParameterType::Float4x4:
        return matrixOf<float4x4>(numbers);
    default:
        return std::nullopt;
    }
}

} // namespace

Result<void> setMaterialValue(Engine& engine, MaterialInstance instance, shader::Parameter const& parameter,
                              std::string const& words) {
    const size_t wanted = componentsOf(parameter.type) * std::max(parameter.arraySize, 1u);
    const auto numbers = numbersOf(words);
    if (!numbers || numbers->size() != wanted) {
        return fail(ErrorCode::InvalidArgument, "parameter '{}' takes {} number{}, not '{}'", parameter.name, wanted,
                    wanted == 1 ? "" : "s, separated by commas", words);
    }
    const std::optional<ParameterValue> value =
            parameter.arraySize == 0 ? valueOf(parameter.type, numbers->data()) : std::nullopt;
    if (!value)
        return fail(ErrorCode::Unsupported, "parameter '{}': this type cannot be given in words", parameter.name);
    return engine.set(instance, parameter.name, *value);
}

Result<std::vector<MaterialConstant>> materialConstants(shader::MaterialPackage const& package,
                                                        MaterialValues const& values) {
    using Type = backend::ConstantValue::Type;
    std::vector<MaterialConstant> constants;
    for (auto const& [name, words] : values) {
        shader::Constant const* constant = package.findConstant(name);
        if (!constant) continue;
        const auto numbers = numbersOf(words);
        if (!numbers || numbers->size() != 1)
            return fail(ErrorCode::InvalidArgument, "constant '{}': '{}' is not a number", name, words);
        const double number = numbers->front();
        switch (constant->type) {
        case Type::Bool:
            constants.push_back({ name, number != 0 });
            break;
        case Type::Int:
            constants.push_back({ name, static_cast<int32_t>(number) });
            break;
        default:
            constants.push_back({ name, static_cast<float>(number) });
            break;
        }
    }
    return constants;
}

} // namespace filament::tools
