// SPDX-License-Identifier: Apache-2.0
// Screen-space refraction on both APIs: the image through panes, slabs and rough glass has a closed form.
#include "tests/filament_core/engine/SkyStage.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <filament_core/Renderer.h>

#include <cmath>
#include <functional>

namespace filament_core {
namespace {

using test::centerPixel;
using test::expectNear;
using test::halfPixel;
using test::kNoLights;
using test::kWhiteSky;
using test::MaterialStage;
using test::onBothApis;
using test::text;
using test::underSky;

constexpr std::string_view kSheet = "refractionMode : screenspace, refractionType : thin",
                           kBlock = "refractionMode : screenspace";
// Index 1 reflects nothing: only what is behind is seen.
const std::string kNothing = "material.roughness = 0.0; material.ior = 1.0;";

/// A wall behind the stage, of a colour that `code` makes of vec2 uv, which is (0, 0) in the upper left corner.
void addWall(MaterialStage& stage, std::string const& code, float z, float halfSide) {
    const std::string wall = text("shadingModel : unlit, requires : [ uv0 ]",
                                  "vec2 uv = getUV0(); vec3 c; " + code + " material.baseColor = vec4(c, 1.0);");
    stage.add(stage.material(wall), { { .z = z, .halfSide = halfSide } });
}

const std::string kPattern = "c = vec3(fract(uv * 7.0), step(0.5, fract(dot(uv, vec2(13.0, 5.0)))));";
/// Black to the left of the middle, white to the right.
const std::string kEdge = "c = vec3(step(0.5, uv.x));";

Image seen(uint2 size, std::function<void(MaterialStage&)> const& build) {
    return onBothApis([&](MaterialStage& stage) {
        stage.view.size = size;
        build(stage);
    });
}

TEST(PictureRefraction, ASheetOfIndexOneIsInvisibleToTheBit) {
    for (const uint2 size : { uint2(64, 48), uint2(33, 17), uint2(7, 129), uint2(1, 1), uint2(2, 300) }) {
        for (const uint8_t samples : { uint8_t{ 1 }, uint8_t{ 4 } }) {
            const auto draw = [&](bool hasPane) {
                return seen(size, [&](MaterialStage& stage) {
                    stage.view.samples = samples;
                    addWall(stage, kPattern, -1, 1.5f);
                    if (hasPane) stage.add(stage.material(text(kSheet, kNothing), kNoLights), { { .halfSide = 1 } });
                });
            };
            EXPECT_EQ(test::differingPixels(draw(true), draw(false)), 0u)
                    << size.x << " x " << size.y << ", " << samples;
        }
    }
}

TEST(PictureRefraction, ASmallSheetSeesThePartThatIsCopied) {
    const auto draw = [&](bool hasPane) {
        return seen({ 160, 90 }, [&](MaterialStage& stage) {
            addWall(stage, kPattern, -1, 3);
            const auto square = std::make_shared<test::SquareMesh>(stage.engine);
            if (hasPane)
                square->add(stage.scene, stage.material(text(kSheet, kNothing), kNoLights), { 0.6, 0.3, 0 }, 0.2);
            stage.keep(square);
        });
    };
    EXPECT_EQ(test::differingPixels(draw(true), draw(false)), 0u);
}

TEST(PictureRefraction, ASheetOfGlassLosesWhatBothInterfacesReflectAndTintsTheRest) {
    const auto through = [&](std::string const& code) {
        return centerPixel(seen({ 9, 9 }, [&](MaterialStage& stage) {
            addWall(stage, "c = vec3(0.8, 0.5, 0.2);", -1, 8);
            stage.add(stage.material(text(kSheet, "material.roughness = 0.0; " + code), kNoLights), { {} });
        }));
    };
    const float f = 0.04f; // of one interface, at normal incidence
    expectNear(through(""), float3(0.8f, 0.5f, 0.2f) * ((1 - f) / (1 + f)), 1 / 255.0f);
    const float3 tint(0.9f, 0.5f, 0.1f);
    float3 share;
    for (int c = 0; c < 3; ++c) share[c] = (1 - f) * (1 - f) * tint[c] / (1 - f * f * tint[c] * tint[c]);
    expectNear(through("material.baseColor.rgb = vec3(0.9, 0.5, 0.1);"), float3(0.8f, 0.5f, 0.2f) * share, 1 / 255.0f);
    expectNear(through("material.transmission = 0.0; material.baseColor.rgb = vec3(0.0);"), float3(0), 1e-6f);
}

TEST(PictureRefraction, ASolidTintsByItsThickness) {
    const auto through = [&](std::string const& code) {
        return float3(centerPixel(seen({ 9, 9 }, [&](MaterialStage& stage) {
            addWall(stage, "c = vec3(0.5);", -3, 8);
            stage.add(stage.material(text(kBlock, "material.roughness = 0.0; " + code), kNoLights), { {} });
        })));
    };
    const float3 clear = through("material.thickness = 0.7;");
    const float3 tinted = through("material.thickness = 0.7; material.absorption = vec3(0.3, 1.0, 3.0);");
    expectNear(float4(tinted / clear, 1), glm::exp(-float3(0.3f, 1, 3) * 0.7f), 3e-3f);
}

/// Row `y` of an image of kEdge: the column, in pixels, at which it has this share of the white to the right.
double crossing(Image const& image, uint32_t y, double share) {
    const double white = halfPixel(image, image.width - 1, y).x;
    for (uint32_t x = 1; x < image.width; ++x) {
        const double before = halfPixel(image, x - 1, y).x / white, after = halfPixel(image, x, y).x / white;
        if (before < share && after >= share) return x - 0.5 + (share - before) / (after - before);
    }
    return -1;
}

// The chord of the ball, for a view along -z and a slab turned about y by `angle`.
TEST(PictureRefraction, ATurnedBlockShiftsAnEdgeAsFarAsSnellsLawSays) {
    constexpr uint32_t kViewSide = 128;
    constexpr double kFov = 2, kEye = 60, kBehindZ = -0.6, kThickness = 0.4;
    for (const double degrees : { 0.0, 20.0, 45.0, -45.0, 60.0 }) {
        for (const double ior : { 1.0, 1.5, 2.4 }) {
            const double angle = glm::radians(degrees);
            const Image picture = seen({ kViewSide, kViewSide }, [&](MaterialStage& stage) {
                stage.view.camera = Camera::lookAt({ 0, 0, kEye }, { 0, 0, 0 }, { .verticalFovDegrees = kFov });
                addWall(stage, kEdge, static_cast<float>(kBehindZ), 8);
                double4x4 turned(1.0);
                turned[0] = double4(std::cos(angle), 0, -std::sin(angle), 0);
                turned[2] = double4(std::sin(angle), 0, std::cos(angle), 0);
                stage.add(stage.material(text(kBlock, fmt::format("material.roughness = 0.0; material.ior = {:.2f}; "
                                                                  "material.thickness = {:.2f};",
                                                                  ior, kThickness)),
                                         kNoLights),
                          { { .halfSide = 3 } }, turned);
            });
            // Snell: sin(inside) = sin(angle) / ior; the chord is kThickness cos(inside), turned from the view by the
            // difference.
            const double inside = std::asin(std::sin(std::abs(angle)) / ior);
            const double aside = kThickness * std::cos(inside) * std::sin(std::abs(angle) - inside);
            const double shift =
                    (angle > 0 ? 1 : -1) * aside * kViewSide / (2 * kEye * std::tan(glm::radians(kFov / 2)));
            EXPECT_NEAR(crossing(picture, kViewSide / 2, 0.5), kViewSide / 2 + shift, 0.25)
                    << degrees << " degrees, index " << ior;
        }
    }
}

TEST(PictureRefraction, RoughGlassBlursAnEdgeAsWideAsItsLobe) {
    constexpr uint32_t kViewSide = 256;
    double last = 0;
    for (const double roughness : { 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35 }) {
        const Image picture = seen({ kViewSide, kViewSide }, [&](MaterialStage& stage) {
            addWall(stage, kEdge, -4, 16); // as far behind the sheet as the camera is before it
            stage.add(stage.material(text(kSheet, fmt::format("material.roughness = {:.2f};", roughness)), kNoLights),
                      { {} });
        });
        // Half of the light of a lobe of half vectors with alpha = roughness^2 is within 2 alpha / sqrt(3) of a row.
        const double pixelsPerTangent = kViewSide / (2 * std::tan(glm::radians(22.5)));
        const double expected = 2 * (2 * roughness * roughness / std::sqrt(3.0)) * 0.5 * pixelsPerTangent;
        const double found = crossing(picture, kViewSide / 2, 0.75) - crossing(picture, kViewSide / 2, 0.25);
        EXPECT_NEAR(found, expected, 0.15 * expected + 0.6) << roughness;
        EXPECT_GT(found, last) << roughness;
        last = found;
    }
}

TEST(PictureRefraction, RoughGlassDoesNotBlurWhatItTouches) {
    for (const double roughness : { 0.3, 1.0 }) {
        const Image picture = seen({ 65, 65 }, [&](MaterialStage& stage) {
            addWall(stage, kEdge, -0.001f, 16);
            stage.add(stage.material(text(kSheet, fmt::format("material.roughness = {:.1f};", roughness)), kNoLights),
                      { {} });
        });
        EXPECT_LT(crossing(picture, 32, 0.75) - crossing(picture, 32, 0.25), 1.5) << roughness;
    }
}

/// How far left of the screen a ray ends that a block turned by 60 degrees about y bends, in pixels.
double beyondTheLeftEdge(uint32_t x, double2 size, double thickness) {
    const double3 n(std::sin(glm::radians(60.0)), 0, 0.5);
    const double half = std::tan(glm::radians(22.5)) * size.x / size.y;
    const double3 ray = glm::normalize(double3((x + 0.5 - size.x / 2) / (size.x / 2) * half, 0, -1)), eye(0, 0, 4);
    const double3 entry = eye + ray * (-glm::dot(n, eye) / glm::dot(n, ray)), bent = glm::refract(ray, n, 1 / 1.5);
    const double3 exit = entry + bent * (-glm::dot(n, bent) * thickness);
    return std::max(-(exit.x / (eye.z - exit.z) / half + 1) * size.x / 2, 0.0);
}

TEST(PictureRefraction, WhereTheRayLeavesThePictureTheEnvironmentIsSeen) {
    // A white environment, a black image: what is seen is the environment's share.
    const auto row = [&](std::string const& code) {
        return underSky(kWhiteSky, [&](MaterialStage& stage) {
            stage.view.size = { 128, 65 };
            double4x4 turned(1.0);
            turned[0] = double4(0.5, 0, -std::sin(glm::radians(60.0)), 0);
            turned[2] = double4(std::sin(glm::radians(60.0)), 0, 0.5, 0);
            stage.add(stage.material(text(kBlock, "material.roughness = 0.0; " + code), kNoLights), { {} }, turned);
        });
    };
    const Image bent = row("material.thickness = 6.0;"), straight = row("material.thickness = 0.0;");
    for (uint32_t x = 0; x < 40; ++x) {
        const float mirrored = halfPixel(straight, x, 32).x; // what the surface reflects; glass loses nothing else
        EXPECT_LT(mirrored, 0.1f);
        const float share = (halfPixel(bent, x, 32).x - mirrored) / (1 - mirrored);
        const double beyond = beyondTheLeftEdge(x, { 128, 65 }, 6); // it fades over a sixteenth of the height
        EXPECT_NEAR(share, std::min(beyond / (65 / 16.0), 1.0), 0.02) << x;
    }
}

TEST(PictureRefraction, GlassGainsNothingInAWhiteFurnace) {
    for (const std::string_view properties : { kBlock, kSheet }) {
        for (const float roughness : { 0.0f, 0.3f, 1.0f }) {
            for (const float thickness : { 0.0f, 0.5f, 1e6f }) {
                if (properties == kSheet && thickness > 0) continue;
                const std::string code =
                        fmt::format("material.roughness = {:.1f}; {}", roughness,
                                    properties == kBlock ? fmt::format("material.thickness = {:.1f};", thickness) : "");
                const Image picture = underSky(kWhiteSky, [&](MaterialStage& stage) {
                    stage.view.camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 0 }, { .verticalFovDegrees = 45 });
                    stage.view.size = { 32, 32 };
                    stage.view.clearColor = float4(1);
                    test::addSphere(stage, stage.material(text(properties, code), kNoLights));
                });
                const test::Extremes found = test::extremesOf(picture);
                EXPECT_LE(found.most, 1.005f) << code;
                EXPECT_GE(found.least, 0.96f) << code;
            }
        }
    }
}

TEST(PictureRefraction, IndicesThicknessesAndRoughnessesAtTheirEndsGiveNumbers) {
    for (const char* ior : { "1.0", "3.0" }) {
        for (const char* thickness : { "0.0", "1e6", "-1.0" }) {
            for (const char* roughness : { "0.0", "1.0" }) {
                const Image picture = seen({ 31, 17 }, [&](MaterialStage& stage) {
                    addWall(stage, kPattern + "c *= 1e6;", -1, 1);
                    stage.view.camera = Camera::lookAt({ 0, 0, 1.3 }, { 0, 0, 0 }, { .verticalFovDegrees = 120 });
                    test::addSphere(
                            stage,
                            stage.material(text(kBlock, fmt::format("material.ior = {}; material.thickness = {}; "
                                                                    "material.roughness = {};"
                                                                    "material.dispersion = 3.0;",
                                                                    ior, thickness, roughness)),
                                           kNoLights));
                });
                EXPECT_GE(test::extremesOf(picture).least, 0) << ior << ' ' << thickness << ' ' << roughness;
            }
        }
    }
}

TEST(PictureRefraction, DispersionShiftsBlueFartherThanGreenAndRedLess) {
    const Image picture = seen({ 128, 128 }, [&](MaterialStage& stage) {
        stage.view.camera = Camera::lookAt({ 0, 0, 60 }, { 0, 0, 0 }, { .verticalFovDegrees = 2 });
        addWall(stage, kEdge, -0.6f, 8);
        double4x4 turned(1.0);
        turned[0] = double4(std::sqrt(0.5), 0, -std::sqrt(0.5), 0);
        turned[2] = double4(std::sqrt(0.5), 0, std::sqrt(0.5), 0);
        stage.add(stage.material(text(kBlock,
                                      "material.roughness = 0.0; material.thickness = 0.4; material.dispersion = 8.0;"),
                                 kNoLights),
                  { { .halfSide = 3 } }, turned);
    });
    double at[3] = {};
    for (int c = 0; c < 3; ++c) {
        const double white = halfPixel(picture, 127, 64)[c];
        for (uint32_t x = 1; x < 128 && at[c] == 0; ++x) {
            const double before = halfPixel(picture, x - 1, 64)[c] / white,
                         after = halfPixel(picture, x, 64)[c] / white;
            if (before < 0.5 && after >= 0.5) at[c] = x - 0.5 + (0.5 - before) / (after - before);
        }
        // KHR_materials_dispersion: half of the spread is (ior - 1) dispersion / 40.
        const double ior = 1.5 + (c - 1) * 0.5 * 8 / 40;
        const double inside = std::asin(std::sqrt(0.5) / ior);
        const double aside = 0.4 * std::cos(inside) * std::sin(glm::radians(45.0) - inside);
        EXPECT_NEAR(at[c], 64 + aside * 128 / (120 * std::tan(glm::radians(1.0))), 0.25) << c;
    }
    EXPECT_LT(at[0], at[1]);
    EXPECT_LT(at[1], at[2]);
}

TEST(PictureRefraction, WhatIsNearerThanTheGlassIsNotSeenThroughIt) {
    // A white block before the right half, to which the glass bends the rays of the left half.
    const Image picture = seen({ 128, 128 }, [&](MaterialStage& stage) {
        stage.view.camera = Camera::lookAt({ 0, 0, 60 }, { 0, 0, 0 }, { .verticalFovDegrees = 2 });
        addWall(stage, "c = vec3(0.25);", -3, 8);
        const std::string white = text("shadingModel : unlit", "material.baseColor = vec4(1.0);");
        const auto square = std::make_shared<test::SquareMesh>(stage.engine);
        square->add(stage.scene, stage.material(white), { 4, 0, 8 }, 4.0);
        stage.keep(square);
        double4x4 turned(1.0);
        turned[0] = double4(std::sqrt(0.5), 0, std::sqrt(0.5), 0);
        turned[2] = double4(-std::sqrt(0.5), 0, std::sqrt(0.5), 0);
        stage.add(
                stage.material(text(kBlock, "material.roughness = 0.0; material.ior = 1.5; material.thickness = 0.8;"),
                               kNoLights),
                { { .halfSide = 3 } }, turned);
    });
    float most = 0;
    for (uint32_t x = 0; x < 60; ++x) most = std::max(most, halfPixel(picture, x, 64).x);
    EXPECT_LT(most, 0.26f);
    EXPECT_GT(halfPixel(picture, 100, 64).x, 0.9f) << "it is there";
}

TEST(PictureRefraction, LateOpaqueObjectsBelongToThePictureAndBlendedOnesLieOverIt) {
    const auto draw = [&](bool hasPane) {
        return seen({ 16, 16 }, [&](MaterialStage& stage) {
            addWall(stage, "c = vec3(0.25);", -3, 8);
            stage.add(stage.material(text("shadingModel : unlit, depthWrite : false",
                                          "material.baseColor = vec4(0.5, 0.25, 0.125, 1.0);")),
                      { { .z = -2, .halfSide = 0.7f } });
            if (hasPane) stage.add(stage.material(text(kSheet, kNothing), kNoLights), { {} });
            stage.add(stage.material(text("shadingModel : unlit, blending : transparent",
                                          "material.baseColor = vec4(0.0, 0.25, 0.0, 0.5);")),
                      { { .z = 1, .halfSide = 0.3f } });
        });
    };
    EXPECT_EQ(test::differingPixels(draw(true), draw(false)), 0u);
}

// ---- layers

/// A wall of 1 behind panes of index 1 that let a half, a third, a fifth and a seventh through, from the back.
float4 throughPanes(int panes, uint8_t layers, uint8_t samples) {
    return centerPixel(seen({ 12, 12 }, [&](MaterialStage& stage) {
        stage.view.samples = samples;
        stage.view.quality.refractionLayers = layers;
        addWall(stage, "c = vec3(1.0);", -3, 8);
        const char* const kTints[] = { "vec3(1.0 / 2.0)", "vec3(1.0 / 3.0)", "vec3(1.0 / 5.0)", "vec3(1.0 / 7.0)" };
        for (int i = 0; i < panes; ++i) {
            const std::string tint = fmt::format("material.baseColor.rgb = {};", kTints[i]);
            stage.add(stage.material(text(kSheet, kNothing + tint), kNoLights),
                      { { .z = 0.4f * static_cast<float>(i) } });
        }
    }));
}

TEST(PictureRefraction, EachOfTheNearestLayersShowsThePanesBehindIt) {
    for (const uint8_t samples : { uint8_t{ 1 }, uint8_t{ 4 } }) {
        EXPECT_NEAR(throughPanes(4, 1, samples).x, 1 / 7.0f, 1e-3f) << "the nearest shows the wall";
        EXPECT_NEAR(throughPanes(4, 2, samples).x, 1 / (5.0f * 7.0f), 1e-3f) << "the nearest of those that share one";
        EXPECT_NEAR(throughPanes(4, 3, samples).x, 1 / (3.0f * 5.0f * 7.0f), 1e-3f);
        EXPECT_NEAR(throughPanes(4, 4, samples).x, 1 / (2.0f * 3.0f * 5.0f * 7.0f), 1e-3f);
        EXPECT_NEAR(throughPanes(2, 8, samples).x, 1 / 6.0f, 1e-3f);
    }
}

TEST(PictureRefraction, LayersChangeNoBitWhereOneObjectRefracts) {
    const auto draw = [&](uint8_t layers) {
        return seen({ 64, 48 }, [&](MaterialStage& stage) {
            stage.view.quality.refractionLayers = layers;
            addWall(stage, kPattern, -1, 1.5f);
            stage.add(stage.material(text(kBlock, "material.roughness = 0.2; material.thickness = 0.4;"), kNoLights),
                      { { .halfSide = 0.8f } });
        });
    };
    EXPECT_EQ(test::differingPixels(draw(1), draw(8)), 0u);
}

TEST(PictureRefraction, EveryBlurredLevelHasATimeOfItsOwn) {
    auto engine = test::makeEngine(Backend::Vulkan);
    ASSERT_TRUE(engine);
    MaterialStage stage(*engine);
    stage.view.size = { 512, 384 };
    addWall(stage, kPattern, -1, 2);
    stage.add(stage.material(text(kSheet, kNothing), kNoLights), { { .halfSide = 1 } });
    Renderer renderer(*engine, { .passTimers = true });
    for (int i = 0; i < 2; ++i) ASSERT_TRUE(renderer.renderToImage(stage.scene, stage.view).ok());
    std::vector<double> times;
    for (EffectDecision const& one : renderer.decisions()) {
        if (one.name == "scene color blur") times.push_back(one.gpuMilliseconds);
    }
    ASSERT_GE(times.size(), 5u);
    for (const double time : times) EXPECT_GT(time, 0);
    test::expectNoErrors(*engine);
}

/// Draws the same scene with two qualities.
struct TwoFrames {
    Image first, second;
    FrameStatistics before, after;
    std::string explanation;
};

TwoFrames withAndWithout(Backend backend, std::string_view properties) {
    TwoFrames frames;
    auto engine = test::makeEngine(backend);
    if (!engine) return frames;
    MaterialStage stage(*engine);
    stage.view.size = { 48, 32 };
    addWall(stage, kPattern, -1, 2);
    test::SkyObjects sky(stage, test::kDirectionSky);
    test::addSphere(stage, stage.material(text(properties, "material.roughness = 0.2;"), kNoLights));
    Renderer renderer(*engine);
    for (const auto source : { RefractionSource::Environment, RefractionSource::Screen }) {
        stage.view.quality.refraction = source;
        auto image = renderer.renderToImage(stage.scene, stage.view);
        EXPECT_TRUE(image.ok());
        frames.before = std::exchange(frames.after, renderer.statistics());
        frames.first = std::exchange(frames.second, image ? std::move(*image) : Image{});
    }
    frames.explanation = renderer.explain();
    test::expectNoErrors(*engine);
    return frames;
}

TEST(PictureRefraction, OffItIsTheRefractionOfTheEnvironment) {
    for (const Backend backend : test::kBothApis) {
        const TwoFrames screen = withAndWithout(backend, kBlock),
                        cube = withAndWithout(backend, "refractionMode : cubemap");
        EXPECT_EQ(screen.first.pixels, cube.first.pixels) << "refraction=environment";
        EXPECT_NE(screen.second.pixels, cube.second.pixels) << "refraction=screen";
        EXPECT_GT(screen.after.passesRun, screen.before.passesRun);
        EXPECT_NE(screen.explanation.find("1 in view sees the picture, of which "), std::string::npos)
                << screen.explanation;
        EXPECT_NE(screen.explanation.find("scene color blur"), std::string::npos);
    }
}

TEST(PictureRefraction, CostsNothingWithoutRefractiveMaterials) {
    for (const Backend backend : test::kBothApis) {
        const TwoFrames frames = withAndWithout(backend, "refractionMode : cubemap");
        EXPECT_EQ(frames.first.pixels, frames.second.pixels);
        EXPECT_EQ(frames.before.passesRun, frames.after.passesRun);
        EXPECT_EQ(frames.before.draws, frames.after.draws);
        EXPECT_NE(frames.explanation.find("nothing in view refracts the picture"), std::string::npos);
    }
}

} // namespace
} // namespace filament_core
