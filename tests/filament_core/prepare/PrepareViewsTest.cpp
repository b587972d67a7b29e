// SPDX-License-Identifier: Apache-2.0
// Frames of several views: each view is prepared as if it were alone, and shared data exists once.
#include "filament_core/prepare/PrepareFrame.h"

#include "filament_core/scene/SceneSkins.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace filament_core::prepare {
namespace {

using scene::LightRecord;

constexpr uint2 kSize{ 256, 256 };
constexpr Lens kWide{ .verticalFovDegrees = 120 };

struct PrepareViewsTest : testing::Test, BoxScene {
    jobs::JobSystem jobs{ { .workers = 1 } };
    Arena arena;
    const ViewInput front{ .camera = Camera::lookAt({ 0, 0, 10 }, { 0, 0, 0 }, kWide),
                           .size = kSize,
                           .quality = { .shadows = ShadowFilter::Off } };
    const ViewInput back{ .camera = Camera::lookAt({ 0, 0, 10 }, { 0, 0, 20 }, kWide),
                          .size = kSize,
                          .quality = { .shadows = ShadowFilter::Off } };

    FramePacket prepare(std::span<const ViewInput> views) { return prepareFrame(jobs, arena, scene, views); }
    ViewPacket prepareOne(ViewInput const& view) { return prepareFrame(jobs, arena, scene, view).mainView(); }

    static ViewInput as(ViewKind kind, ViewInput view) {
        view.kind = kind;
        return view;
    }

    /// A hash of one view's part of a packet.
    static uint64_t hashOf(FramePacket const& packet, size_t view) {
        FramePacket part;
        part.views = packet.views.subspan(view, 1);
        return hashPacket(part);
    }

    /// Boxes on both sides of the camera, some of them blended, and more lights than a view accepts.
    void addCrowd(uint32_t count) {
        const std::array looks{ material(), material(), material(shader::Blending::Transparent) };
        Random random(count);
        for (uint32_t i = 0; i < count; ++i) {
            const double3 at(random.within(-60, 60), random.within(-60, 60), random.within(-80, 100));
            add(at, looks[random.next() % 3], random.next() % 5);
        }
        for (int i = 0; i < 400; ++i) {
            addLight(scene, { .type = LightRecord::Type::Point,
                              .positionWorld = { random.within(-60, 60), 0, random.within(-80, 100) },
                              .intensity = static_cast<float>(random.within(1, 100)),
                              .rangeMeters = 20 });
        }
        addLight(scene, { .type = LightRecord::Type::Sun, .intensity = 110'000 });
    }

    std::vector<ViewInput> everyKind() const {
        return { front, back, as(ViewKind::Depth, front), as(ViewKind::Shadow, back) };
    }
};

/// Parallel rays: `halfWidth` metres to each side, from the camera to `depth` metres.
float4x4 parallelProjection(float halfWidth, float depth) {
    float4x4 clip(1.0f);
    clip[0][0] = 1 / halfWidth;
    clip[1][1] = -1 / halfWidth;
    clip[2][2] = 1 / depth;
    clip[3][2] = 1;
    return clip;
}

// More than one range each of culling (2048), merging (4096) and sorting (16 Ki).
TEST_F(PrepareViewsTest, FramesOfManyViewsAreTheSameForAnyNumberOfWorkers) {
    addCrowd(150'000);
    const std::vector<ViewInput> views = everyKind();
    uint64_t reference = 0;
    for (const int workers : { 0, 1, 2, 3, 16 }) {
        jobs::JobSystem other({ .workers = workers });
        arena.reset();
        const FramePacket packet = prepareFrame(other, arena, scene, views);
        ASSERT_GT(packet.views[0].objects.size(), 2u * 16 * 1024) << "not enough to sort in ranges";
        const uint64_t hash = hashPacket(packet);
        if (workers == 0) reference = hash;
        EXPECT_EQ(hash, reference) << workers << " workers";
    }
}

TEST_F(PrepareViewsTest, AViewIsPreparedAsIfItWereAlone) {
    addCrowd(5000);
    const std::vector<ViewInput> views = everyKind();
    const FramePacket together = prepare(views);
    ASSERT_EQ(together.views.size(), views.size());
    for (size_t i = 0; i < views.size(); ++i) {
        const FramePacket alone = prepareFrame(jobs, arena, scene, views[i]);
        EXPECT_EQ(hashOf(together, i), hashOf(alone, 0)) << "view " << i;
        for (size_t other = 0; other < i; ++other) EXPECT_NE(hashOf(together, i), hashOf(together, other));
    }
}

TEST_F(PrepareViewsTest, LightsAreThoseOfTheViewsOwnCamera) {
    add({ 0, 0, 0 }, material()), add({ 0, 0, 25 }, material()); // lit, one in each view
    addLight(scene,
             { .type = LightRecord::Type::Point, .positionWorld = { 0, 0, 0 }, .intensity = 1, .rangeMeters = 5 });
    addLight(scene,
             { .type = LightRecord::Type::Point, .positionWorld = { 0, 0, 25 }, .intensity = 1, .rangeMeters = 5 });
    const FramePacket packet = prepare(std::array{ front, back });
    ASSERT_EQ(packet.views[0].lights.size(), 1u);
    ASSERT_EQ(packet.views[1].lights.size(), 1u);
    EXPECT_EQ(float3(packet.views[0].lights[0].positionRange), float3(0, 0, -10));
    EXPECT_EQ(float3(packet.views[1].lights[0].positionRange), float3(0, 0, 15));
}

TEST_F(PrepareViewsTest, WhatIsNotShadedHasNoLightsAndNothingThatBlends) {
    add({ 0, 0, 0 }, material());
    add({ 1, 0, 0 }, material(shader::Blending::Masked));
    add({ 2, 0, 0 }, material(shader::Blending::Transparent));
    addLight(scene, { .type = LightRecord::Type::Sun, .intensity = 110'000 });
    addLight(scene, { .type = LightRecord::Type::Point, .intensity = 1 });
    const ViewPacket color = prepareOne(front);
    EXPECT_EQ(color.variant, shader::kVariantSun | shader::kVariantPunctual);
    EXPECT_EQ(color.counts.visible, 3u);
    for (const ViewKind kind : { ViewKind::Depth, ViewKind::Shadow }) {
        const ViewPacket packet = prepareOne(as(kind, front));
        EXPECT_EQ(packet.kind, kind);
        EXPECT_EQ(packet.variant, 0);
        EXPECT_TRUE(packet.lights.empty());
        EXPECT_EQ(packet.uniforms.ambient.w, 0.0f) << "no lights";
        EXPECT_EQ(packet.uniforms.sunDirection.w, 0.0f) << "no sun";
        EXPECT_EQ(packet.opaque.size(), 2u);
        EXPECT_TRUE(packet.blended.empty());
        EXPECT_EQ(packet.objects.size(), 2u);
        EXPECT_EQ(packet.counts.visible, 2u);
        EXPECT_EQ(packet.counts.blendedLeftOut, kind == ViewKind::Depth ? 1u : 0u);
        EXPECT_EQ(packet.counts.triangles, 2u * 12);
    }
}

TEST_F(PrepareViewsTest, AViewMayBringAProjectionOfItsOwn) {
    auto* look = material();
    add({ 0, 0, 0 }, look);
    add({ 40, 0, 0 }, look); // beside what the lens sees
    EXPECT_EQ(prepareOne(front).counts.visible, 1u);
    ViewInput sun = as(ViewKind::Shadow, front);
    sun.clipFromView = parallelProjection(50, 100);
    const ViewPacket packet = prepareOne(sun);
    EXPECT_EQ(packet.counts.visible, 2u);
    const float4 corner = packet.uniforms.clipFromWorld * float4(50, -50, -25, 1); // relative to the camera
    EXPECT_EQ(corner, float4(1, 1, 0.75f, 1));
    sun.clipFromView = parallelProjection(30, 100);
    EXPECT_EQ(prepareOne(sun).counts.visible, 1u);
}

TEST_F(PrepareViewsTest, ADeformationIsPlacedOnceForAllViewsThatSeeIt) {
    const auto deformed = [&](double3 at) {
        const Skin skin = scene::addSkin(scene, { .bones = std::vector<shader::BoneData>(4) });
        scene::setBones(scene, skin, std::vector(4, float4x4(glm::translate(double4x4(1.0), at))));
        const scene::RenderableInput input = box(double4x4(1.0), material(), 1);
        addDeformed(scene, input, { .skin = skin, .jointSets = 1, .restBounds = { input.boundsMin, input.boundsMax } });
    };
    deformed({ 0, 0, 0 });
    deformed({ 0, 0, 20 });
    deformed({ 1e5, 0, 10 });
    const auto bones = [&](std::initializer_list<ViewInput> views) {
        return prepare(std::vector<ViewInput>(views)).deformations.boneCount;
    };
    const uint32_t one = bones({ front });
    EXPECT_EQ(one, 4u);
    EXPECT_EQ(bones({ back }), one);
    EXPECT_EQ(bones({ front, as(ViewKind::Shadow, front), as(ViewKind::Depth, front) }), one) << "seen three times";
    EXPECT_EQ(bones({ front, as(ViewKind::Shadow, back) }), 2 * one) << "the second is seen by the shadow alone";
}

TEST_F(PrepareViewsTest, TheHashTellsViewsOfDifferentKindsAndOrders) {
    const uint64_t forth = hashPacket(prepare(std::array{ front, back }));
    EXPECT_NE(hashPacket(prepare(std::array{ back, front })), forth);
    EXPECT_NE(hashPacket(prepare(std::array{ front, as(ViewKind::Shadow, back) })), forth);
    EXPECT_NE(hashPacket(prepare(std::array{ front, as(ViewKind::Shadow, back) })),
              hashPacket(prepare(std::array{ front, as(ViewKind::Depth, back) })));
}

using PrepareViewsDeathTest = PrepareViewsTest;
TEST_F(PrepareViewsDeathTest, AFrameWithoutAViewIsRefused) { EXPECT_DEATH(prepare({}), "a frame has a main view"); }

} // namespace
} // namespace filament_core::prepare
