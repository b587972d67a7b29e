// SPDX-License-Identifier: Apache-2.0
// Layers in images: what a view does not show is, to the bit, not there: neither it nor its shadow.
#include "tests/filament_core/engine/ShadowStage.h"

#include <gmock/gmock.h>

namespace filament_core {
namespace {

using prepare::Random;

constexpr uint2 kLayersSize(48, 48);
constexpr Layers kShownLayers = 0b0010'0101; // with the plane's, the default

/// Boxes over a plane, each in some layers; `only`: those of `kShownLayers` alone, all in the default layer.
void addBoxes(test::ShadowStage& stage, Scene& scene, uint32_t seed, bool only) {
    Random random(seed);
    stage.square.add(scene, stage.white, { 0, 0, 0 }, 4);
    for (int i = 0; i < 12; ++i) {
        const auto layers = static_cast<Layers>(1u << random.next() % 8 | 1u << random.next() % 8);
        const double3 at(random.within(-2.5, 2.5), random.within(-2.5, 2.5), random.within(0.3, 2));
        double4x4 world(random.within(0.2, 0.8));
        world[3] = double4(at, 1);
        if (only && (layers & kShownLayers) == 0) continue;
        const Renderable box = stage.square.add(scene, stage.white, world);
        if (!only) scene.setLayers(box, kAllLayers, layers);
    }
    scene.add(SunLight{ .directionWorld = { 0.3f, 0.4f, -1 }, .illuminance = Lux{ 20'000 } });
    scene.add(PointLight{ .positionWorld = { 0, 0, 4 }, .intensity = Candela{ 20'000 }, .rangeMeters = 12 });
}

Image drawn(test::ShadowStage& stage, ShadowFilter filter, uint32_t seed, bool only) {
    Scene scene(stage.engine);
    addBoxes(stage, scene, seed, only);
    View view = test::shadowedView({ 0, -5, 6 }, { 0, 0, 0.5 }, filter, kLayersSize);
    if (!only) {
        view.visibleLayers = kShownLayers;
        // Far away, so that it would change the fit of the sun's maps.
        const Renderable far = stage.square.add(scene, stage.white, { 300, 200, -50 }, 20);
        scene.setLayers(far, kAllLayers, static_cast<Layers>(0xFF ^ kShownLayers));
    }
    return test::renderLinear(stage.engine, scene, view);
}

TEST(Layers, WhatAViewHidesIsNotThereToTheBitOnBothApis) {
    for (const ShadowFilter filter :
         { ShadowFilter::Off, ShadowFilter::Pcf3, ShadowFilter::Evsm, ShadowFilter::Pcss }) {
        std::vector<std::byte> first;
        for (const Backend backend : test::kBothApis) {
            test::ShadowStage stage(backend);
            const Image hidden = drawn(stage, filter, 7, false), absent = drawn(stage, filter, 7, true);
            EXPECT_EQ(test::differingPixels(hidden, absent), 0u) << toString(backend) << " " << toString(filter);
            if (first.empty()) first = hidden.pixels;
            EXPECT_EQ(hidden.pixels, first) << toString(filter);
        }
    }
}

struct LayersTest : testing::TestWithParam<Backend> {
    test::ShadowStage stage{ GetParam() };
    Scene scene{ stage.engine };
    View view = test::shadowedView({ 0, -5, 6 }, { 0, 0, 0 }, ShadowFilter::Hard, kLayersSize);

    LayersTest() { scene.add(SunLight{ .directionWorld = { 0, 0, -1 }, .illuminance = Lux{ 20'000 } }); }
    Image draw() { return test::renderLinear(stage.engine, scene, view); }
};
INSTANTIATE_TEST_SUITE_P(BothApis, LayersTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

TEST_P(LayersTest, ANodePassesLayersToAllBelowItAndEachViewChoosesItsOwn) {
    const Image empty = draw();
    const Node root = scene.add(NodeDesc{}), child = scene.add(NodeDesc{ .parent = root });
    const Renderable square = scene.add({ .vertices = stage.square.vertices(),
                                          .indices = stage.square.indices(),
                                          .material = stage.white,
                                          .bounds = Box{ double3(-1), double3(1) },
                                          .node = child,
                                          .layers = 0b11 });
    const Image shown = draw();
    EXPECT_GT(test::differingPixels(shown, empty), 100u);
    scene.setLayers(root, 0b11, 0b10);
    EXPECT_EQ(scene.layers(square), 0b10);
    view.visibleLayers = 0b01;
    EXPECT_EQ(test::differingPixels(draw(), empty), 0u);
    view.visibleLayers = 0b10;
    EXPECT_EQ(test::differingPixels(draw(), shown), 0u);
    scene.setLayers(square, kAllLayers, 0);
    view.visibleLayers = kAllLayers;
    EXPECT_EQ(test::differingPixels(draw(), empty), 0u) << "in no layer: in no view";
    scene.setLayers(root, 0b1000, kAllLayers);
    EXPECT_EQ(test::differingPixels(draw(), shown), 0u);
}

TEST_P(LayersTest, AViewThatBeginsToHideACasterDrawsItsShadowMapAgain) {
    stage.square.add(scene, stage.white, { 0, 0, 0 }, 4);
    const Image bare = draw();
    const Renderable caster = stage.square.add(scene, stage.white, { 0, 0, 1 }, 0.5);
    scene.setLayers(caster, kAllLayers, 0b100);
    Renderer renderer(stage.engine);
    const Owned<SwapChain> target = stage.engine.own(
            stage.engine.create(SwapChainDesc{ .size = view.size, .imageCount = 1, .format = Format::RGBA16F }));
    const auto frame = [&](Layers visible) {
        view.visibleLayers = visible;
        renderer.render(scene, view, target);
        return *renderer.waitPixels(renderer.readPixels(target));
    };
    const Image with = frame(kAllLayers);
    EXPECT_GT(test::differingPixels(with, bare), 20u);
    EXPECT_EQ(test::differingPixels(frame(kDefaultLayers), bare), 0u);
    EXPECT_EQ(renderer.statistics().culled, 1u);
    EXPECT_THAT(renderer.explain(), testing::HasSubstr("1 not drawn: the view hides their layers"));
    EXPECT_EQ(test::differingPixels(frame(kAllLayers), with), 0u);
}

TEST_P(LayersTest, FramesThatAreGatheredFollowAChangeOfTheLayers) {
    stage.square.add(scene, stage.white, { 0, 0, 0 }, 4);
    scene.setLayers(stage.square.add(scene, stage.white, { 0, 0, 1 }, 0.5), kAllLayers, 0b100);
    view.quality.antiAliasing = AntiAliasing::Taa;
    view.visibleLayers = kDefaultLayers;
    Renderer renderer(stage.engine);
    const Owned<SwapChain> target = stage.engine.own(
            stage.engine.create(SwapChainDesc{ .size = view.size, .imageCount = 1, .format = Format::RGBA16F }));
    const auto after = [&](int frames) {
        for (int i = 0; i < frames; ++i) renderer.render(scene, view, target);
        return test::halfPixel(*renderer.waitPixels(renderer.readPixels(target)), 24, 24).x;
    };
    const float bare = after(64);
    view.visibleLayers = kAllLayers;
    const float covered = after(12);
    view.visibleLayers = kDefaultLayers;
    EXPECT_NEAR(after(12), bare, 0.05f * bare);
    EXPECT_NE(covered, bare);
}

} // namespace
} // namespace filament_core
