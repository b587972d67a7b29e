// SPDX-License-Identifier: Apache-2.0
// Transparent objects, on both APIs, against every pixel's surfaces sorted and blended on the CPU: sorted, weighted
// means and peeled layers; ties, places, samples, and what must not change anything.
#include "filament_core/prepare/SceneDemand.h"
#include "tests/filament_core/engine/SkyStage.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <gmock/gmock.h>

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace filament_core {
namespace {

using prepare::Random;
using test::halfPixel;
using test::MaterialStage;
using test::onBothApis;

constexpr uint32_t kPanesSide = 32;
constexpr float3 kBehindPanes{ 0.25f, 0.5f, 0.125f };

/// A plane of one colour across the whole image; `color` is multiplied by its alpha.
struct Pane {
    float4 color{ 0 };
    double z = 0;                ///< of its middle, where it is sorted
    double tiltX = 0, tiltY = 0; ///< radians
    double3 middle() const { return { 0, 0, z }; }
    double4x4 turned() const {
        return glm::rotate(glm::rotate(double4x4(1), tiltY, double3(0, 1, 0)), tiltX, double3(1, 0, 0));
    }
    double4x4 world() const { return glm::translate(double4x4(1), middle()) * turned(); }
    test::Square square() const { return { .color = color, .halfSide = 300 }; }
};

Pane paneOf(float3 color, float alpha, double z, double tiltX = 0, double tiltY = 0) {
    return { { color * alpha, alpha }, z, tiltX, tiltY };
}

std::string paneMaterial(std::string_view properties = "blending : transparent") {
    return test::text(fmt::format("shadingModel : unlit, requires : [ color ], doubleSided : true, {}", properties),
                      "material.baseColor = getColor();");
}

Quality composedBy(TransparencyOrder order, uint8_t layers = 4) {
    return { .transparency = order, .transparencyLayers = layers };
}

void showPanes(MaterialStage& stage, std::vector<Pane> const& panes, Quality const& quality) {
    stage.view.size = uint2(kPanesSide);
    stage.view.clearColor = float4(kBehindPanes, 1);
    stage.view.quality = quality;
    const MaterialInstance material = stage.material(paneMaterial(), test::kNoLights);
    for (Pane const& pane : panes) stage.add(material, { pane.square() }, pane.world());
}

Image pictureOfPanes(std::vector<Pane> const& panes, Quality const& quality) {
    return onBothApis([&](MaterialStage& stage) { showPanes(stage, panes, quality); });
}

/// Along the ray through the middle of a pixel of the stage's view; infinity: it does not meet the pane.
double distanceToPane(Pane const& pane, uint32_t x, uint32_t y) {
    const double3 eye(0, 0, 4), ray(test::directionThrough(x, y, kPanesSide));
    const double3x3 axes(pane.turned());
    const double t = glm::dot(axes[2], pane.middle() - eye) / glm::dot(axes[2], ray);
    const double3 off = eye + ray * t - pane.middle();
    const double farthest = std::max(std::abs(glm::dot(axes[0], off)), std::abs(glm::dot(axes[1], off)));
    return t > 0 && farthest < pane.square().halfSide ? t : HUGE_VAL;
}

/// Whether two planes are so near each other there that rounding may decide.
bool isUnclear(std::vector<Pane> const& panes, uint32_t x, uint32_t y) {
    for (size_t i = 0; i < panes.size(); ++i)
        for (size_t k = 0; k < i; ++k)
            if (std::abs(distanceToPane(panes[i], x, y) - distanceToPane(panes[k], x, y)) < 1e-4) return true;
    return false;
}

float3 truthAt(std::vector<Pane> const& panes, uint32_t x, uint32_t y, float3 behind = kBehindPanes) {
    std::vector<std::pair<double, float4>> surfaces;
    for (Pane const& pane : panes) surfaces.emplace_back(distanceToPane(pane, x, y), pane.color);
    std::ranges::stable_sort(surfaces, std::greater(), [](auto const& surface) { return surface.first; });
    double3 light(behind);
    for (auto const& [distance, color] : surfaces)
        if (distance < HUGE_VAL) light = double3(color) + light * (1.0 - static_cast<double>(color.w));
    return float3(light);
}

struct PaneErrors {
    double largest = 0, rms = 0;
};

PaneErrors errorsOf(Image const& image, std::vector<Pane> const& panes) {
    PaneErrors errors;
    double squares = 0, count = 0;
    for (uint32_t y = 0; y < kPanesSide; ++y) {
        for (uint32_t x = 0; x < kPanesSide; ++x) {
            if (isUnclear(panes, x, y)) continue;
            const float3 difference = float3(halfPixel(image, x, y)) - truthAt(panes, x, y);
            for (int c = 0; c < 3; ++c) {
                errors.largest = std::max(errors.largest, std::abs(static_cast<double>(difference[c])));
                squares += static_cast<double>(difference[c]) * static_cast<double>(difference[c]);
                ++count;
            }
        }
    }
    errors.rms = std::sqrt(squares / std::max(count, 1.0));
    return errors;
}

/// Half floats of colours up to 1, rounded down by one device step for each surface.
double roundingOf(size_t surfaces) { return 1e-3 * static_cast<double>(surfaces + 1); }

const std::vector<Pane> kThreePanes{ paneOf({ 1, 0.2f, 0.1f }, 0.5f, -1), paneOf({ 0.1f, 0.9f, 0.3f }, 0.25f, 0),
                                     paneOf({ 0.2f, 0.1f, 1 }, 0.75f, 1) };

// ---- order

TEST(Transparency, PanesBehindEachOtherAreExactSortedAndPeeledInWhateverOrderTheyAreAdded) {
    std::vector<size_t> order{ 0, 1, 2 };
    do {
        std::vector<Pane> panes;
        for (const size_t i : order) panes.push_back(kThreePanes[i]);
        for (const TransparencyOrder by : { TransparencyOrder::Sorted, TransparencyOrder::Peeled })
            EXPECT_LT(errorsOf(pictureOfPanes(panes, composedBy(by)), panes).largest, roundingOf(3)) << toString(by);
    } while (std::ranges::next_permutation(order).found);
}

TEST(Transparency, AnyNumberOfLayersIsExactWhereSortingIs) {
    for (const uint8_t layers : { uint8_t{ 1 }, uint8_t{ 2 }, uint8_t{ 3 }, uint8_t{ 8 } })
        EXPECT_LT(errorsOf(pictureOfPanes(kThreePanes, composedBy(TransparencyOrder::Peeled, layers)), kThreePanes)
                          .largest,
                  roundingOf(3))
                << int{ layers };
}

TEST(Transparency, PanesThroughEachOtherArePeeledPixelByPixelAndSortedWrong) {
    const std::vector<Pane> panes{ paneOf({ 1, 0, 0 }, 0.6f, 0, 0, 0.6), paneOf({ 0, 0, 1 }, 0.6f, 0, 0, -0.6),
                                   paneOf({ 0, 1, 0 }, 0.5f, 0.1, 0.7, 0) };
    EXPECT_GT(errorsOf(pictureOfPanes(panes, composedBy(TransparencyOrder::Sorted)), panes).largest, 0.1);
    EXPECT_GT(errorsOf(pictureOfPanes(panes, composedBy(TransparencyOrder::Peeled, 2)), panes).largest, 0.05)
            << "the nearest is right, the other two are sorted";
    for (const uint8_t layers : { uint8_t{ 3 }, uint8_t{ 4 } })
        EXPECT_LT(errorsOf(pictureOfPanes(panes, composedBy(TransparencyOrder::Peeled, layers)), panes).largest,
                  roundingOf(3))
                << int{ layers };
}

TEST(Transparency, EqualDistancesKeepTheOrderOfTheScene) {
    const std::vector<Pane> panes{ paneOf({ 1, 0, 0 }, 0.5f, 0), paneOf({ 0, 0, 1 }, 0.5f, 0) };
    const float3 expected = float3(0, 0, 0.5f) + (float3(0.5f, 0, 0) + kBehindPanes * 0.5f) * 0.5f;
    for (const TransparencyOrder by : { TransparencyOrder::Sorted, TransparencyOrder::Peeled }) {
        const Image image = pictureOfPanes(panes, composedBy(by));
        test::expectNear(halfPixel(image, 3, 20), expected, 2e-3f);
    }
}

TEST(Transparency, PriorityAndBlendOrderComeBeforeDistance) {
    struct Placed {
        DrawOrder far, near;
        bool isSwapped;
    };
    for (Placed const& placed :
         { Placed{ {}, {}, false }, Placed{ { .priority = 5 }, {}, true }, Placed{ {}, { .priority = 3 }, true },
           Placed{ { .blendOrder = 2 }, { .blendOrder = 1 }, true },
           Placed{ { .blendOrder = 1 }, { .blendOrder = 2 }, false },
           Placed{ { .priority = 0, .blendOrder = 9 }, { .priority = 7 }, false } }) {
        for (const TransparencyOrder by : { TransparencyOrder::Sorted, TransparencyOrder::Peeled }) {
            const Image image = onBothApis([&](MaterialStage& stage) {
                showPanes(stage, {}, composedBy(by));
                const MaterialInstance material = stage.material(paneMaterial(), test::kNoLights);
                const Renderable near =
                        stage.add(material, { { .color = { 0, 0, 0.5f, 0.5f } } }, Pane{ .z = 1 }.world());
                const Renderable far = stage.add(material, { { .color = { 0.5f, 0, 0, 0.5f } } }, double4x4(1));
                stage.scene.setDrawOrder(near, placed.near);
                stage.scene.setDrawOrder(far, placed.far);
                EXPECT_EQ(stage.scene.drawOrder(far), placed.far);
            });
            const float3 first = placed.isSwapped ? float3(0, 0, 0.5f) : float3(0.5f, 0, 0);
            const float3 second = placed.isSwapped ? float3(0.5f, 0, 0) : float3(0, 0, 0.5f);
            test::expectNear(halfPixel(image, 9, 9), second + (first + kBehindPanes * 0.5f) * 0.5f, 2e-3f);
        }
    }
}

// ---- weighted means

TEST(Transparency, AWeightedMeanOfOneSurfaceOrOfOneColourIsExact) {
    for (const float alpha : { 0.01f, 0.1f, 0.5f, 0.9f, 1.0f }) {
        const std::vector<Pane> panes{ paneOf({ 0.8f, 0.4f, 0.2f }, alpha, 0.5),
                                       paneOf({ 0.8f, 0.4f, 0.2f }, 0.5f, -1, 0.3), // not near the other
                                       paneOf({ 0.8f, 0.4f, 0.2f }, 0.9f, -30) };
        EXPECT_LT(errorsOf(pictureOfPanes(panes, composedBy(TransparencyOrder::Weighted)), panes).largest,
                  roundingOf(3))
                << alpha;
    }
    // Only the left half of the image has the second pane.
    for (const double z : { 3.0, 0.0, -60.0 }) {
        const Pane seen = paneOf({ 0.8f, 0.4f, 0.2f }, 0.3f, z);
        const Image image = onBothApis([&](MaterialStage& stage) {
            showPanes(stage, { seen }, composedBy(TransparencyOrder::Weighted));
            stage.add(stage.material(paneMaterial(), test::kNoLights),
                      { { .color = { 0.1f, 0.1f, 0.5f, 0.5f }, .halfSide = 1 } },
                      Pane{ .z = 3.5 }.world() * glm::translate(double4x4(1), double3(-1, 0, 0)));
        });
        test::expectNear(halfPixel(image, kPanesSide - 1, 7), truthAt({ seen }, kPanesSide - 1, 7), 2e-3f);
        EXPECT_GT(std::abs(halfPixel(image, 0, 7).x - truthAt({ seen }, 0, 7).x), 0.05f);
    }
}

TEST(Transparency, WeightedMeansAndPeeledLayersStayFiniteBesideAMillionNits) {
    for (const TransparencyOrder by : { TransparencyOrder::Weighted, TransparencyOrder::Peeled }) {
        for (const float light : { 0.0f, 6e4f, 1e6f, HUGE_VALF }) {
            const std::vector<Pane> panes{ { { light, light, light, 0.5f }, 1 },
                                           { { 0, 0, 0, 0.5f }, 0.5 },
                                           { { light, 0, 1e-6f, 0.001f }, -20 },
                                           { { light, light, 0, 1 }, -40 } };
            const Image image = onBothApis([&](MaterialStage& stage) {
                showPanes(stage, {}, composedBy(by));
                const std::string code = light == HUGE_VALF
                                                 ? "material.baseColor = getColor(); if (getColor().r > 2.0) "
                                                   "material.baseColor.r = 1.0 / 0.0;"
                                                 : "material.baseColor = getColor();";
                const MaterialInstance material = stage.material(
                        test::text("shadingModel : unlit, requires : [ color ], blending : transparent", code),
                        test::kNoLights);
                for (Pane pane : panes) {
                    pane.color = min(pane.color, float4(1e6f));
                    stage.add(material, { pane.square() }, pane.world());
                }
            });
            if (by == TransparencyOrder::Peeled && light > 6e4f) continue; // as sorted: the device's own infinity
            const test::Extremes found = test::extremesOf(image);
            EXPECT_LE(found.most, 65504) << light;
            EXPECT_GE(found.least, 0) << light;
        }
    }
}

TEST(Transparency, LightWithoutAlphaIsAddedWithinAnEighthOfAPercentOfWhatIsBehind) {
    const Image image = pictureOfPanes({ { { 0.5f, 0.25f, 0, 0 }, 1 }, { { 0, 0, 0.125f, 0 }, 0.5 } },
                                       composedBy(TransparencyOrder::Weighted));
    // Both count as alpha 1/1024, so that the mean of their light, times that, is what each of them adds.
    test::expectNear(halfPixel(image, 4, 4), float3(0.5f, 0.25f, 0.125f) + kBehindPanes, 0.2f);
    const Image one = pictureOfPanes({ { { 0.5f, 0.25f, 0, 0 }, 1 }, { { 0.5f, 0.25f, 0, 0 }, 0.5 } },
                                     composedBy(TransparencyOrder::Weighted));
    test::expectNear(halfPixel(one, 4, 4), float3(1, 0.5f, 0) + kBehindPanes, 6e-3f);
}

/// What they let through is kept as it is: one minus their alpha would have steps of 2^-11, seven times what passes.
TEST(Transparency, LayersLetThroughWhatTheyShouldOfWhatIsBrightBehindThem) {
    constexpr float3 kBright{ 6e4f, 3e4f, 100 };
    std::vector<Pane> panes;
    for (int i = 0; i < 5; ++i) panes.push_back(paneOf({ 0.1f, 0.2f, 0.3f }, 0.85f, 0.5 * i));
    for (const TransparencyOrder by : { TransparencyOrder::Sorted, TransparencyOrder::Peeled }) {
        const Image image = onBothApis([&](MaterialStage& stage) {
            showPanes(stage, panes, composedBy(by, 8));
            stage.view.clearColor = float4(kBright, 1);
        });
        const float3 found(halfPixel(image, 4, 4)), expected = truthAt(panes, 4, 4, kBright);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / expected[c], 1, 0.005) << toString(by) << ' ' << c;
    }
}

// ---- random panes

std::vector<Pane> randomPanes(uint32_t count, double mostAlpha, Random& random) {
    constexpr double kMostTilt = 0.9;
    std::vector<Pane> panes;
    for (uint32_t i = 0; i < count; ++i) {
        float3 color;
        for (int c = 0; c < 3; ++c)
            color[c] = static_cast<float>(random.within(0, 1)); // in one order with all compilers
        const auto alpha = static_cast<float>(random.within(0.05, mostAlpha));
        const double z = random.within(-12, 2), tiltX = random.within(-kMostTilt, kMostTilt);
        panes.push_back(paneOf(color, alpha, z, tiltX, random.within(-kMostTilt, kMostTilt)));
    }
    return panes;
}

struct WayError {
    Quality quality{};
    double squares = 0, largest = 0;
    double rms() const { return std::sqrt(squares); }
};

/// Of the mean of some scenes; prints what docs/transparency.md has in its table.
std::vector<WayError> errorsOfRandomPanes(uint32_t count, double mostAlpha, std::vector<Quality> const& ways) {
    constexpr uint32_t kScenes = 4;
    std::vector<WayError> errors;
    for (Quality const& quality : ways) errors.push_back({ quality });
    Random random(3);
    for (uint32_t scene = 0; scene < kScenes; ++scene) {
        const std::vector<Pane> panes = randomPanes(count, mostAlpha, random);
        for (WayError& way : errors) {
            const PaneErrors found = errorsOf(pictureOfPanes(panes, way.quality), panes);
            way.squares += found.rms * found.rms / kScenes;
            way.largest = std::max(way.largest, found.largest);
        }
    }
    for (WayError const& way : errors)
        std::printf("%u panes, alpha up to %.2f: %s, %d layers: rms %.4f, at most %.3f\n", count, mostAlpha,
                    toString(way.quality.transparency), int{ way.quality.transparencyLayers }, way.rms(), way.largest);
    return errors;
}

TEST(Transparency, PeelingRandomPanesErrsLessWithEveryLayerAndNotAtAllWithAsManyAsPanes) {
    constexpr uint32_t kPanes = 6;
    std::vector<Quality> ways{ {}, composedBy(TransparencyOrder::Weighted) };
    for (const uint8_t layers : { uint8_t{ 2 }, uint8_t{ 3 }, uint8_t{ 4 }, uint8_t{ 6 }, uint8_t{ 8 } })
        ways.push_back(composedBy(TransparencyOrder::Peeled, layers));
    const std::vector<WayError> errors = errorsOfRandomPanes(kPanes, 0.95, ways);
    EXPECT_GT(errors[0].largest, 0.1) << "sorted: planes that reach into each other";
    EXPECT_LT(errors[1].rms(), 0.12) << "weighted";
    EXPECT_LT(errors[2].squares, errors[0].squares) << "two layers against none";
    for (size_t i = 3; i < errors.size(); ++i)
        EXPECT_LT(errors[i].rms(), errors[i - 1].rms() + roundingOf(0)) << i << ": or as much, to within rounding";
    for (const size_t i : { size_t{ 5 }, size_t{ 6 } })
        EXPECT_LT(errors[i].largest, roundingOf(kPanes)) << "as many layers as panes";
}

TEST(Transparency, WeightedMeansOfManyThinPanesErrLittle) {
    const std::vector<WayError> errors = errorsOfRandomPanes(
            16, 0.25, { Quality{}, composedBy(TransparencyOrder::Weighted), composedBy(TransparencyOrder::Peeled) });
    EXPECT_LT(errors[1].rms(), 0.04);
    EXPECT_LT(errors[1].largest, 0.15);
    EXPECT_LT(errors[2].rms(), errors[0].rms()) << "peeled against sorted";
}

// ---- samples, ranges, and other effects

TEST(Transparency, FourSamplesAPixelShowWhatOneDoesWhereNothingHasAnEdge) {
    const std::vector<Pane> panes{ paneOf({ 1, 0, 0 }, 0.6f, 0, 0, 0.6), paneOf({ 0, 0, 1 }, 0.6f, -3) };
    for (const TransparencyOrder by : { TransparencyOrder::Weighted, TransparencyOrder::Peeled }) {
        const auto draw = [&](uint8_t samples) {
            return onBothApis([&](MaterialStage& stage) {
                showPanes(stage, panes, composedBy(by));
                stage.view.samples = samples;
            });
        };
        const Image one = draw(1), four = draw(4);
        for (uint32_t y = 0; y < kPanesSide; ++y)
            for (uint32_t x = 0; x < kPanesSide; ++x)
                test::expectNear(halfPixel(four, x, y), float3(halfPixel(one, x, y)), 2e-3f);
    }
}

TEST(Transparency, OpaqueObjectsHideAndAreSeenThroughPanesAtAnyDepth) {
    const std::vector<Pane> panes{ paneOf({ 1, 0, 0 }, 0.6f, 1.5), paneOf({ 0, 0, 1 }, 0.6f, 0, 0.4, 0.3),
                                   paneOf({ 0, 1, 0 }, 0.5f, -6, 0.2, 0) };
    const float3 wall(0.1f, 0.2f, 0.9f);
    for (const DepthRange range : { DepthRange::Reversed, DepthRange::Ordinary }) {
        for (const DepthPrepass prepass : { DepthPrepass::Auto, DepthPrepass::On }) {
            for (const TransparencyOrder by : { TransparencyOrder::Weighted, TransparencyOrder::Peeled }) {
                const Image image = onBothApis([&](MaterialStage& stage) {
                    Quality quality = composedBy(by);
                    quality.depthRange = range;
                    quality.depthPrepass = prepass;
                    showPanes(stage, panes, quality);
                    stage.add(stage.material(paneMaterial("blending : opaque"), test::kNoLights),
                              { { .color = float4(wall, 1) } }, Pane{ .z = -5 }.world());
                });
                const std::vector<Pane> before(panes.begin(), panes.begin() + 2);
                for (uint32_t y = 0; y < kPanesSide; ++y)
                    for (uint32_t x = 0; x < kPanesSide; ++x)
                        if (!isUnclear(before, x, y))
                            test::expectNear(halfPixel(image, x, y), truthAt(before, x, y, wall),
                                             by == TransparencyOrder::Peeled ? 3e-3f : 0.2f);
            }
        }
    }
}

TEST(Transparency, LitSurfacesInFogArePeeledAsTheyAreSorted) {
    const auto draw = [&](Quality const& quality) {
        return test::underSky(test::kDirectionSky, [&](MaterialStage& stage) {
            showPanes(stage, {}, quality);
            stage.view.effects.fog = { .enabled = true, .density = 0.1f, .color = { 0.1f, 0.5f, 0.9f } };
            const MaterialInstance glass = stage.material(
                    test::text("shadingModel : lit, blending : fade, doubleSided : true, requires : [ color ]",
                               "material.baseColor = getColor(); material.roughness = 0.3;"));
            stage.scene.add(SunLight{ .directionWorld = { 0.2f, -0.4f, -1 }, .illuminance = Lux{ 50'000 } });
            for (Pane const& pane : kThreePanes) stage.add(glass, { pane.square() }, pane.world());
        });
    };
    const Image sorted = draw({}), peeled = draw(composedBy(TransparencyOrder::Peeled)),
                weighted = draw(composedBy(TransparencyOrder::Weighted));
    for (uint32_t y = 0; y < kPanesSide; ++y) {
        for (uint32_t x = 0; x < kPanesSide; ++x) {
            const float3 expected(halfPixel(sorted, x, y));
            test::expectNear(halfPixel(peeled, x, y), expected, 4e-3f * std::max(1.0f, expected.x));
            test::expectNear(halfPixel(weighted, x, y), expected, 0.5f * std::max(1.0f, expected.x));
        }
    }
}

TEST(Transparency, FramesThatAreGatheredAndBloomHaveTheSameBitsOnBothApis) {
    for (const TransparencyOrder by : { TransparencyOrder::Weighted, TransparencyOrder::Peeled }) {
        const Image image = onBothApis([&](MaterialStage& stage) {
            Quality quality = composedBy(by);
            quality.antiAliasing = AntiAliasing::Taa;
            showPanes(stage, kThreePanes, quality);
            stage.view.effects.bloom.enabled = true;
        });
        EXPECT_LT(errorsOf(image, kThreePanes).largest, by == TransparencyOrder::Peeled ? 8e-3 : 0.3);
    }
}

TEST(Transparency, OtherBlendModesStaySorted) {
    for (const TransparencyOrder by :
         { TransparencyOrder::Sorted, TransparencyOrder::Weighted, TransparencyOrder::Peeled }) {
        const auto glowAt = [&](double z) {
            const Image image = onBothApis([&](MaterialStage& stage) {
                const float3 color(0.5f, 0.25f, 0.75f); // of both, so that their weighted mean is exact
                showPanes(stage, { paneOf(color, 0.5f, 1), paneOf(color, 0.5f, -1) }, composedBy(by));
                stage.add(stage.material(paneMaterial("blending : add"), test::kNoLights),
                          { { .color = { 0.5f, 0, 0, 0 } } }, Pane{ .z = z }.world());
            });
            return halfPixel(image, 5, 5).x;
        };
        const float without = 0.5f * 0.75f + kBehindPanes.x * 0.25f;
        EXPECT_NEAR(glowAt(2), without + 0.5f, 2e-3f) << toString(by);
        EXPECT_NEAR(glowAt(-2), without + 0.125f, 2e-3f) << toString(by);
        EXPECT_NEAR(glowAt(0), without + (by == TransparencyOrder::Sorted ? 0.25f : 0.5f), 2e-3f) << toString(by);
    }
}

TEST(Transparency, BothSidesOfAnObjectInTwoPassesAreLayers) {
    const std::string text = paneMaterial("blending : transparent, transparency : twoPassesTwoSides");
    const auto draw = [&](Quality const& quality) {
        return onBothApis([&](MaterialStage& stage) {
            showPanes(stage, {}, quality);
            const MaterialInstance material = stage.material(text, test::kNoLights);
            // Far and near side of each object, and of two objects.
            for (const double z : { -2.0, 1.0 })
                stage.add(material,
                          { { .z = -0.5f, .color = { 0.5f, 0, 0, 0.5f }, .facesCamera = false },
                            { .z = 0.5f, .color = { 0, 0, 0.25f, 0.5f } } },
                          Pane{ .z = z }.world());
        });
    };
    const Image sorted = draw({}), peeled = draw(composedBy(TransparencyOrder::Peeled, 5));
    for (uint32_t i = 0; i < kPanesSide; ++i)
        test::expectNear(halfPixel(peeled, i, i), float3(halfPixel(sorted, i, i)), 2e-3f);
}

// ---- what runs

struct TransparencyFrame {
    std::vector<std::string> passes;
    std::string why;
    uint64_t commands = 0;
};

TransparencyFrame frameOfPanes(std::vector<Pane> const& panes, Quality const& quality) {
    auto engine = Engine::create({ .backend = Backend::Null, .workers = 0 });
    MaterialStage stage(*engine);
    showPanes(stage, panes, quality);
    Renderer renderer(*engine);
    const Owned<SwapChain> target = engine->own(engine->create(SwapChainDesc{ .size = stage.view.size }));
    TransparencyFrame frame;
    for (int i = 0; i < 4; ++i) renderer.render(stage.scene, stage.view, target);
    engine->waitIdle();
    const uint64_t before = engine->statistics().commands;
    renderer.render(stage.scene, stage.view, target);
    engine->waitIdle();
    frame.commands = engine->statistics().commands - before;
    for (EffectDecision const& decision : renderer.decisions()) {
        if (decision.state == EffectDecision::State::Ran) frame.passes.push_back(decision.name);
        if (decision.name == "transparency" && decision.state != EffectDecision::State::Ran)
            frame.why = decision.reason;
    }
    test::expectNoErrors(*engine);
    return frame;
}

TEST(Transparency, FollowsRasterStatesThatChangeBetweenFrames) {
    auto engine = Engine::create({ .backend = Backend::Null, .workers = 0 });
    MaterialStage stage(*engine);
    showPanes(stage, {}, composedBy(TransparencyOrder::Weighted));
    const MaterialInstance material = stage.material(paneMaterial(), test::kNoLights);
    for (Pane const& pane : kThreePanes) stage.add(material, { pane.square() }, pane.world());
    Renderer renderer(*engine);
    const Owned<SwapChain> target = engine->own(engine->create(SwapChainDesc{ .size = stage.view.size }));
    const auto isComposed = [&] {
        renderer.render(stage.scene, stage.view, target);
        return std::ranges::any_of(renderer.decisions(), [](EffectDecision const& decision) {
            return decision.name == "transparency" && decision.state == EffectDecision::State::Ran;
        });
    };
    EXPECT_TRUE(isComposed());
    using Set = void (Engine::*)(MaterialInstance, bool);
    for (const Set set : { &Engine::setColorWrite, &Engine::setDepthCulling }) {
        ((*engine).*set)(material, false);
        EXPECT_FALSE(isComposed());
        ((*engine).*set)(material, true);
        EXPECT_TRUE(isComposed());
    }
    test::expectNoErrors(*engine);
}

TEST(Transparency, RunsOnlyWhereTwoObjectsMayOverlap) {
    using testing::ElementsAre;
    const std::vector<Pane> one{ kThreePanes[0] };
    const TransparencyFrame sorted = frameOfPanes(one, {});
    EXPECT_THAT(sorted.passes, ElementsAre("color", "tone map"));
    for (Quality const& quality : { composedBy(TransparencyOrder::Weighted), composedBy(TransparencyOrder::Peeled) }) {
        const TransparencyFrame frame = frameOfPanes(one, quality);
        EXPECT_EQ(frame.passes, sorted.passes);
        EXPECT_EQ(frame.commands, sorted.commands);
        EXPECT_EQ(frame.why, "1 in view that may be composed in any order");
        EXPECT_EQ(pictureOfPanes(one, quality).pixels, pictureOfPanes(one, {}).pixels);
    }
    EXPECT_THAT(frameOfPanes(kThreePanes, {}).passes, ElementsAre("color", "tone map"));
    EXPECT_THAT(frameOfPanes(kThreePanes, composedBy(TransparencyOrder::Peeled, 1)).passes,
                ElementsAre("color", "tone map"));
    EXPECT_THAT(frameOfPanes(kThreePanes, composedBy(TransparencyOrder::Weighted)).passes,
                ElementsAre("color", "weighted light", "weighted cover", "transparency", "tone map"));
    EXPECT_THAT(frameOfPanes(kThreePanes, composedBy(TransparencyOrder::Peeled, 3)).passes,
                ElementsAre("color", "layer depth", "layer", "layer depth", "layer", "beyond layers", "transparency",
                            "tone map"));
    EXPECT_EQ(frameOfPanes(kThreePanes, composedBy(TransparencyOrder::Peeled, 3)).why,
              "3 in view may overlap; 3 layers");
}

} // namespace
} // namespace filament_core
