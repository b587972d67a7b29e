// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/materials/Parameters.h"

#include "shaders/package/ParameterLayout.h"

#include <cmath>
#include <optional>
#include <utility>

namespace filament_core::engine {
namespace {

using shader::Parameter;

// The alternatives of ParameterValue and ParameterArray are in the order of ParameterType.
static_assert(std::variant_size_v<ParameterValue> == static_cast<size_t>(ParameterType::Float4x4) + 1);
static_assert(std::variant_size_v<ParameterArray> == std::variant_size_v<ParameterValue>);

template <class Variant>
ParameterType typeOf(Variant const& value) {
    return static_cast<ParameterType>(value.index());
}

std::string declared(Parameter const& parameter) {
    const char* const type = toString(parameter.type);
    return parameter.arraySize > 0 ? fmt::format("{}[{}]", type, parameter.arraySize) : type;
}

Result<void> checkKind(scene::Material const& material, Parameter const& parameter, ParameterType given, bool isArray) {
    if (parameter.type == given && (parameter.arraySize > 0) == isArray) return {};
    if (shader::isTexture(parameter.type)) {
        return fail(ErrorCode::InvalidArgument, "parameter '{}' of material '{}' is {}: give it a texture, not {}",
                    parameter.name, material.name, toString(parameter.type), toString(given));
    }
    return fail(ErrorCode::InvalidArgument, "parameter '{}' of material '{}' is {}, but was given {}{}", parameter.name,
                material.name, declared(parameter), isArray ? "an array of " : "", toString(given));
}

const char* typeName(int64_t) { return "int"; }
const char* typeName(uint64_t) { return "uint"; }
const char* typeName(double) { return "double"; }

/// Integers exactly, others rounded; none: it is too large.
template <class Number>
std::optional<float> asFloat(Number number) {
    const auto rounded = static_cast<float>(number);
    if constexpr (std::is_floating_point_v<Number>)
        return std::isfinite(number) && !std::isfinite(rounded) ? std::nullopt : std::optional(rounded);
    else // a float of 2^63 or 2^64 is beyond the integers
        return rounded < 9.2e18f && static_cast<Number>(rounded) == number ? std::optional(rounded) : std::nullopt;
}

template <class Integer, class Number>
std::optional<Integer> asInteger(Number number) {
    if constexpr (std::is_integral_v<Number>)
        if (std::in_range<Integer>(number)) return static_cast<Integer>(number);
    return std::nullopt;
}

/// None: a parameter of this type takes no such number.
template <class Number>
std::optional<ParameterValue> converted(ParameterType type, Number number) {
    const auto value = [](auto const& found) { return found ? std::optional<ParameterValue>(*found) : std::nullopt; };
    if (type == ParameterType::Float) return value(asFloat(number));
    if (type == ParameterType::Int) return value(asInteger<int32_t>(number));
    if (type == ParameterType::Uint) return value(asInteger<uint32_t>(number));
    return std::nullopt;
}

bool takes(ParameterType type, ParameterNumber const& number) {
    const bool isWhole = !std::holds_alternative<double>(number);
    return type == ParameterType::Float || (isWhole && (type == ParameterType::Int || type == ParameterType::Uint));
}

} // namespace

Result<void> writeNumber(scene::Material const& material, Parameter const& parameter, ParameterNumber const& number,
                         std::span<std::byte> block) {
    return std::visit(
            [&](auto const& given) -> Result<void> {
                if (!takes(parameter.type, number) || parameter.arraySize > 0)
                    return fail(ErrorCode::InvalidArgument, "parameter '{}' of material '{}' is {}, but was given {}",
                                parameter.name, material.name, declared(parameter), typeName(given));
                const std::optional<ParameterValue> value = converted(parameter.type, given);
                if (!value)
                    return fail(ErrorCode::InvalidArgument,
                                "parameter '{}' of material '{}' is {}, which cannot hold {}", parameter.name,
                                material.name, declared(parameter), given);
                return writeParameter(material, parameter, *value, block);
            },
            number);
}

Result<void> writeParameter(scene::Material const& material, Parameter const& parameter, ParameterValue const& value,
                            std::span<std::byte> block) {
    if (Result<void> fits = checkKind(material, parameter, typeOf(value), false); !fits) return fits;
    std::visit([&](auto const& v) { shader::storeValue(block.data() + parameter.offset, v); }, value);
    return {};
}

Result<void> writeParameters(scene::Material const& material, Parameter const& parameter, ParameterArray const& values,
                             uint32_t first, std::span<std::byte> block) {
    if (Result<void> fits = checkKind(material, parameter, typeOf(values), true); !fits) return fits;
    const size_t count = std::visit([](auto const& v) { return v.size(); }, values);
    if (first > parameter.arraySize || count > parameter.arraySize - first) {
        return fail(ErrorCode::InvalidArgument,
                    "parameter '{}' of material '{}' is {}: {} values from element {} on are too many", parameter.name,
                    material.name, declared(parameter), count, first);
    }
    const uint32_t stride = shader::arrayStride(parameter.type);
    std::byte* to = block.data() + parameter.offset + static_cast<size_t>(first) * stride;
    std::visit(
            [&](auto const& v) {
                for (auto const& element : v) {
                    shader::storeValue(to, element);
                    to += stride;
                }
            },
            values);
    return {};
}

} // namespace filament_core::engine
