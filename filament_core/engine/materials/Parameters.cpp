// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/materials/Parameters.h"

#include "shaders/package/ParameterLayout.h"

namespace filament::engine {
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

} // namespace

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

} // namespace filament::engine
