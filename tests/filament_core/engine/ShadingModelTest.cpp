// SPDX-License-Identifier: Apache-2.0
// Refraction, cloth, subsurface and custom shading as pictures: the same bits on both APIs, and colours that follow
// from the physics of the model by a line of arithmetic.
#include "filament_core/assets/DfgTable.h"
#include "filament_core/assets/IblDirections.h"
#include "tests/filament_core/engine/MaterialStage.h"
#include "tests/scenes/Sphere.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace filament {
namespace {

using test::centerPixel;
using test::halfPixel;
using test::MaterialStage;
using test::onBothApis;

/// Radiance `base` + slope * direction, the same at every roughness, and what a white diffuse surface makes of it.
struct Sky {
    float3 base{ 1 };
    float3 slope{ 0 };

    float3 radiance(float3 direction) const { return base + slope * glm::normalize(direction); }
};

constexpr Sky kWhiteSky{};
constexpr Sky kDirectionSky{ float3(0.5f), float3(0.5f) }; // shows directions as colours

/// Keeps alive what a scene's light needs.
struct SkyObjects {
    Owned<Texture> cube;
    Owned<IndirectLight> light;

    SkyObjects(MaterialStage& stage, Sky const& sky) {
        constexpr uint32_t kSide = 64, kLevels = 5;
        std::vector<uint16_t> texels;
        for (uint32_t level = 0; level < kLevels; ++level) {
            const uint32_t side = kSide >> level;
            for (uint32_t i = 0; i < 6 * side * side; ++i) {
                const auto x = static_cast<int>(i % side), y = static_cast<int>(i / side % side);
                const float3 direction = assets::directionFromCube(
                        { i / (side * side), assets::faceCoordinate(x, side), assets::faceCoordinate(y, side) });
                const float3 color = sky.radiance(direction);
                for (int c = 0; c < 3; ++c) texels.push_back(halfFromFloat(color[c]));
                texels.push_back(halfFromFloat(1.0f));
            }
        }
        cube = stage.engine.own(stage.engine.create(TextureDesc{ .kind = TextureKind::Cube,
                                                                 .format = Format::RGBA16F,
                                                                 .width = kSide,
                                                                 .height = kSide,
                                                                 .layers = 6,
                                                                 .levels = kLevels,
                                                                 .pixels = std::as_bytes(std::span(texels)) }));
        IndirectLightDesc desc{ .specular = cube, .specularLevels = kLevels };
        desc.irradianceSh[0] = float4(sky.base, 0);
        desc.irradianceSh[1].y = desc.irradianceSh[2].z = desc.irradianceSh[3].x = sky.slope.x * 2 / 3;
        light = stage.engine.own(stage.engine.create(desc));
        stage.scene.setIndirectLight(light, Lux{ 1 / stage.view.camera.exposure.factor() });
    }
};

void addSphere(MaterialStage& stage, MaterialInstance instance) {
    const scenes::SphereMesh sphere = scenes::makeSphere(24, 48);
    std::vector<test::StageVertex> vertices;
    for (scenes::SphereVertex const& vertex : sphere.vertices)
        vertices.push_back({ .position = vertex.position, .tangents = vertex.tangents });
    stage.add(instance, vertices, sphere.indices, double4x4(1.0));
}

constexpr uint16_t kNoLights = shader::kVariantSun | shader::kVariantPunctual, kSunOnly = shader::kVariantPunctual;

/// What main() of a material sets, and its properties.
std::string text(std::string_view properties, std::string_view code) {
    return fmt::format("material {{ name : stage, {} }}\nfragment {{ void material(inout MaterialInputs material) {{\n"
                       "prepareMaterial(material);\n{}\n}} }}",
                       properties, code);
}

template <class Build>
Image underSky(Sky const& sky, Build&& build) {
    return onBothApis([&](MaterialStage& stage) {
        stage.keep(std::make_shared<SkyObjects>(stage, sky));
        build(stage);
    });
}

/// The middle of a square that looks straight at the camera.
float4 seenOnSquare(std::string const& material, Sky const& sky) {
    return centerPixel(underSky(sky, [&](MaterialStage& stage) {
        stage.view.size = { 9, 9 };
        stage.add(stage.material(material, kNoLights), { {} });
    }));
}

Image seenOnSphere(std::string const& material, Sky const& sky, uint32_t side = 32) {
    return underSky(sky, [&](MaterialStage& stage) {
        stage.view.camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 0 }, { .verticalFovDegrees = 45 });
        stage.view.size = { side, side };
        stage.view.clearColor = float4(sky.base, 1);
        addSphere(stage, stage.material(material, kNoLights));
    });
}

/// From the camera of seenOnSphere() through the middle of a pixel.
float3 directionThrough(uint32_t x, uint32_t y, uint32_t side) {
    const float half = std::tan(glm::radians(22.5f));
    const float2 at = (float2(x, y) + 0.5f) / static_cast<float>(side) * 2.0f - 1.0f;
    return glm::normalize(float3(at.x * half, -at.y * half, -1));
}

void expectFurnace(std::string const& material, float least) {
    const test::Extremes found = test::extremesOf(seenOnSphere(material, kWhiteSky));
    EXPECT_LE(found.most, 1.005f) << material;
    EXPECT_GE(found.least, least) << material;
}

void expectNear(float4 seen, float3 expected, float tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(seen[c], expected[c], tolerance) << "component " << c;
}

// ------------------------------------------------------------------------------------------ refraction

constexpr std::string_view kSolid = "refractionMode : cubemap",
                           kThin = "refractionMode : cubemap, refractionType : thin";

TEST(RefractionModel, ASolidOfIndexOneShowsWhatIsBehindItAsIfItWereNotThere) {
    const Image picture =
            seenOnSphere(text(kSolid, "material.roughness = 0.7; material.reflectance = 0.0;"), kDirectionSky);
    for (uint32_t y = 8; y < 24; ++y) {
        for (uint32_t x = 8; x < 24; ++x)
            expectNear(halfPixel(picture, x, y), kDirectionSky.radiance(directionThrough(x, y, 32)), 2e-3f);
    }
}

TEST(RefractionModel, AThinLayerDoesNotBendLight) {
    const Image picture = underSky(kDirectionSky, [&](MaterialStage& stage) {
        stage.view.camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 0 }, { .verticalFovDegrees = 45 });
        stage.view.size = { 32, 32 };
        stage.add(stage.material(text(kThin, "material.roughness = 0.0;"), kNoLights), { {} });
    });
    for (uint32_t at = 0; at < 32; at += 3) {
        const float4 seen = halfPixel(picture, at, 31 - at);
        const float3 straight = kDirectionSky.radiance(directionThrough(at, 31 - at, 32));
        // What is reflected differs in z alone, and clear glass loses nothing.
        EXPECT_NEAR(seen.x, straight.x, 3e-3f) << at;
        EXPECT_NEAR(seen.y, straight.y, 3e-3f) << at;
        EXPECT_GT(seen.z, straight.z) << at;
    }
    const float both = 2 * 0.04f / 1.04f; // both interfaces and all bounces between them
    EXPECT_NEAR(halfPixel(picture, 16, 16).z, both, 3e-3f) << "of what is behind nothing has a z";
}

TEST(RefractionModel, ABallTurnsWhatIsBehindItAround) {
    const Image picture = seenOnSphere(text(kSolid, "material.roughness = 0.0;"), kDirectionSky);
    for (const uint32_t at : { 9u, 12u, 19u, 22u }) {
        // refraction.glsl, with the sphere as the ball: where the view meets it, and out at the other side.
        const float3 origin(0, 0, 3), view = directionThrough(at, 16, 32);
        const float along = -glm::dot(origin, view);
        const float3 n = origin + view * (along - std::sqrt(along * along - 8.0f)); // |origin|^2 - 1 = 8
        const float3 inside = glm::refract(view, n, 1 / 1.5f);
        const float3 exitNormal = n + inside * (-2 * glm::dot(n, inside));
        const float3 out = glm::refract(inside, -exitNormal, 1.5f);
        EXPECT_NEAR(halfPixel(picture, at, 16).x, kDirectionSky.radiance(out).x, 0.03f) << at; // 4 % is reflected
    }
}

TEST(RefractionModel, AbsorptionFollowsBeerAndLambertWithTheThickness) {
    const auto through = [](std::string_view properties, std::string const& code) {
        const float4 seen = seenOnSquare(text(properties, "material.roughness = 0.0; " + code), kWhiteSky);
        const float4 clear = seenOnSquare(text(properties, "material.roughness = 0.0;"), kWhiteSky);
        const float4 none = seenOnSquare(
                text(properties, "material.roughness = 0.0; material.baseColor.rgb = vec3(0.0);"), kWhiteSky);
        return (float3(seen) - float3(none)) / (float3(clear) - float3(none));
    };
    const float3 absorption(0.25f, 0.5f, 1);
    const std::string absorbing = "material.absorption = vec3(0.25, 0.5, 1.0);";
    for (const float thickness : { 0.5f, 1.0f, 2.0f }) {
        const float3 expected = glm::exp(-absorption * thickness);
        const float3 solid = through(kSolid, fmt::format("{} material.thickness = {:.1f};", absorbing, thickness));
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(solid[c], expected[c], 3e-3f) << thickness;
    }
    const float3 share = through(kSolid, absorbing);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(share[c], 1 - absorption[c], 3e-3f) << "without a distance";
    // Thin: what the far interface reflects has crossed the layer twice, and on.
    const float3 thin = through(kThin, absorbing + "material.microThickness = 0.5;");
    for (int c = 0; c < 3; ++c) {
        const float f = 0.04f, t = std::exp(-absorption[c] * 0.5f), bounces = 1 / (1 - f * f * t * t);
        EXPECT_NEAR(thin[c], (1 - f) * t * (1 + f * t) * bounces, 3e-3f) << "thin";
    }
}

TEST(RefractionModel, GlassLosesAndGainsNothingInAWhiteFurnace) {
    for (const std::string_view properties : { kSolid, kThin }) {
        for (const float roughness : { 0.0f, 0.5f, 1.0f }) {
            expectFurnace(text(properties, fmt::format("material.roughness = {:.1f};", roughness)), 0.97f);
            expectFurnace(text(properties,
                               fmt::format("material.roughness = {:.1f}; material.transmission = 0.5;", roughness)),
                          0.95f);
        }
    }
}

TEST(RefractionModel, WithoutTransmissionItIsTheOpaqueMaterial) {
    const std::string code = "material.baseColor.rgb = vec3(0.2, 0.5, 0.8); material.roughness = 0.4;";
    const Image opaque = seenOnSphere(text("", code), kDirectionSky);
    for (const std::string_view properties : { kSolid, kThin }) {
        const Image closed = seenOnSphere(text(properties, code + "material.transmission = 0.0;"), kDirectionSky);
        for (uint32_t i = 0; i < 32; ++i) expectNear(halfPixel(closed, i, 16), float3(halfPixel(opaque, i, 16)), 1e-3f);
    }
}

TEST(RefractionModel, DispersionBendsBlueMoreThanGreenAndRedLess) {
    const Sky gray{ float3(0.5f), float3(0.5f) };
    const std::string code = "material.roughness = 0.0;";
    const Image without = seenOnSphere(text(kSolid, code), gray);
    const Image with = seenOnSphere(text(kSolid, code + "material.dispersion = 1.0;"), gray);
    const Image none = seenOnSphere(text(kSolid, code + "material.dispersion = 0.0;"), gray);
    EXPECT_EQ(without.pixels, none.pixels) << "neutral";
    // Straight above the middle: y alone changes, and the ball turns it around.
    for (const uint32_t y : { 10u, 13u }) {
        EXPECT_EQ(halfPixel(with, 16, y).y, halfPixel(without, 16, y).y) << "green stays";
    }
    EXPECT_NE(halfPixel(with, 10, 16).x, halfPixel(without, 10, 16).x);
    EXPECT_NE(halfPixel(with, 16, 10).z, halfPixel(without, 16, 10).z);
}

TEST(RefractionModel, AThinLayerPassesALightBehindItOnAsItsMirrorImageWouldBeReflected) {
    const Image picture = onBothApis([&](MaterialStage& stage) {
        stage.view.size = { 9, 9 };
        stage.add(stage.material(text(kThin, "material.roughness = 0.5;"), kSunOnly), { {} });
        stage.scene.add(SunLight{ .directionWorld = { 0, 0, 1 },
                                  .illuminance = Lux{ 1 / stage.view.camera.exposure.factor() } });
    });
    const float alpha = 0.25f, share = 0.96f / 1.04f;
    EXPECT_NEAR(centerPixel(picture).x, share / (4 * 3.14159265f * alpha * alpha), 0.02f);
}

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

/// Radiance of the middle of a square under a sun of illuminance 1 whose cosine to the normal of the square is given.
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
    for (const float thickness : { 0.0f, 0.5f, 1.0f }) {
        for (const float roughness : { 0.2f, 1.0f }) {
            expectFurnace(text(kSubsurface, fmt::format("material.roughness = {:.1f}; material.thickness = {:.1f};",
                                                        roughness, thickness)),
                          0.97f);
        }
    }
    expectFurnace(text(kSubsurface, "material.metallic = 1.0; material.roughness = 0.3;"), 0.97f);
}

TEST(SubsurfaceModel, AtFullThicknessItIsTheStandardModel) {
    const std::string code = "material.baseColor.rgb = vec3(0.2, 0.5, 0.8); material.roughness = 0.4;";
    const Image lit = seenOnSphere(text("", code), kDirectionSky);
    const Image thick = seenOnSphere(text(kSubsurface, code + "material.thickness = 1.0;"), kDirectionSky);
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
    // subsurface.glsl: half of it straight on, in a lobe of which 2^(p (cos - 1)) is left.
    const auto expected = [left](float thickness, float power) {
        const float x = power * std::log(2.0f);
        const float integral = (1 - std::exp(-x)) / x + std::exp2(-power);
        const float around = std::max(-thickness, 0.0f); // of a wrapped cosine of -1
        return left * (1 - thickness) * 0.5f * (0.1591549f / integral + around);
    };
    for (const float thickness : { 0.25f, 0.5f, 0.75f }) {
        for (const float power : { 2.0f, 12.0f }) {
            const float4 seen = behind(thickness, power);
            const float strength = expected(thickness, power);
            expectNear(seen, float3(1, 0.5f, 0.25f) * strength, 2e-3f * std::max(1.0f, strength));
        }
    }
    EXPECT_EQ(behind(1.0f, 12.0f).x, 0.0f);
}

// ------------------------------------------------------------------------------------------ custom

/// The guide's own example, 4.4.3.
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
} // namespace filament
