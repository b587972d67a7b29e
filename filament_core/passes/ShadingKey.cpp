// SPDX-License-Identifier: Apache-2.0
#include "filament_core/passes/ShadingKey.h"

#include "base/Assert.h"

#include <numeric>

namespace filament_core::passes {
namespace {

// In the order of shader::kQualityConstants.
constexpr std::array<uint32_t, shader::kQualityConstants.size()> kBits{ 2, 1, 1, 1, 2, 2, 1, 2, 1, 3, 2, 2,
                                                                        2, 2, 1, 6, 2, 1, 2, 1, 4, 3, 1, 3 };
static_assert(std::accumulate(kBits.begin(), kBits.end(), 0u) <= 48, "a key and a variant are one number of 64 bits");

constexpr size_t placeOf(uint32_t id) {
    size_t place = 0;
    while (shader::kQualityConstants[place].id != id) ++place;
    return place;
}
constexpr uint32_t shiftOf(uint32_t id) {
    return std::accumulate(kBits.begin(), kBits.begin() + static_cast<std::ptrdiff_t>(placeOf(id)), 0u);
}
constexpr ShadingKey largestOf(size_t place) { return (ShadingKey{ 1 } << kBits[place]) - 1; }
constexpr ShadingKey maskOf(uint32_t id) { return largestOf(placeOf(id)) << shiftOf(id); }

// In the order of shader::kQualityConstants.
std::array<uint32_t, shader::kQualityConstants.size()>
choices(Quality const& quality, scene::EnvironmentStorage const& light, ShadedLights lights, ShadedScreen screen) {
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
             screen.hasBentNormals ? 2u
             : screen.hasOcclusion ? 1u
                                   : 0u,
             !screen.hasRefraction ? 0u
             : screen.showsLevels  ? 2u
                                   : 1u,
             !screen.hasReflections ? 0u
             : screen.showsHits     ? 2u
                                    : 1u,
             lights.hasContactShadows ? 1u : 0u,
             screen.fogTerms,
             lights.hasAreas ? 1 + static_cast<uint32_t>(quality.areaLights) : 0u,
             lights.hasProfiles ? 1u : 0u,
             lights.imageTerms,
             lights.hasColoredShadows ? 1u : 0u,
             static_cast<uint32_t>(quality.shadows) + (lights.hasAreaShadows ? shader::kShadowsOfShapes : 0u),
             0u, // withTransparency()
             screen.hasMipBias ? 1u : 0u,
             lights.probeTerms };
}

} // namespace

ShadingKey shadingKey(Quality const& quality, scene::EnvironmentStorage const& light, ShadedLights lights,
                      ShadedScreen screen) {
    ShadingKey key = 0;
    uint32_t shift = 0;
    const auto chosen = choices(quality, light, lights, screen);
    for (size_t i = 0; i < chosen.size(); ++i) {
        FILAMENT_ASSERT(chosen[i] <= largestOf(i), "a quality choice is one of its enumerators");
        key |= ShadingKey{ chosen[i] } << shift;
        shift += kBits[i];
    }
    return key;
}

ShadingKey depthShadingKey(bool coloredShadows) {
    return coloredShadows ? ShadingKey{ 1 } << shiftOf(shader::kQualityColoredShadows) : ShadingKey{ 0 };
}

ShadingKey depthOfViewKey(ShadingKey key) { return key & maskOf(shader::kQualityMipBias); }

ShadingKey withoutOcclusion(ShadingKey key) { return key & ~maskOf(shader::kQualityScreenOcclusion); }

ShadingKey withField(ShadingKey key) {
    return (key & ~maskOf(shader::kQualityDiffuseIrradiance)) | ShadingKey{ shader::kIrradianceOfField }
                                                                        << shiftOf(shader::kQualityDiffuseIrradiance);
}

ShadingKey withoutRefraction(ShadingKey key) { return key & ~maskOf(shader::kQualityScreenRefraction); }

ShadingKey withoutReflections(ShadingKey key) { return key & ~maskOf(shader::kQualityScreenReflections); }

ShadingKey ofUnlit(ShadingKey key) { return key & (maskOf(shader::kQualityFog) | maskOf(shader::kQualityMipBias)); }

ShadingKey ofLights(ShadingKey key) {
    return key & (maskOf(shader::kQualityAreaLights) | maskOf(shader::kQualityLightProfiles) |
                  maskOf(shader::kQualityLightImages) | maskOf(shader::kQualityColoredShadows) |
                  maskOf(shader::kQualityShadowFilter));
}

ShadingKey ofBoundTextures(ShadingKey key) { return key & maskOf(shader::kQualityReflectionProbes); }

ShadingKey withoutMipBias(ShadingKey key) { return key & ~maskOf(shader::kQualityMipBias); }

ShadingKey withTransparency(ShadingKey key, shader::TransparencyTerm term) {
    return (key & ~maskOf(shader::kQualityTransparency)) | ShadingKey{ term } << shiftOf(shader::kQualityTransparency);
}

ShadingKey withoutShadows(ShadingKey key) {
    return key & ~(maskOf(shader::kQualityColoredShadows) | maskOf(shader::kQualityShadowFilter));
}

ShadowFilter shadowFilterOf(ShadingKey key) {
    const auto choice = static_cast<uint32_t>((key & maskOf(shader::kQualityShadowFilter)) >>
                                              shiftOf(shader::kQualityShadowFilter));
    return static_cast<ShadowFilter>(choice % shader::kShadowsOfShapes);
}

ShadingKey withoutLightList(ShadingKey key) {
    const ShadingKey filter = ShadingKey{ static_cast<uint32_t>(shadowFilterOf(key)) }
                              << shiftOf(shader::kQualityShadowFilter);
    return (key & ~(maskOf(shader::kQualityAreaLights) | maskOf(shader::kQualityLightProfiles) |
                    maskOf(shader::kQualityLightImages) | maskOf(shader::kQualityShadowFilter))) |
           filter;
}

std::array<backend::ConstantValue, shader::kQualityConstants.size()> shadingConstants(ShadingKey key) {
    std::array<backend::ConstantValue, shader::kQualityConstants.size()> values;
    for (size_t i = 0, shift = 0; i < values.size(); shift += kBits[i++]) {
        values[i] = { .id = shader::kQualityConstants[i].id,
                      .bits = static_cast<uint32_t>(key >> shift & largestOf(i)),
                      .type = backend::ConstantValue::Type::Int };
    }
    return values;
}

} // namespace filament_core::passes
