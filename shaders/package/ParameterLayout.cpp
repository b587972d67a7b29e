// SPDX-License-Identifier: Apache-2.0
#include "shaders/package/ParameterLayout.h"

#include <algorithm>

namespace filament_core::shader {
namespace {

constexpr uint32_t kVectorBytes = 16;

constexpr uint32_t roundUp(uint32_t value, uint32_t multiple) { return (value + multiple - 1) / multiple * multiple; }

} // namespace

bool isTexture(ParameterType type) { return type >= ParameterType::Sampler2D; }

uint32_t valueBytes(ParameterType type) {
    if (isTexture(type)) return 0;
    if (type == ParameterType::Float3x3) return 3 * kVectorBytes;
    if (type == ParameterType::Float4x4) return 4 * kVectorBytes;
    return 4 * (1 + static_cast<uint32_t>(type) % 4); // Bool..Uint4 are four families of 1 to 4 components
}

uint32_t valueAlignment(ParameterType type) {
    const uint32_t bytes = valueBytes(type);
    return bytes == 12 ? kVectorBytes : std::min(bytes, kVectorBytes);
}

uint32_t arrayStride(ParameterType type) { return roundUp(valueBytes(type), kVectorBytes); }

uint64_t parameterBytes(Parameter const& parameter) {
    if (parameter.arraySize == 0) return valueBytes(parameter.type);
    return uint64_t{ arrayStride(parameter.type) } * parameter.arraySize;
}

uint32_t assignOffsets(std::span<Parameter> parameters) {
    uint32_t end = 0;
    for (Parameter& parameter : parameters) {
        parameter.offset = 0;
        if (isTexture(parameter.type)) continue;
        end = roundUp(end, parameter.arraySize > 0 ? kVectorBytes : valueAlignment(parameter.type));
        parameter.offset = end;
        end += static_cast<uint32_t>(parameterBytes(parameter));
    }
    return roundUp(end, kVectorBytes);
}

} // namespace filament_core::shader
