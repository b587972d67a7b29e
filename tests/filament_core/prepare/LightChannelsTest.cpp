// SPDX-License-Identifier: Apache-2.0
// Which lights each draw gets: random masks against the rule itself, and nothing at all where everything shares channel
// 0.
#include "filament_core/prepare/LightChannels.h"
#include "shaders/package/Package.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace filament_core::prepare {
namespace {

using scene::LightRecord;

struct ChannelScene : BoxScene {
    jobs::JobSystem jobs{ { .workers = 2 } };
    Arena arena;

    void addBox(double x, uint8_t channels, scene::MaterialInstance const* instance) {
        double4x4 world(1.0);
        world[3] = double4(x, 0, 0, 1);
        scene::RenderableInput input = box(world, instance, 1);
        input.properties.lightChannels = channels;
        addRenderable(scene, input);
    }

    void addLamp(LightRecord::Type type, uint8_t channels, float intensity, float range = 0) {
        addLight(scene, { .type = type,
                          .positionWorld = { 0, 1, 2 },
                          .intensity = intensity,
                          .rangeMeters = range,
                          .outerConeRadians = 1,
                          .channels = channels });
    }

    FramePacket prepare() {
        const ViewInput view{ .camera = Camera::lookAt({ 0, 0, 30 }, { 0, 0, 0 }, { .verticalFovDegrees = 60 }),
                              .size = { 256, 256 },
                              .quality = { .shadows = ShadowFilter::Off } };
        return prepareFrame(jobs, arena, scene, view);
    }
};

struct Shining {
    bool sun = false;
    std::vector<float> lights; ///< intensities, which are unique
    friend bool operator==(Shining const&, Shining const&) = default;
};

/// By the rule: what shines on renderables of `channels`.
Shining expectedFor(scene::SceneData const& scene, uint8_t channels) {
    LightRecord const* sun = nullptr;
    for (LightRecord const& light : scene.lights.records) {
        const bool isSun = light.type == LightRecord::Type::Sun && light.channels != 0;
        if (isSun && (!sun || light.intensity > sun->intensity)) sun = &light;
    }
    Shining shining;
    for (LightRecord const& light : scene.lights.records) {
        if ((light.channels & channels) == 0) continue;
        if (&light == sun)
            shining.sun = true;
        else
            shining.lights.push_back(light.intensity);
    }
    return shining;
}

Shining foundFor(ViewPacket const& view, DrawCall const& draw) {
    const uint32_t list = view.channels.of(draw.properties.lightChannels);
    shader::FrameUniforms const& uniforms = list ? view.channels.lists[list - 1].uniforms : view.uniforms;
    const std::span lights = list ? view.channels.lists[list - 1].lights : view.lights;
    const uint8_t variant = view.channels.variantOf(draw, view.variant);
    EXPECT_EQ((variant & shader::kVariantSun) != 0, uniforms.sunDirection.w == 1);
    EXPECT_EQ((variant & shader::kVariantPunctual) != 0, !lights.empty());
    EXPECT_EQ(uniforms.ambient.w, static_cast<float>(lights.size()));
    Shining shining{ .sun = (variant & shader::kVariantSun) != 0 };
    for (shader::PunctualLight const& light : lights)
        shining.lights.push_back(light.colorIntensity.x / view.uniforms.exposure.x);
    return shining;
}

void expectNear(Shining const& found, Shining const& expected) {
    EXPECT_EQ(found.sun, expected.sun);
    ASSERT_EQ(found.lights.size(), expected.lights.size());
    for (size_t i = 0; i < found.lights.size(); ++i)
        EXPECT_NEAR(found.lights[i], expected.lights[i], 1e-4f * expected.lights[i]);
}

uint8_t someChannels(Random& random) {
    const uint32_t kind = random.next() % 4;
    return static_cast<uint8_t>(kind == 0 ? 1 : kind == 1 ? 1u << random.next() % 8 : random.next());
}

TEST(LightChannels, RandomMasksGetExactlyTheLightsWithWhichTheyShareAChannel) {
    size_t lists = 0;
    for (uint32_t seed = 0; seed < 200; ++seed) {
        ChannelScene stage;
        Random random(seed);
        scene::MaterialInstance* const paint = stage.material();
        const uint32_t boxes = 1 + random.next() % 12, lights = random.next() % 20;
        for (uint32_t i = 0; i < boxes; ++i) stage.addBox(i - boxes / 2.0, someChannels(random), paint);
        for (uint32_t i = 0; i < lights; ++i) {
            const auto type = static_cast<LightRecord::Type>(random.next() % 3);
            stage.addLamp(type, someChannels(random), 1.0f + static_cast<float>((i * 7 + seed) % 31),
                          random.next() % 2 ? 100.0f : 0.0f);
        }
        const FramePacket packet = stage.prepare();
        ViewPacket const& view = packet.mainView();
        lists += view.channels.lists.size();
        for (DrawCall const& draw : view.opaque)
            expectNear(foundFor(view, draw), expectedFor(stage.scene, draw.properties.lightChannels));
    }
    EXPECT_GT(lists, 200u) << "too few to mean anything";
}

TEST(LightChannels, WithTheDefaultsThereIsNoListAndNoTable) {
    ChannelScene stage;
    scene::MaterialInstance* const paint = stage.material();
    for (int i = 0; i < 3; ++i) stage.addBox(i, 1, paint);
    stage.addLamp(LightRecord::Type::Sun, 1, 10);
    stage.addLamp(LightRecord::Type::Point, 1, 20);
    const FramePacket packet = stage.prepare();
    EXPECT_TRUE(packet.mainView().channels.lists.empty());
    EXPECT_TRUE(packet.mainView().channels.listOf.empty());
    EXPECT_EQ(packet.mainView().opaque.size(), 1u) << "one instanced draw";
}

TEST(LightChannels, ChannelsThatAllShareMakeNoLists) {
    ChannelScene stage;
    stage.addBox(0, 0b011, stage.material());
    stage.addBox(1, 0b110, stage.material());
    stage.addLamp(LightRecord::Type::Sun, 0b010, 10);
    stage.addLamp(LightRecord::Type::Point, 0b111, 20);
    EXPECT_TRUE(stage.prepare().mainView().channels.listOf.empty());
}

TEST(LightChannels, MasksUnderTheSameLightsShareAList) {
    ChannelScene stage;
    constexpr uint8_t kMasks[] = { 0b0010, 0b0110, 0b0100, 0b0001 };
    for (const uint8_t channels : kMasks) stage.addBox(channels, channels, stage.material());
    stage.addLamp(LightRecord::Type::Point, 0b0001, 10);
    stage.addLamp(LightRecord::Type::Point, 0b1001, 20);
    stage.addLamp(LightRecord::Type::Point, 0b0010, 30);
    // Under the third lamp alone: 2 and 6; under none: 4; under the first two: 1.
    EXPECT_EQ(stage.prepare().mainView().channels.lists.size(), 3u);
}

TEST(LightChannels, ALightThatNothingInViewSharesAChannelWithIsLeftOutAndDemandSaysSo) {
    ChannelScene stage;
    stage.addBox(0, 0b01, stage.material());
    stage.addLamp(LightRecord::Type::Sun, 0b10, 10);
    stage.addLamp(LightRecord::Type::Point, 0b10, 20);
    const FramePacket packet = stage.prepare();
    EXPECT_EQ(packet.mainView().variant, 0);
    EXPECT_TRUE(packet.mainView().lights.empty());
    for (const Effect effect : { Effect::Sun, Effect::LightList }) {
        EXPECT_EQ(packet.demand.of(effect).reason, DemandReason::OtherChannels);
        EXPECT_EQ(describe(effect, packet.demand.of(effect)), "none of 1 is on a channel of what is visible");
    }
}

TEST(LightChannels, ALightOnNoChannelIsSwitchedOffAndARenderableOnNoneIsUnlit) {
    ChannelScene stage;
    stage.addBox(0, 0, stage.material());
    stage.addBox(1, 1, stage.material());
    stage.addLamp(LightRecord::Type::Sun, 0, 100);
    stage.addLamp(LightRecord::Type::Sun, 1, 10);
    const FramePacket packet = stage.prepare();
    ViewPacket const& view = packet.mainView();
    EXPECT_EQ(view.counts.suns, 1u);
    ASSERT_EQ(view.opaque.size(), 2u);
    for (DrawCall const& draw : view.opaque)
        EXPECT_EQ(view.channels.variantOf(draw, view.variant), draw.properties.lightChannels ? shader::kVariantSun : 0);
}

TEST(LightChannels, UnlitSurfacesMakeNoLists) {
    ChannelScene stage;
    scene::MaterialInstance* const unlit = stage.material();
    unlit->material->package.shading = shader::ShadingModel::Unlit;
    stage.addBox(0, 1, stage.material());
    stage.addBox(1, 2, unlit);
    stage.addLamp(LightRecord::Type::Sun, 1, 10);
    EXPECT_TRUE(stage.prepare().mainView().channels.listOf.empty());
}

TEST(LightChannels, AChangeOfChannelsMovesARenderableToAnotherDraw) {
    ChannelScene stage;
    scene::MaterialInstance* const paint = stage.material();
    const Renderable a = stage.add(double3(0, 0, 0), paint);
    stage.add(double3(1, 0, 0), paint);
    EXPECT_EQ(stage.prepare().mainView().opaque.size(), 1u);
    scene::setLightChannels(stage.scene.renderables, a, 4);
    EXPECT_EQ(stage.prepare().mainView().opaque.size(), 2u);
    scene::setLightChannels(stage.scene.renderables, a, 1);
    EXPECT_EQ(stage.prepare().mainView().opaque.size(), 1u);
}

} // namespace
} // namespace filament_core::prepare
