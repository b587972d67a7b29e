// SPDX-License-Identifier: Apache-2.0
// Which choices select a program: those of Quality, and how the scene's environment is stored.
#include "filament_core/passes/ShadingKey.h"

#include <gtest/gtest.h>

#include <set>

namespace filament_core::passes {
namespace {

constexpr ShadedLights kAreas{ .hasAreas = true }, kProfiles{ .hasProfiles = true };
constexpr ShadedLights kBoth{ .hasAreas = true, .hasProfiles = true };

uint32_t bitsOf(ShadingKey key, uint32_t id) {
    for (backend::ConstantValue const& constant : shadingConstants(key)) {
        if (constant.id == id) return constant.bits;
    }
    ADD_FAILURE() << "no constant " << id;
    return 0;
}

TEST(ShadingKey, TheDefaultsAreTheProgramAsItWasCompiled) {
    EXPECT_EQ(shadingKey({}), 0);
    for (backend::ConstantValue const& constant : shadingConstants(0)) EXPECT_EQ(constant.bits, 0u);
}

TEST(ShadingKey, WhatIsANumberInAUniformOrAStateOfAPipelineSelectsNoProgram) {
    Quality quality;
    quality.shBands = 1;
    quality.dfgTableSize = 16;
    quality.textureFilter = TextureFilter::Bilinear;
    quality.toneMapping = ToneMapping::Table16;
    quality.depthRange = DepthRange::Ordinary;
    quality.cameraRelative = false;
    EXPECT_EQ(shadingKey(quality), 0);
}

TEST(ShadingKey, EveryStorageOfAnEnvironmentIsAKeyOfItsOwn) {
    std::set<ShadingKey> keys;
    for (const bool isRgbm : { false, true }) {
        for (const RoughnessMapping mapping :
             { RoughnessMapping::Quadratic, RoughnessMapping::Logarithmic, RoughnessMapping::Linear }) {
            const ShadingKey key = shadingKey({}, { .isRgbm = isRgbm, .mapping = mapping });
            EXPECT_EQ(bitsOf(key, shader::kQualityEnvironmentEncoding), isRgbm ? 1u : 0u);
            EXPECT_EQ(bitsOf(key, shader::kQualityRoughnessMapping), static_cast<uint32_t>(mapping));
            keys.insert(key);
        }
    }
    EXPECT_EQ(keys.size(), 6u);
}

TEST(ShadingKey, ProbesSelectAProgramOfLitMaterialsAlone) {
    const ShadingKey key = shadingKey({}, {}, { .probeTerms = shader::kAllProbes });
    EXPECT_EQ(bitsOf(key, shader::kQualityReflectionProbes), 7u);
    EXPECT_EQ(ofUnlit(key), 0);
    EXPECT_EQ(depthOfViewKey(key), 0);
    EXPECT_EQ(ofLights(key), 0);
}

TEST(ShadingKey, AnIrradianceCubeIsReadOnlyWhereThereIsOne) {
    const Quality cube{ .diffuseIrradiance = DiffuseIrradiance::Cube };
    EXPECT_EQ(shadingKey(cube, { .hasIrradianceCube = false }), shadingKey({}));
    EXPECT_EQ(bitsOf(shadingKey(cube, { .hasIrradianceCube = true }), shader::kQualityDiffuseIrradiance),
              static_cast<uint32_t>(DiffuseIrradiance::Cube));
    const Quality harmonics{ .diffuseIrradiance = DiffuseIrradiance::SphericalHarmonics };
    EXPECT_EQ(shadingKey(harmonics, { .hasIrradianceCube = true }), shadingKey({})) << "nobody asked for it";
}

TEST(ShadingKey, AreaLightsAreAKeyOnlyWhereThereAreSome) {
    const Quality points{ .areaLights = AreaLightTerm::RepresentativePoint };
    EXPECT_EQ(shadingKey(points), shadingKey({})) << "no area light, no program of its own";
    EXPECT_EQ(bitsOf(shadingKey({}, {}, kAreas), shader::kQualityAreaLights), 1u);
    EXPECT_EQ(bitsOf(shadingKey(points, {}, kAreas), shader::kQualityAreaLights), 2u);
    const Quality shadowed{ .shadows = ShadowFilter::Pcf5 };
    EXPECT_EQ(withoutLightList(shadingKey(shadowed, {}, kAreas)), shadingKey(shadowed));
    EXPECT_EQ(withoutShadows(shadingKey(shadowed, {}, kAreas)), shadingKey({}, {}, kAreas));
}

TEST(ShadingKey, LightProfilesAreAKeyOnlyWhereThereAreSome) {
    EXPECT_EQ(bitsOf(shadingKey({}, {}, kProfiles), shader::kQualityLightProfiles), 1u);
    EXPECT_EQ(bitsOf(shadingKey({}, {}, kBoth), shader::kQualityAreaLights), 1u);
    const Quality shadowed{ .shadows = ShadowFilter::Pcf5 };
    EXPECT_EQ(withoutLightList(shadingKey(shadowed, {}, kBoth)), shadingKey(shadowed));
    EXPECT_EQ(withoutShadows(shadingKey(shadowed, {}, kProfiles)), shadingKey({}, {}, kProfiles));
}

TEST(ShadingKey, ImagesOfLightsAreAKeyOfProgramsWithALightList) {
    const ShadingKey key = shadingKey({}, {}, { .imageTerms = shader::kLightCookies | shader::kAreaImages });
    EXPECT_EQ(bitsOf(key, shader::kQualityLightImages), 3u);
    EXPECT_EQ(withoutLightList(key), 0) << "a sun with an image is in the list, too";
    EXPECT_EQ(ofLights(key), key);
    EXPECT_EQ(ofUnlit(key), 0);
}

TEST(ShadingKey, EveryTermOfTransparencyIsAKeyAndNoViewHasOne) {
    const ShadingKey key = shadingKey({ .fresnel = FresnelTerm::Exact, .transparency = TransparencyOrder::Peeled });
    EXPECT_EQ(key, shadingKey({ .fresnel = FresnelTerm::Exact })) << "the pass chooses";
    std::set<ShadingKey> keys;
    for (int term = shader::kTransparencyInOrder; term <= shader::kTransparencyBeyond; ++term) {
        const ShadingKey with = withTransparency(key, static_cast<shader::TransparencyTerm>(term));
        EXPECT_EQ(bitsOf(with, shader::kQualityTransparency), static_cast<uint32_t>(term));
        EXPECT_EQ(bitsOf(with, shader::kQualityFresnel), 1u);
        EXPECT_EQ(withTransparency(with, shader::kTransparencyInOrder), key);
        keys.insert(with);
    }
    EXPECT_EQ(keys.size(), 7u);
}

TEST(ShadingKey, AFieldReplacesTheSourceOfDiffuseLightAlone) {
    for (const DiffuseIrradiance source :
         { DiffuseIrradiance::SphericalHarmonics, DiffuseIrradiance::LastSpecularLevel }) {
        const ShadingKey key = shadingKey({ .fresnel = FresnelTerm::Exact, .diffuseIrradiance = source });
        const ShadingKey with = withField(key);
        EXPECT_EQ(bitsOf(with, shader::kQualityDiffuseIrradiance), shader::kIrradianceOfField);
        EXPECT_EQ(bitsOf(with, shader::kQualityFresnel), 1u);
        EXPECT_EQ(with, withField(shadingKey({ .fresnel = FresnelTerm::Exact })));
    }
}

TEST(ShadingKey, MipBiasIsAKeyOfAllSurfacesAndOfTheirDepths) {
    const ShadingKey key = shadingKey({}, {}, {}, { .fogTerms = 3, .hasMipBias = true });
    EXPECT_EQ(bitsOf(key, shader::kQualityMipBias), 1u);
    EXPECT_EQ(bitsOf(ofUnlit(key), shader::kQualityMipBias), 1u);
    EXPECT_EQ(withoutMipBias(key), shadingKey({}, {}, {}, { .fogTerms = 3 }));
    EXPECT_EQ(depthOfViewKey(key), shadingKey({}, {}, {}, { .hasMipBias = true }));
    EXPECT_EQ(shadingKey({ .mipBias = MipBias::Off }), shadingKey({})) << "a number, not a program";
}

TEST(ShadingKey, ShadowsOfShapesAreAKeyOnlyWhereAMapIsReadSo) {
    const Quality shape{ .shadows = ShadowFilter::Pcss, .areaShadows = AreaShadows::Shape };
    const Quality center{ .shadows = ShadowFilter::Pcss };
    EXPECT_EQ(shadingKey(shape, {}, kAreas), shadingKey(center, {}, kAreas)) << "no map of an area";
    const ShadingKey key = shadingKey(shape, {}, { .hasAreas = true, .hasAreaShadows = true });
    EXPECT_EQ(bitsOf(key, shader::kQualityShadowFilter),
              static_cast<uint32_t>(ShadowFilter::Pcss) + shader::kShadowsOfShapes);
    EXPECT_EQ(shadowFilterOf(key), ShadowFilter::Pcss);
    EXPECT_EQ(withoutLightList(key), shadingKey(center)) << "only lights of the list are areas";
    EXPECT_EQ(withoutShadows(key), shadingKey({}, {}, kAreas));
}

TEST(ShadingKey, ColoursOfShadowsAreAKeyOnlyWhereAMapHasThem) {
    const Quality colored{ .coloredShadows = true };
    EXPECT_EQ(shadingKey(colored), shadingKey({})) << "no map with colours, no program of its own";
    const ShadingKey key = shadingKey({}, {}, { .hasColoredShadows = true });
    EXPECT_EQ(bitsOf(key, shader::kQualityColoredShadows), 1u);
    EXPECT_EQ(withoutShadows(key), shadingKey({}));
    EXPECT_EQ(withoutLightList(key), key) << "suns have them, too";
    EXPECT_EQ(bitsOf(depthShadingKey(true), shader::kQualityColoredShadows), 1u);
    EXPECT_EQ(depthShadingKey(false), 0u);
}

} // namespace
} // namespace filament_core::passes
