// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ShadingKey.h"

#include "base/Assert.h"

#include <numeric>

namespace filament::passes {
namespace {

// In the order of shader::kQualityConstants.
constexpr std::array<uint32_t, shader::kQualityConstants.size()> kBits{ 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 1, 1, 4 };
static_assert(std::accumulate(kBits.begin(), kBits.end(), 0u) <= sizeof(ShadingKey) * 8);

// The last of them are those of shadow maps.
static_assert(shader::kQualityConstants.back().id == shader::kQualityShadowFilter &&
              shader::kQualityConstants[kBits.size() - 2].id == shader::kQualityColoredShadows);
constexpr uint32_t kFilterShift = std::accumulate(kBits.begin(), kBits.end() - 1, 0u);
constexpr uint32_t kColoredShift = kFilterShift - kBits[kBits.size() - 2];

constexpr uint32_t maskOf(size_t choice) { return (1u << kBits[choice]) - 1; }

// In the order of shader::kQualityConstants.
std::array<uint32_t, shader::kQualityConstants.size()>
choices(Quality const& quality, scene::EnvironmentStorage const& light, ShadedLights lights) {
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
             static_cast<uint32_t>(quality.anisotropicLookUps),
             lights.hasAreas ? 1 + static_cast<uint32_t>(quality.areaLights) : 0u,
             lights.hasProfiles ? 1u : 0u,
             lights.hasColoredShadows ? 1u : 0u,
             static_cast<uint32_t>(quality.shadows) };
}

} // namespace

ShadingKey shadingKey(Quality const& quality, scene::EnvironmentStorage const& light, ShadedLights lights) {
    uint32_t key = 0, shift = 0;
    const auto chosen = choices(quality, light, lights);
    for (size_t i = 0; i < chosen.size(); ++i) {
        FILAMENT_ASSERT(chosen[i] <= maskOf(i), "a quality choice is one of its enumerators");
        key |= chosen[i] << shift;
        shift += kBits[i];
    }
    return static_cast<ShadingKey>(key);
}

ShadingKey depthShadingKey(bool coloredShadows) { return coloredShadows ? 1u << kColoredShift : 0u; }

ShadingKey withoutShadows(ShadingKey key) { return key & ((1u << kColoredShift) - 1); }

ShadowFilter shadowFilterOf(ShadingKey key) { return static_cast<ShadowFilter>(key >> kFilterShift); }

ShadingKey withoutLightList(ShadingKey key) {
    constexpr size_t kPlace = kBits.size() - 4; // areas, profiles
    static_assert(shader::kQualityConstants[kPlace].id == shader::kQualityAreaLights);
    static_assert(shader::kQualityConstants[kPlace + 1].id == shader::kQualityLightProfiles);
    constexpr uint32_t kShift = std::accumulate(kBits.begin(), kBits.begin() + kPlace, 0u);
    constexpr uint32_t kMask = (1u << (kBits[kPlace] + kBits[kPlace + 1])) - 1;
    return key & ~(kMask << kShift);
}

std::array<backend::ConstantValue, shader::kQualityConstants.size()> shadingConstants(ShadingKey key) {
    std::array<backend::ConstantValue, shader::kQualityConstants.size()> values;
    for (size_t i = 0, shift = 0; i < values.size(); shift += kBits[i++]) {
        values[i] = { .id = shader::kQualityConstants[i].id,
                      .bits = static_cast<uint32_t>(key) >> shift & maskOf(i),
                      .type = backend::ConstantValue::Type::Int };
    }
    return values;
}

} // namespace filament::passes
