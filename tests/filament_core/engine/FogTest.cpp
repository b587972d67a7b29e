// SPDX-License-Identifier: Apache-2.0
// Fog on both APIs: colours of surfaces and skies against the closed form, for every way of blending; and what stays as
// it is without fog. Pictures are scene-linear half floats, so tolerances are those of their rounding.
#include "tests/filament_core/engine/FogStage.h"

namespace filament_core {
namespace {

using namespace test;

constexpr const char* kBlackLit = R"(material { name : black, shadingModel : lit, doubleSided : true }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor.rgb = vec3(0.0);
    material.reflectance = 0.0;
    material.emissive = vec4(0.8, 0.4, 0.2, 0.0);
} })";

/// A plane of one material straight ahead.
Image planeInFog(std::string const& material, Fog const& fog, double distance, double3 eye = { 0, 0, 4 }) {
    return onBothApis([&](MaterialStage& stage) {
        stage.view.camera = Camera::lookAt(eye, eye - double3(0, 0, 1), { .verticalFovDegrees = 45 });
        stage.view.effects.fog = fog;
        addPlane(stage, stage.material(material, test::kNoLights), distance);
    });
}

void expectClosedForm(std::string const& material, Fog const& fog, double distance, double3 eye = { 0, 0, 4 }) {
    const Image image = planeInFog(material, fog, distance, eye);
    forFogPixels(image, [&](float4 seen, double3 direction) {
        const double meters = distance / -direction.z;
        const bool isCutOff = fog.cutOffMeters > 0 && meters > fog.cutOffMeters;
        const double opacity = isCutOff ? 0 : opacityAlong(fog, eye.y, direction.y, fog.startMeters, meters);
        expectHalf(seen, foggedPaint(kPaintInFog, fog, opacity),
                   fmt::format("density {} falloff {} at {} m", fog.density, fog.heightFalloff, meters));
    });
}

TEST(Fog, SurfacesHaveTheColourOfTheClosedForm) {
    Fog falling = fogOf(0.3f);
    falling.heightFalloff = 0.7f;
    falling.heightMeters = -1.5f;
    Fog late = falling;
    late.startMeters = 2.5f;
    late.maximumOpacity = 0.6f;
    for (const double distance : { 0.3, 4.0, 12.0 }) {
        for (std::string const& material : { paintText(""), std::string(kBlackLit) }) {
            expectClosedForm(material, fogOf(0.15f), distance);
            expectClosedForm(material, falling, distance, { 3, 1.25, 4 });
            expectClosedForm(material, late, distance);
        }
    }
    expectClosedForm(paintText(""), fogOf(4e-4f), 3000);
    expectClosedForm(paintText(""), fogOf(1e4f), 1e-4 + 0.02);
}

TEST(Fog, EndsAtTheCutOff) {
    Fog fog = fogOf(0.2f);
    fog.cutOffMeters = 6.15f; // a circle around the middle of the image
    expectClosedForm(paintText(""), fog, 6);
    expectClosedForm(kBlackLit, fog, 6);
}

TEST(Fog, IsTheSameTenThousandKilometersFromTheOrigin) {
    Fog fog = fogOf(0.3f);
    fog.heightFalloff = 0.7f;
    fog.heightMeters = -1.5f;
    const Image here = planeInFog(kBlackLit, fog, 4, { 0, 0.25, 4 });
    for (const double2 away : { double2(1e7, 0), double2(-3e6, 2e7) })
        EXPECT_EQ(planeInFog(kBlackLit, fog, 4, { away.x, 0.25, away.y }).pixels, here.pixels);
    fog.heightMeters = 1e6f - 1.5f;
    EXPECT_EQ(planeInFog(kBlackLit, fog, 4, { 0, 1e6 + 0.25, 4 }).pixels, here.pixels);
}

// ---- blending

struct BlendCase {
    std::string properties;
    /// Result of blending a source with fog in front over the scene colour.
    float3 (*blend)(float3 source, float alpha, float3 fog, double opacity, float3 behind);
};

constexpr float kPaneAlpha = 0.5f;

float3 overBehind(float3 source, float alpha, float3 fog, double opacity, float3 behind) {
    const auto o = static_cast<float>(opacity);
    return source * (1 - o) + fog * o * alpha + behind * (1 - alpha);
}
float3 addedTo(float3 source, float, float3, double opacity, float3 behind) {
    return source * static_cast<float>(1 - opacity) + behind;
}
float3 multiplied(float3 source, float, float3, double opacity, float3 behind) {
    return glm::mix(source, float3(1), static_cast<float>(opacity)) * behind;
}
float3 screened(float3 source, float, float3, double opacity, float3 behind) {
    const float3 left = source * static_cast<float>(1 - opacity);
    return left + behind * (1.0f - left);
}
float3 weighted(float3 source, float alpha, float3 fog, double opacity, float3 behind) {
    return glm::mix(behind, glm::mix(source, fog, static_cast<float>(opacity)), alpha);
}

TEST(Fog, BlendedSurfacesAreFoggedAsMuchAsTheyCover) {
    const BlendCase cases[] = {
        { "blending : transparent", overBehind },
        { "blending : fade", overBehind },
        { "blending : add", addedTo },
        { "blending : multiply", multiplied },
        { "blending : screen", screened },
        { "blending : custom, blendFunction : { srcRGB : srcAlpha, srcA : one, dstRGB : oneMinusSrcAlpha, dstA : one }",
          weighted },
        { "blending : custom, blendFunction : { srcRGB : one, srcA : one, dstRGB : one, dstA : one }", addedTo },
    };
    const Fog fog = fogOf(0.2f);
    constexpr float3 kPane{ 0.3f, 0.1f, 0.25f };
    for (BlendCase const& each : cases) {
        const Image image = onBothApis([&](MaterialStage& stage) {
            stage.view.effects.fog = fog;
            addPlane(stage, stage.material(paintText(""), test::kNoLights), 9);
            addPlane(stage, stage.material(paintText(each.properties, "vec4(0.3, 0.1, 0.25, 0.5)"), test::kNoLights),
                     3);
        });
        forFogPixels(image, [&](float4 seen, double3 direction) {
            const auto opacity = [&](double z) { return opacityAlong(fog, 0, direction.y, 0, z / -direction.z); };
            const float3 behind = foggedPaint(kPaintInFog, fog, opacity(9));
            expectHalf(seen, each.blend(kPane, kPaneAlpha, fog.color, opacity(3), behind), each.properties, 2);
        });
    }
}

/// A pane of full coverage is an opaque surface.
TEST(Fog, AnOpaquePaneLooksAsTheSurfaceThatItIs) {
    const Fog fog = fogOf(0.2f);
    const Image opaque = planeInFog(paintText(""), fog, 5);
    EXPECT_EQ(planeInFog(paintText("blending : transparent"), fog, 5).pixels, opaque.pixels);
    EXPECT_EQ(planeInFog(paintText("blending : masked"), fog, 5).pixels, opaque.pixels);
}

TEST(Fog, MaterialsCompiledWithoutItHaveNone) {
    const Fog fog = fogOf(1);
    for (std::string const& material :
         { paintText("variantFilter : [ fog ]"), std::string(kBlackLit).insert(10, " variantFilter : [ fog ],") }) {
        forFogPixels(planeInFog(material, fog, 5),
                     [&](float4 seen, double3) { expectHalf(seen, kPaintInFog, "without fog"); });
    }
}

// ---- skies

/// Stage with a sky of one colour, 2, and nothing else.
Image skyInFog(Fog const& fog, DepthRange range = DepthRange::Reversed, bool hasSky = true) {
    return onBothApis([&](MaterialStage& stage) {
        constexpr uint32_t kTexels = 6 * 4 * 4;
        std::vector<uint16_t> texels(4 * kTexels, halfFromFloat(2.0f));
        const Texture cube = stage.own(stage.engine.create(TextureDesc{ .kind = TextureKind::Cube,
                                                                        .format = Format::RGBA16F,
                                                                        .width = 4,
                                                                        .height = 4,
                                                                        .layers = 6,
                                                                        .levels = 1,
                                                                        .pixels = std::as_bytes(std::span(texels)) }));
        auto sky = std::make_shared<Owned<Skybox>>(stage.engine.own(stage.engine.create(SkyboxDesc{ .cube = cube })));
        stage.keep(sky);
        if (hasSky) stage.scene.setSkybox(*sky, Lux{ 1 / stage.view.camera.exposure.factor() });
        stage.view.camera = Camera::lookAt({ 0, 2, 4 }, { 0, 2, 0 }, { .verticalFovDegrees = 45 });
        stage.view.clearColor = { 0.25f, 0.5f, 1, 1 };
        stage.view.quality.depthRange = range;
        stage.view.effects.fog = fog;
    });
}

TEST(Fog, SkiesAreInfinitelyFarAway) {
    Fog fog = fogOf(0.05f);
    fog.heightFalloff = 0.3f;
    for (const DepthRange range : { DepthRange::Reversed, DepthRange::Ordinary }) {
        forFogPixels(skyInFog(fog, range), [&](float4 seen, double3 direction) {
            const double depth = 0.05 * std::exp(-0.6) / (0.3 * direction.y);
            const double opacity = direction.y > 0 ? 1 - std::exp(-depth) : 1.0;
            expectHalf(seen, foggedPaint(float3(2), fog, opacity), "sky");
        });
    }
    fog.heightFalloff = 0;
    forFogPixels(skyInFog(fog), [&](float4 seen, double3) { expectHalf(seen, fog.color, "level fog hides the sky"); });
    fog.maximumOpacity = 0.75f;
    forFogPixels(skyInFog(fog), [&](float4 seen, double3) {
        expectHalf(seen, foggedPaint(float3(2), fog, 0.75), "but for what the limit leaves");
    });
    fog.cutOffMeters = 1e9f;
    forFogPixels(skyInFog(fog), [&](float4 seen, double3) { expectHalf(seen, float3(2), "a sky with its own haze"); });
}

TEST(Fog, TheBackgroundWithoutASkyStaysAsItIs) {
    forFogPixels(skyInFog(fogOf(1), DepthRange::Reversed, false),
                 [&](float4 seen, double3) { EXPECT_EQ(seen, float4(0.25f, 0.5f, 1, 1)); });
}

// ---- light

TEST(Fog, ScattersTheLightOfTheSunAroundIt) {
    Fog fog = fogOf(0.2f);
    fog.inScatteringSize = 12;
    fog.inScatteringStartMeters = 1;
    const float3 towards = glm::normalize(float3(0.2f, 0.1f, -1));
    const Image image = onBothApis([&](MaterialStage& stage) {
        stage.view.effects.fog = fog;
        stage.scene.add(SunLight{ .directionWorld = -towards,
                                  .illuminance = Lux{ 0.5f / stage.view.camera.exposure.factor() },
                                  .color = { 1, 0.5f, 0.25f } });
        addPlane(stage, stage.material(paintText("")), 6);
    });
    forFogPixels(image, [&](float4 seen, double3 direction) {
        const double meters = 6 / -direction.z;
        const double glow = 0.5 * 13 / (2 * 3.14159265358979) * std::pow(glm::dot(direction, double3(towards)), 12) *
                            opacityAlong(fog, 0, direction.y, 1, meters);
        const float3 base = foggedPaint(kPaintInFog, fog, opacityAlong(fog, 0, direction.y, 0, meters));
        expectHalf(seen, base + float3(1, 0.5f, 0.25f) * static_cast<float>(glow), "glow");
    });
}

TEST(Fog, TakesTheColourOfTheEnvironmentBehind) {
    Fog fog = fogOf(0.3f);
    fog.color = { 1, 0.5f, 0.25f };
    for (const bool fromEnvironment : { false, true }) {
        fog.colorFromEnvironment = fromEnvironment;
        const Image image = test::underSky(test::kDirectionSky, [&](MaterialStage& stage) {
            stage.view.effects.fog = fog;
            addPlane(stage, stage.material(paintText("")), 5);
        });
        forFogPixels(image, [&](float4 seen, double3 direction) {
            const double opacity = opacityAlong(fog, 0, direction.y, 0, 5 / -direction.z);
            Fog colored = fog;
            if (fromEnvironment) colored.color *= test::kDirectionSky.radiance(float3(direction));
            const float3 expected = foggedPaint(kPaintInFog, colored, opacity);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(seen[c], expected[c], 1.5e-2f) << "between texels of a cube of 4 x 4";
        });
    }
}

// ---- debug view

TEST(Fog, ItsDebugViewShowsTheOpacity) {
    Fog fog = fogOf(0.12f);
    fog.heightFalloff = 0.4f;
    for (const Backend backend : test::kBothApis) {
        auto engine = test::makeEngine(backend);
        ASSERT_TRUE(engine);
        MaterialStage stage(*engine);
        stage.view.effects.fog = fog;
        stage.view.debugView = DebugView::Fog;
        addPlane(stage, stage.material(paintText("")), 6);
        Renderer renderer(*engine);
        const auto shown = [&] {
            const Result<Image> image = renderer.renderToImage(stage.scene, stage.view);
            return image ? *image : Image{};
        };
        const Image image = shown();
        ASSERT_EQ(image.width, kFogSide);
        for (uint32_t y = 0; y < kFogSide; ++y) {
            for (uint32_t x = 0; x < kFogSide; ++x) {
                const double3 direction(test::directionThrough(x, y, kFogSide));
                const double opacity = opacityAlong(fog, 0, direction.y, 0, 6 / -direction.z);
                EXPECT_NEAR(test::bytePixel(image, x, y).y, opacity, 0.51 / 255) << x << ' ' << y;
            }
        }
        stage.view.effects.fog.enabled = false;
        for (const std::byte value : shown().pixels) EXPECT_TRUE(value == std::byte{ 0 } || value == std::byte{ 255 });
        EXPECT_NE(renderer.explain().find("debugView=fog: its effect does not run"), std::string::npos);
        test::expectNoErrors(*engine);
    }
}

// ---- off

TEST(Fog, WithoutDensityOrSwitchedOffChangesNothing) {
    const Image off = planeInFog(kBlackLit, {}, 5);
    Fog empty = fogOf(0);
    EXPECT_EQ(planeInFog(kBlackLit, empty, 5).pixels, off.pixels);
    Fog invisible = fogOf(1);
    invisible.maximumOpacity = 0;
    EXPECT_EQ(planeInFog(kBlackLit, invisible, 5).pixels, off.pixels);
    Fog disabled = fogOf(1);
    disabled.enabled = false;
    EXPECT_EQ(planeInFog(kBlackLit, disabled, 5).pixels, off.pixels);
}

/// Whatever numbers a program sets.
TEST(Fog, StaysFiniteForExtremeValues) {
    for (const float density : { 1e-30f, 1e4f, std::numeric_limits<float>::infinity() }) {
        for (const float falloff : { 0.0f, 1e3f }) {
            for (const float height : { -1e6f, 1e6f }) {
                Fog fog = fogOf(density);
                fog.heightFalloff = falloff;
                fog.heightMeters = height;
                fog.inScatteringSize = 1e3f;
                for (const double distance : { 0.05, 2000.0 })
                    test::extremesOf(planeInFog(paintText(""), fog, distance));
                test::extremesOf(skyInFog(fog));
            }
        }
    }
}

} // namespace
} // namespace filament_core
