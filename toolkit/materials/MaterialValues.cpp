// SPDX-License-Identifier: Apache-2.0
#include "toolkit/materials/MaterialValues.h"

#include "base/NumberText.h"
#include "base/Result.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <type_traits>
#include <variant>

namespace filament_core::tools {
namespace {

/// Returns nothing if a word is not a number.
std::optional<std::vector<double>> numbersOf(std::string const& words) {
    std::vector<double> numbers;
    for (size_t begin = 0; begin <= words.size();) {
        const size_t end = std::min(words.find(',', begin), words.size());
        std::string_view word = std::string_view(words).substr(begin, end - begin);
        word.remove_prefix(std::min(word.find_first_not_of(' '), word.size()));
        const bool isTruth = word == "true" || word == "false";
        const std::optional<double> number = isTruth ? (word == "true" ? 1.0 : 0.0) : numberOf<double>(word);
        if (!number || !std::isfinite(*number)) return std::nullopt;
        numbers.push_back(*number);
        begin = end + 1;
    }
    return numbers;
}

size_t componentsOf(ParameterType type) {
    if (type == ParameterType::Float3x3) return 9;
    if (type == ParameterType::Float4x4) return 16;
    return (static_cast<size_t>(type) - static_cast<size_t>(ParameterType::Bool)) % 4 + 1;
}

template <class T>
T elementOf(const double* numbers) {
    if constexpr (std::is_same_v<T, bool>) {
        return *numbers != 0;
    } else if constexpr (std::is_arithmetic_v<T>) {
        return static_cast<T>(*numbers);
    } else { // components of a vector, columns of a matrix
        using Part = std::remove_cvref_t<decltype(std::declval<T&>()[0])>;
        constexpr auto kLength = static_cast<size_t>(T::length());
        const size_t stride = std::is_arithmetic_v<Part> ? 1 : kLength; // matrices are square
        T value{};
        for (size_t i = 0; i < kLength; ++i) value[static_cast<int>(i)] = elementOf<Part>(numbers + i * stride);
        return value;
    }
}

/// The alternatives of ParameterValue are in the order of ParameterType.
template <size_t Type>
Result<void> setAs(Engine& engine, MaterialInstance instance, shader::Parameter const& parameter,
                   std::vector<double> const& numbers) {
    using T = std::variant_alternative_t<Type, ParameterValue>;
    if (parameter.arraySize == 0)
        return engine.set(instance, parameter.name, ParameterValue(elementOf<T>(numbers.data())));
    for (uint32_t i = 0; i < parameter.arraySize; ++i) {
        const T value = elementOf<T>(numbers.data() + i * componentsOf(parameter.type));
        const Result<void> done = engine.set(instance, parameter.name, ParameterArray(std::span(&value, 1)), i);
        if (!done) return done;
    }
    return {};
}

template <size_t... Types>
Result<void> setAsType(Engine& engine, MaterialInstance instance, shader::Parameter const& parameter,
                       std::vector<double> const& numbers, std::index_sequence<Types...>) {
    Result<void> done;
    const auto type = static_cast<size_t>(parameter.type);
    (void)((Types == type && (done = setAs<Types>(engine, instance, parameter, numbers), true)) || ...);
    return done;
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
    return setAsType(engine, instance, parameter, *numbers,
                     std::make_index_sequence<std::variant_size_v<ParameterValue>>());
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

} // namespace filament_core::tools
