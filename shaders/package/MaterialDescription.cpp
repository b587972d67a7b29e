// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Material.h>

#include <algorithm>
#include <array>

namespace filament_core {
namespace {

// In the order of the enumerators.
// clang-format off
constexpr std::array kParameterTypes{
    "bool", "bool2", "bool3", "bool4", "float", "float2", "float3", "float4", "int", "int2", "int3", "int4", "uint",
    "uint2", "uint3", "uint4", "float3x3", "float4x4", "sampler2d", "sampler2dArray", "samplerCubemap",
    "subpassInput", "samplerCubemapArray", "sampler2dMS", "sampler3d"
};
// clang-format on

// In the order of the bits.
constexpr std::array kVariants{
    "directionalLighting", "dynamicLighting", "shadowReceiver", "skinning", "fog", "vsm", "ssr", "stereo"
};

} // namespace

const char* toString(ParameterType type) { return kParameterTypes[static_cast<size_t>(type)]; }

std::string toString(VariantSet variants) {
    std::string names;
    for (size_t bit = 0; bit < kVariants.size(); ++bit) {
        if ((static_cast<uint16_t>(variants) & 1u << bit) == 0) continue;
        names += (names.empty() ? "" : ", ") + std::string(kVariants[bit]);
    }
    return names.empty() ? "none" : names;
}

ParameterDescription const* MaterialDescription::findParameter(std::string_view parameter) const {
    const auto found = std::ranges::find(parameters, parameter, &ParameterDescription::name);
    return found == parameters.end() ? nullptr : &*found;
}

} // namespace filament_core
