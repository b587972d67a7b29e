// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ShadingKey.h"

#include "base/Assert.h"

namespace filament::passes {
namespace {

constexpr uint32_t kBitsOfAChoice = 2;
constexpr uint32_t kMask = (1u << kBitsOfAChoice) - 1;
static_assert(shader::kQualityConstants.size() * kBitsOfAChoice <= sizeof(ShadingKey) * 8);

// In the order of shader::kQualityConstants.
std::array<uint32_t, shader::kQualityConstants.size()> choices(Quality const& quality,
                                                               scene::EnvironmentStorage const& light) {
    const bool lacksCube = quality.diffuseIrradiance == DiffuseIrradiance::Cube && !light.hasIrradianceCube;
    const DiffuseIrradiance irradiance = lacksCube ? DiffuseIrradiance::SphericalHarmonics : quality.diffuseIrradiance;
    return { static_cast<uint32_t>(quality.specularVisibility),
             static_cast<uint32_t>(quality.fresnel),
             static_cast<uint32_t>(quality.diffuse),
             quality.energyCompensation ? 0u : 1u,
             static_cast<uint32_t>(quality.splitSum),
             static_cast<uint32_t>(irradiance),
             light.isRgbm ? 1u : 0u,
             static_cast<uint32_t>(light.mapping),
             quality.diffuseCoupling ? 0u : 1u,
             static_cast<uint32_t>(quality.specularLookUps),
             static_cast<uint32_t>(quality.anisotropicLookUps) };
}

} // namespace

ShadingKey shadingKey(Quality const& quality, scene::EnvironmentStorage const& light) {
    uint32_t key = 0, shift = 0;
    for (const uint32_t choice : choices(quality, light)) {
        FILAMENT_ASSERT(choice <= kMask, "a quality choice is one of its enumerators");
        key |= choice << shift;
        shift += kBitsOfAChoice;
    }
    return static_cast<ShadingKey>(key);
}

std::array<backend::ConstantValue, shader::kQualityConstants.size()> shadingConstants(ShadingKey key) {
    std::array<backend::ConstantValue, shader::kQualityConstants.size()> values;
    for (size_t i = 0; i < values.size(); ++i) {
        values[i] = { .id = shader::kQualityConstants[i].id,
                      .bits = static_cast<uint32_t>(key) >> (i * kBitsOfAChoice) & kMask,
                      .type = backend::ConstantValue::Type::Int };
    }
    return values;
}

} // namespace filament::passes
