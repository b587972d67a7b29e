// SPDX-License-Identifier: Apache-2.0
// Cloth, subsurface and custom shading as images: the same bits on both APIs, and colours that follow from the
// model's physics by simple arithmetic.
#include "filament_core/assets/tables/DfgTable.h"
#include "tests/filament_core/engine/SkyStage.h"

#include <algorithm>
#include <cmath>

namespace filament_core {
namespace {

using test::centerPixel;
using test::expectFurnace;
using test::expectNear;
using test::halfPixel;
using test::kDirectionSky;
using test::kSunOnly;
using test::MaterialStage;
using test::onBothApis;
using test::seenOnSphere;
using test::text;

// ------------------------------------------------------------------------------------------ cloth

constexpr std::string_view kCloth = "shadingModel : cloth";

TEST(ClothModel, GainsNothingInAWhiteFurnace) {
    for (const float roughness : { 0.1f, 0.4f, 0.7f, 1.0f }) {
        const std::string code = fmt::format("material.roughness = {:.1f};", roughness);
        expectFurnace(text(kCloth, code), 0.97f);
        expectFurnace(text(kCloth, code + "material.subsurfaceColor = vec3(1.0, 0.5, 0.0);"), 0.5f);
        expectFurnace(text(kCloth, code + "material.sheenColor = vec3(0.0);"), 0.99f);
    }
}

TEST(ClothModel, TheSheenIsTheRootOfTheBaseColorUnlessItIsSaid) {
    const std::string base = "material.baseColor.rgb = vec3(0.04, 0.25, 0.64); material.roughness = 0.5;";
    const Image unsaid = seenOnSphere(text(kCloth, base), kDirectionSky);
    const Image said = seenOnSphere(text(kCloth, base + "material.sheenColor = vec3(0.2, 0.5, 0.8);"), kDirectionSky);
    const Image black = seenOnSphere(text(kCloth, base + "material.sheenColor = vec3(0.0);"), kDirectionSky);
    for (uint32_t i = 0; i < 32; ++i) expectNear(halfPixel(unsaid, i, 16), float3(halfPixel(said, i, 16)), 1e-3f);
    EXPECT_NE(unsaid.pixels, black.pixels);
}

/// Radiance at the middle of a square under a sun of illuminance 1, given the cosine of the sun and the square's
/// normal.
float4 underSun(std::string const& material, float cosine) {
    return centerPixel(onBothApis([&](MaterialStage& stage) {
        stage.view.size = { 9, 9 };
        stage.add(stage.material(material, kSunOnly), { {} });
        stage.scene.add(SunLight{ .directionWorld = { -std::sqrt(1 - cosine * cosine), 0, -cosine },
                                  .illuminance = Lux{ 1 / stage.view.camera.exposure.factor() } });
    }));
}

TEST(ClothModel, SubsurfaceColorLetsLightReachAroundTheEdge) {
    const std::string base = "material.sheenColor = vec3(0.0);";
    EXPECT_EQ(underSun(text(kCloth, base), -0.2f).x, 0.0f);
    EXPECT_NEAR(underSun(text(kCloth, base), 1.0f).x, 0.3183099f, 1e-3f) << "Lambert";
    const std::string tinted = text(kCloth, base + "material.subsurfaceColor = vec3(0.8, 0.4, 0.0);");
    const float wrapped = (-0.2f + 0.5f) / 2.25f * 0.3183099f; // cloth.glsl
    expectNear(underSun(tinted, -0.2f), float3(0.8f, 0.4f, 0) * wrapped, 1e-4f);
    EXPECT_EQ(underSun(tinted, -0.6f).x, 0.0f) << "but not further";
}

TEST(ClothModel, AshikhminsVelvetIsAChoiceThatAlsoShinesFromAbove) {
    const std::string_view velvet = "shadingModel : cloth, clothDistribution : ashikhmin";
    const std::string code = "material.baseColor.rgb = vec3(0.0); material.roughness = 0.5; "
                             "material.sheenColor = vec3(1.0);";
    const float expected = 1 / (1 + 4 * 0.0625f) / 3.14159265f * 0.25f; // sheen.glsl at the pole, Neubelt's 1/4
    EXPECT_NEAR(underSun(text(velvet, code), 1.0f).x, expected, 1e-3f);
    EXPECT_LT(underSun(text(kCloth, code), 1.0f).x, 0.1f * expected);
    for (const float roughness : { 0.1f, 0.4f, 0.7f, 1.0f })
        expectFurnace(text(velvet, fmt::format("material.roughness = {:.1f};", roughness)), 0.97f);
}

TEST(ClothModel, FibresShineWhereTheyAreSeenAndLitFromTheSide) {
    const std::string velvet = text(kCloth, "material.baseColor.rgb = vec3(0.0); material.roughness = 0.5; "
                                            "material.sheenColor = vec3(1.0, 0.5, 0.25);");
    const float4 facing = underSun(velvet, 1.0f), grazing = underSun(velvet, 0.2f);
    EXPECT_LT(facing.x, 1e-3f) << "no fibre stands across";
    EXPECT_GT(grazing.x, 0.005f);
    EXPECT_NEAR(grazing.y, grazing.x * 0.5f, 1e-3f);
    EXPECT_NEAR(grazing.z, grazing.x * 0.25f, 1e-3f);
}

// ------------------------------------------------------------------------------------------ subsurface

constexpr std::string_view kSubsurface = "shadingModel : subsurface";

TEST(SubsurfaceModel, GainsNothingInAWhiteFurnace) {
    for (const float thickness : { 0.0f, 0.5f, 2.0f }) {
        for (const float roughness : { 0.2f, 1.0f }) {
            expectFurnace(text(kSubsurface, fmt::format("material.roughness = {:.1f}; material.thickness = {:.1f};",
                                                        roughness, thickness)),
                          0.97f);
        }
    }
    expectFurnace(text(kSubsurface, "material.metallic = 1.0; material.roughness = 0.3;"), 0.97f);
}

TEST(SubsurfaceModel, WhereItIsThickItIsTheStandardModel) {
    const std::string code = "material.baseColor.rgb = vec3(0.2, 0.5, 0.8); material.roughness = 0.4;";
    const Image lit = seenOnSphere(text("", code), kDirectionSky);
    const Image thick = seenOnSphere(text(kSubsurface, code + "material.thickness = 20.0;"), kDirectionSky);
    for (uint32_t i = 0; i < 32; ++i) expectNear(halfPixel(thick, i, 16), float3(halfPixel(lit, i, 16)), 1e-3f);
}

TEST(SubsurfaceModel, ALightBehindShinesThroughTheThinnerTheMoreAndInTheSubsurfaceColor) {
    const auto behind = [](float thickness, float power) {
        return underSun(text(kSubsurface, fmt::format("material.subsurfaceColor = vec3(1.0, 0.5, 0.25); "
                                                      "material.subsurfacePower = {:.1f}; material.thickness = {:.2f};",
                                                      power, thickness)),
                        -1.0f);
    };
    const float2 dfg = assets::integrateDfg(1, 1);
    const float left = 1 - glm::mix(dfg.x, dfg.y, 0.04f) * (1 + 0.04f * (1 / dfg.y - 1)); // by the specular lobe
    // subsurface.glsl: half of it continues straight, in a lobe of which 2^(p (cos - 1)) remains.
    const auto expected = [left](float thickness, float power) {
        const float through = std::exp2(-2 * thickness);
        const float x = power * std::log(2.0f);
        const float integral = (1 - std::exp(-x)) / x + std::exp2(-power);
        return left * through * 0.5f * (0.1591549f / integral); // nothing wraps around from right behind
    };
    for (const float thickness : { 0.25f, 0.5f, 1.0f, 2.0f }) {
        for (const float power : { 2.0f, 12.0f }) {
            const float4 seen = behind(thickness, power);
            const float strength = expected(thickness, power);
            expectNear(seen, float3(1, 0.5f, 0.25f) * strength, 2e-3f * std::max(1.0f, strength));
        }
    }
    EXPECT_EQ(behind(20.0f, 12.0f).x, 0.0f);
}

// ------------------------------------------------------------------------------------------ custom

/// The guide's own example, section 4.4.3.
std::string toon(std::string_view visible = "") {
    return fmt::format(R"(material {{ name : Toon, shadingModel : lit, customSurfaceShading : true,
    parameters : [ {{ type : float3, name : baseColor }} ] }}
fragment {{
    void material(inout MaterialInputs material) {{
        prepareMaterial(material);
        material.baseColor.rgb = materialParams.baseColor;
    }}
    vec3 surfaceShading(
            const MaterialInputs materialInputs,
            const ShadingData shadingData,
            const LightData lightData
    ) {{
        const float shades = 5.0;
        const float ambient = 0.1;
        float toon = max(ceil(lightData.NdotL * shades) / shades, ambient);
        toon *= lightData.visibility * lightData.attenuation;
        vec3 light = lightData.colorIntensity.rgb * lightData.colorIntensity.w;
        {}
        return shadingData.diffuseColor * light * toon;
    }}
}})",
                       visible);
}

template <class Light>
float4 toonUnder(Light const& light, std::string const& material = toon()) {
    return centerPixel(onBothApis([&](MaterialStage& stage) {
        stage.view.size = { 9, 9 };
        const MaterialInstance instance = stage.material(material);
        if (!instance) return;
        const Result<void> done = stage.engine.set(instance, "baseColor", float3(0.5f, 0.25f, 0.125f));
        EXPECT_TRUE(done) << (done ? "" : done.error().message);
        stage.add(instance, { {} });
        stage.scene.add(light);
    }));
}

const float kUnit = 1 / Exposure{}.factor(); // of light: pre-exposed, it is 1

TEST(CustomShading, TheGuidesToonHasFiveShadesUnderASunAndItsAmbientBehind) {
    const auto sun = [](float cosine) {
        return SunLight{ .directionWorld = { -std::sqrt(1 - cosine * cosine), 0, -cosine },
                         .illuminance = Lux{ kUnit } };
    };
    const float3 base(0.5f, 0.25f, 0.125f);
    expectNear(toonUnder(sun(0.99f)), base, 1e-3f);
    expectNear(toonUnder(sun(0.5f)), base * 0.6f, 1e-3f);
    expectNear(toonUnder(sun(0.1f)), base * 0.2f, 1e-3f);
    expectNear(toonUnder(sun(-0.5f)), base * 0.1f, 1e-3f);
    expectNear(toonUnder(sun(-0.5f), toon("return vec3(lightData.NdotL + 0.25);")), float3(0.25f), 1e-3f);
}

TEST(CustomShading, APunctualLightComesWithItsAttenuationAndItsPosition) {
    const PointLight lamp{ .positionWorld = { 0, 0, 2 },
                           .intensity = Candela{ kUnit * 8 },
                           .color = { 1, 0.5f, 0.25f } };
    expectNear(toonUnder(lamp), float3(0.5f, 0.125f, 0.03125f) * 2.0f, 4e-3f); // 8 cd at 2 m
    expectNear(toonUnder(lamp, toon("return lightData.worldPosition - getWorldPosition();")), { 0, 0, 2 }, 2e-3f);
    expectNear(toonUnder(lamp, toon("return lightData.colorIntensity.rgb;")), { 1, 0.5f, 0.25f }, 1e-3f);
    expectNear(toonUnder(lamp, toon("return vec3(shadingData.f0.x, shadingData.perceptualRoughness, "
                                    "shadingData.roughness);")),
               { 0.04f, 1, 1 }, 1e-3f);
    expectNear(toonUnder(lamp, toon("return lightData.l * dot(lightData.l, lightData.l);")), { 0, 0, 1 }, 1e-3f);
}

} // namespace
} // namespace filament_core
