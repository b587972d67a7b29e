// SPDX-License-Identifier: Apache-2.0
// Light channels in images: what a square shows under many lights is, to the bit, what it shows under those that
// share a channel with it.
#include "tests/filament_core/engine/materials/MaterialFixture.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <filament_core/Photometry.h>

namespace filament_core {
namespace {

using prepare::Random;

constexpr const char* kChannelClay = R"(material { name : clay, shadingModel : lit }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor.rgb = vec3(0.7, 0.6, 0.5);
    material.roughness = 0.5;
} })";

constexpr uint32_t kSquaresASide = 4, kPicturePixels = 48; // squares and pixels a side

struct ChannelLamp {
    std::variant<SunLight, PointLight, SpotLight> light;
    LightChannels channels = 1;
};

/// Squares side by side, each with channels, under lamps with channels; one of the lamps is a sun.
struct RandomChannels {
    std::array<LightChannels, kSquaresASide * kSquaresASide> squares{};
    std::vector<ChannelLamp> lamps;

    explicit RandomChannels(uint32_t seed) {
        Random random(seed);
        const auto some = [&] {
            return static_cast<LightChannels>(random.next() % 3 ? 1u << random.next() % 3 : random.next());
        };
        for (LightChannels& square : squares) square = some();
        const uint32_t count = 3 + random.next() % 24;
        for (uint32_t i = 0; i < count; ++i) {
            const LightChannels channels = some();
            const double3 at(random.within(-4, 4), random.within(-4, 4), random.within(0.3, 2));
            const float range = random.next() % 4 ? static_cast<float>(random.within(0.5, 4)) : 0.0f;
            const LinearColor color(float3(random.within(0, 1), random.within(0, 1), random.within(0, 1)));
            if (i == 1) {
                lamps.push_back({ SunLight{ .directionWorld = { 0.3f, -0.2f, -1 },
                                            .illuminance = Lux{ 20'000 },
                                            .lightChannels = channels },
                                  channels });
            } else if (random.next() % 2) {
                lamps.push_back({ PointLight{ .positionWorld = at,
                                              .intensity = pointIntensity(Lumen{ 200'000 }),
                                              .color = color,
                                              .rangeMeters = range,
                                              .lightChannels = channels },
                                  channels });
            } else {
                lamps.push_back({ SpotLight{ .positionWorld = at,
                                             .intensity = spotIntensity(Lumen{ 100'000 }),
                                             .color = color,
                                             .rangeMeters = range,
                                             .lightChannels = channels },
                                  channels });
            }
        }
    }
};

struct ChannelStage : test::SquareStage {
    const MaterialInstance paint = instance;

    explicit ChannelStage(Backend backend) : SquareStage(backend, kChannelClay) {}

    static View view() {
        return { .camera = Camera::lookAt({ 0, 0, 4.5 }, { 0, 0, 0 }, { .verticalFovDegrees = 83.2f }),
                 .size = { kPicturePixels, kPicturePixels } };
    }

    /// `only`: all squares are on the default channel, under the lamps that share one with `only`.
    Image draw(RandomChannels const& random, std::optional<LightChannels> only = {}) {
        Scene scene(engine);
        for (uint32_t i = 0; i < kSquaresASide * kSquaresASide; ++i) {
            const double3 at(-3.0 + 2.0 * (i % kSquaresASide), 3.0 - 2.0 * (i / kSquaresASide), 0);
            const Renderable renderable = square.add(scene, paint, at, 0.9);
            if (!only) scene.setLightChannels(renderable, random.squares[i]);
        }
        for (ChannelLamp const& lamp : random.lamps) {
            if (only && (lamp.channels & *only) == 0) continue;
            std::visit(
                    [&](auto light) {
                        if (only) light.lightChannels = kDefaultLightChannels;
                        scene.add(light);
                    },
                    lamp.light);
        }
        return test::renderLinear(engine, scene, view());
    }
};

/// Of the square in row and column of the image, including what is around it.
std::vector<std::byte> cellOf(Image const& image, uint32_t cell) {
    constexpr uint32_t kCell = kPicturePixels / kSquaresASide;
    std::vector<std::byte> bytes;
    for (uint32_t y = 0; y < kCell; ++y) {
        const size_t at =
                (size_t{ cell / kSquaresASide * kCell + y } * kPicturePixels + cell % kSquaresASide * kCell) * 8;
        bytes.insert(bytes.end(), image.pixels.begin() + static_cast<std::ptrdiff_t>(at),
                     image.pixels.begin() + static_cast<std::ptrdiff_t>(at + kCell * 8));
    }
    return bytes;
}

TEST(LightChannels, EverySquareShowsWhatItShowsUnderItsOwnLightsAloneOnBothApis) {
    std::vector<std::byte> first[12];
    for (const Backend backend : test::kBothApis) {
        ChannelStage stage(backend);
        for (uint32_t seed = 0; seed < std::size(first); ++seed) {
            const RandomChannels random(seed);
            const Image together = stage.draw(random);
            ASSERT_FALSE(together.pixels.empty());
            if (first[seed].empty()) first[seed] = together.pixels;
            EXPECT_EQ(together.pixels, first[seed]) << "the two APIs, seed " << seed;
            std::map<LightChannels, Image> alone;
            size_t differFromDefault = 0;
            for (uint32_t i = 0; i < random.squares.size(); ++i) {
                const LightChannels channels = random.squares[i];
                if (!alone.contains(channels)) alone.emplace(channels, stage.draw(random, channels));
                EXPECT_EQ(cellOf(together, i), cellOf(alone.at(channels), i))
                        << toString(backend) << " seed " << seed << " square " << i;
                if (!alone.contains(0xFF))
                    alone.emplace(LightChannels{ 0xFF }, stage.draw(random, LightChannels{ 0xFF }));
                differFromDefault += cellOf(together, i) != cellOf(alone.at(0xFF), i);
            }
            EXPECT_GT(differFromDefault, 4u) << "channels that change nothing prove nothing";
        }
    }
}

TEST(LightChannels, WhatALightDoesNotShineOnStillCastsItsShadow) {
    for (const Backend backend : test::kBothApis) {
        ChannelStage stage(backend);
        const auto shown = [&](bool hasCaster, bool casterIsLit) {
            Scene scene(stage.engine);
            scene.setLightChannels(stage.square.add(scene, stage.paint), 2);
            if (hasCaster) {
                const Renderable caster = stage.square.add(scene, stage.paint, { 1.0, 0, 1.0 }, 0.4);
                scene.setLightChannels(caster, casterIsLit ? 2 : 1);
            }
            scene.add(SunLight{ .directionWorld = { -1, 0, -1 }, .illuminance = Lux{ 50'000 }, .lightChannels = 2 });
            View view = test::SquareMesh::view({ 32, 32 });
            view.camera = Camera::lookAt({ 0, 0, 3 }, { 0, 0, 0 }, { .verticalFovDegrees = 40 });
            view.quality.shadows = ShadowFilter::Hard;
            return test::halfPixel(test::renderLinear(stage.engine, scene, view), 16, 16);
        };
        const float4 lit = shown(false, false), dark = shown(true, false);
        EXPECT_GT(lit.x, 0.1f) << toString(backend);
        EXPECT_EQ(dark.x, 0) << toString(backend);
        EXPECT_EQ(shown(true, true), dark) << toString(backend);
    }
}

TEST(LightChannels, ANodePassesChannelsToAllBelowItAndALightCanChangeItsOwn) {
    auto engine = test::makeEngine(Backend::Vulkan);
    ASSERT_TRUE(engine);
    const test::SquareMesh square(*engine);
    const Owned<Material> material = test::loadMaterial(*engine, kChannelClay);
    const Owned<MaterialInstance> paint = engine->own(engine->createInstance(material));
    Scene scene(*engine);
    const Node root = scene.add(NodeDesc{}), child = scene.add(NodeDesc{ .parent = root });
    scene.add({ .vertices = square.vertices(),
                .indices = square.indices(),
                .material = paint,
                .bounds = Box{ double3(-1), double3(1) },
                .node = child });
    const Light light = scene.add(SunLight{ .directionWorld = { 0, 0, -1 } });
    const auto brightness = [&] {
        return test::halfPixel(test::renderLinear(*engine, scene, test::SquareMesh::view()), 8, 8).x;
    };
    EXPECT_GT(brightness(), 0.1f);
    scene.setLightChannels(root, 0b1000);
    EXPECT_EQ(brightness(), 0);
    scene.setLightChannels(light, 0b1001);
    EXPECT_GT(brightness(), 0.1f);
}

// ---- descriptions that no light can have

TEST(LightsDeathTest, ScenesRefuseLightsThatAreNotNumbersByName) {
    GTEST_FLAG_SET(death_test_style, "threadsafe"); // an engine has threads
    auto engine = test::makeEngine(Backend::Null);
    ASSERT_TRUE(engine);
    Scene scene(*engine);
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    EXPECT_DEATH(scene.add(PointLight{ .intensity = Candela{ -1 } }), "intensity is finite and >= 0");
    EXPECT_DEATH(scene.add(PointLight{ .intensity = Candela{ kNaN } }), "intensity is finite and >= 0");
    EXPECT_DEATH(scene.add(PointLight{ .color = { 1, -1, 1 } }), "color is finite and >= 0");
    EXPECT_DEATH(scene.add(SunLight{ .color = { kNaN, 1, 1 } }), "color is finite and >= 0");
    EXPECT_DEATH(scene.add(PointLight{ .rangeMeters = kNaN }), "range is finite and >= 0");
    EXPECT_DEATH(scene.add(SpotLight{ .rangeMeters = -1 }), "range is finite and >= 0");
    EXPECT_DEATH(scene.add(PointLight{ .positionWorld = { 0, std::nan(""), 0 } }), "position is finite");
    EXPECT_DEATH(scene.add(SunLight{ .directionWorld = { 0, 0, 0 } }), "direction is finite and not zero");
    EXPECT_DEATH(scene.add(SunLight{ .directionWorld = { 0, kNaN, 0 } }), "direction is finite and not zero");
    EXPECT_DEATH(scene.add(SunLight{ .color = LinearColor(kNaN) }), "color is finite");
    EXPECT_DEATH(scene.add(SpotLight{ .directionWorld = { 0, kNaN, 0 } }), "direction is finite and not zero");
    EXPECT_DEATH(scene.add(SpotLight{ .innerConeRadians = 0.5f, .outerConeRadians = 0.4f }), "0 <= inner < outer");
}

TEST(LightsDeathTest, ScenesRefuseAreasThatAreNotNumbersByName) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    auto engine = test::makeEngine(Backend::Null);
    ASSERT_TRUE(engine);
    Scene scene(*engine);
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
    EXPECT_DEATH(scene.add(RectLight{ .color = { 1, 1, -1 } }), "color is finite and >= 0");
    EXPECT_DEATH(scene.add(DiscLight{ .color = { kNaN, 1, 1 } }), "color is finite and >= 0");
    EXPECT_DEATH(scene.add(TubeLight{ .color = { 1, kInfinity, 1 } }), "color is finite and >= 0");
    EXPECT_DEATH(scene.add(RectLight{ .rangeMeters = -1 }), "range is finite and >= 0");
    EXPECT_DEATH(scene.add(DiscLight{ .rangeMeters = kInfinity }), "range is finite and >= 0");
    EXPECT_DEATH(scene.add(TubeLight{ .rangeMeters = kNaN }), "range is finite and >= 0");
    EXPECT_DEATH(scene.add(RectLight{ .positionWorld = { std::nan(""), 0, 0 } }), "position is finite");
    EXPECT_DEATH(scene.add(DiscLight{ .positionWorld = { 0, HUGE_VAL, 0 } }), "position is finite");
    EXPECT_DEATH(scene.add(TubeLight{ .positionWorld = { 0, 0, -HUGE_VAL } }), "position is finite");
    EXPECT_DEATH(scene.add(RectLight{ .directionWorld = { 0, 0, 0 } }), "direction is finite and not zero");
    EXPECT_DEATH(scene.add(DiscLight{ .radiusMeters = -1 }), "finite and not negative");
}

} // namespace
} // namespace filament_core
