// SPDX-License-Identifier: Apache-2.0
// The part of the scene colour that is copied for refraction, and the draws before and after.
#include "filament_core/prepare/SceneColorCopy.h"

#include "tests/filament_core/prepare/BoxScene.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

namespace filament_core::prepare {
namespace {

struct SceneColorCopyTest : testing::Test, BoxScene {
    Arena arena;
    ViewInput view{ .camera = Camera::lookAt({ 0, 0, 10 }, { 0, 0, 0 }, { .verticalFovDegrees = 45 }),
                    .size = { 640, 480 },
                    .quality = { .shadows = ShadowFilter::Off } };

    FramePacket frame() {
        jobs::JobSystem jobs({ .workers = 0 });
        const jobs::AdoptedThread seat(jobs);
        const std::array views{ view };
        return prepareFrame(jobs, arena, scene, views, {});
    }

    /// Of frame(), until the next one.
    ViewPacket const& mainView() { return frame().views[0]; }

    /// Of the one copy of the view; 0: there is none.
    uint32_t copiedPixels() {
        ViewPacket const& packet = mainView();
        return packet.pictures.empty() ? 0 : packet.pictures.front().pixels();
    }

    scene::MaterialInstance* glass(shader::Blending blending = shader::Blending::Opaque) {
        scene::MaterialInstance* look = material(blending);
        look->material->package.refractionMode = shader::RefractionMode::ScreenSpace;
        return look;
    }
};

TEST_F(SceneColorCopyTest, LevelsHalveExactlyAndTheLastHasTwoTexels) {
    for (const uint2 size :
         { uint2(1, 1), uint2(2, 1000), uint2(7, 129), uint2(640, 480), uint2(1280, 720), uint2(8192, 8192) }) {
        const uint8_t levels = pictureLevels(size);
        const uint2 texture = pictureTextureSize(size);
        EXPECT_GE(levels, 1);
        EXPECT_LE(levels, kMostPictureLevels);
        const uint32_t step = 1u << (levels - 1);
        EXPECT_EQ(texture.x % step, 0u);
        EXPECT_EQ(texture.y % step, 0u);
        EXPECT_GE(texture.x, size.x);
        EXPECT_GE(std::min(texture.x, texture.y) / step, 2u);
    }
    EXPECT_EQ(pictureLevels({ 1280, 720 }), 8);
    EXPECT_EQ(pictureLevels({ 1, 1 }), 1);
}

TEST_F(SceneColorCopyTest, ABoxCoversThePixelsOfItsCorners) {
    // The pinhole of 90 degrees at the origin that looks along -z.
    float4x4 clip(0.0f);
    clip[0].x = 1, clip[1].y = -1, clip[2].w = -1, clip[3].z = 0.1f;
    const PixelBox box = projectedBox(clip, { 0, 0, -4 }, { 1, 2, 1 }, { 300, 300 });
    // The near face at distance 3: +-1 / 3 and +-2 / 3 of half the screen.
    EXPECT_NEAR(box.least.x, 100, 1e-3);
    EXPECT_NEAR(box.most.x, 200, 1e-3);
    EXPECT_NEAR(box.least.y, 50, 1e-3);
    EXPECT_NEAR(box.most.y, 250, 1e-3);
    const PixelBox around = projectedBox(clip, { 0, 0, -4 }, { 1, 1, 5 }, { 300, 200 });
    EXPECT_EQ(around.least, float2(0)) << "it reaches behind the camera";
    EXPECT_EQ(around.most, float2(300, 200));
}

TEST_F(SceneColorCopyTest, TheRectangleHoldsTheBoxAndItsReach) {
    Random random(3);
    for (int i = 0; i < 2000; ++i) {
        const uint2 size(1 + random.next() % 2000, 1 + random.next() % 1200);
        const float2 a(random.within(-500, 2500), random.within(-500, 1500)),
                extent(random.within(0, 900), random.within(0, 900));
        const SceneColorCopy copy = copyAround({ a, a + extent }, size);
        const uint32_t step = 1u << (copy.levels - 1);
        ASSERT_GE(copy.levels, 1);
        ASSERT_LE(copy.levels, pictureLevels(size));
        ASSERT_GE(copy.rect.x, 0);
        ASSERT_GE(copy.rect.y, 0);
        ASSERT_EQ(copy.rect.x % step, 0u);
        ASSERT_EQ(copy.rect.width % step, 0u);
        ASSERT_EQ(copy.rect.y % step, 0u);
        ASSERT_EQ(copy.rect.height % step, 0u);
        ASSERT_GE(std::min(copy.rect.width, copy.rect.height) / step, 2u);
        const uint2 texture = pictureTextureSize(size);
        ASSERT_LE(copy.rect.x + copy.rect.width, texture.x);
        ASSERT_LE(copy.rect.y + copy.rect.height, texture.y);
        const float2 least = glm::clamp(a, float2(0), float2(size)),
                     most = glm::clamp(a + extent, float2(0), float2(size));
        ASSERT_LE(static_cast<float>(copy.rect.x), least.x);
        ASSERT_GE(static_cast<float>(copy.rect.x) + static_cast<float>(copy.rect.width), most.x);
        ASSERT_LE(static_cast<float>(copy.rect.y), least.y);
        ASSERT_GE(static_cast<float>(copy.rect.y) + static_cast<float>(copy.rect.height), most.y);
    }
}

TEST_F(SceneColorCopyTest, OnlyTheSurroundingsOfWhatRefractsAreCopied) {
    add(double3(0, 0, 0), material());
    EXPECT_EQ(copiedPixels(), 0u);
    add(double3(0, 0, -2), glass());
    EXPECT_GT(copiedPixels(), 0u);
    EXPECT_LT(copiedPixels(), 640u * 480u);
    add(double3(0, 0, 9.9), glass(), 1, 30); // around the camera
    EXPECT_GE(copiedPixels(), 640u * 480u);
}

TEST_F(SceneColorCopyTest, WhatRefractsIsDrawnAfterTheSkyAndBeforeWhatBlends) {
    scene::MaterialInstance* const late = material();
    late->raster.depthWrite = false;
    scene::MaterialInstance* const onTop = material();
    onTop->raster.depthCulling = false;
    scene::MaterialInstance* const looks[] = {
        material(shader::Blending::Transparent), onTop, glass(), late, material(), glass(shader::Blending::Fade)
    };
    for (int i = 0; i < 6; ++i) add(double3(i - 3, 0, 0), looks[i], 1 + static_cast<uint32_t>(i));
    ViewPacket const& packet = mainView();
    ASSERT_EQ(packet.opaque.size(), 1u);
    ASSERT_EQ(packet.blended.size(), 5u);
    ASSERT_EQ(packet.pictures.size(), 1u);
    EXPECT_EQ(packet.pictures[0].firstDraw, 1u);
    EXPECT_EQ(packet.blended[0].material, late);
    EXPECT_EQ(packet.blended[1].material, looks[2]);
    EXPECT_EQ(packet.blended[2].material, onTop);
    EXPECT_EQ(packet.counts.refractiveDraws, 2u);
}

TEST_F(SceneColorCopyTest, NothingChangesPlacesWhereTheEnvironmentIsRefracted) {
    view.quality.refraction = RefractionSource::Environment;
    add(double3(0, 0, 0), material());
    add(double3(1, 0, 0), glass());
    ViewPacket const& packet = mainView();
    EXPECT_EQ(packet.opaque.size(), 2u);
    EXPECT_TRUE(packet.blended.empty());
    EXPECT_TRUE(packet.pictures.empty());
    EXPECT_FALSE(frame().demand.needs(Effect::Refraction));
}

TEST_F(SceneColorCopyTest, RefractingObjectsAreFrontToBack) {
    scene::MaterialInstance* const look = glass();
    for (const double z : { -3.0, 2.0, -1.0 }) add(double3(0, 0, z), look, 1);
    ViewPacket const& packet = mainView();
    ASSERT_EQ(packet.objects.order.size(), 3u);
    EXPECT_LT(packet.objects.order[0].key, packet.objects.order[1].key);
    EXPECT_EQ(packet.objects.order[0].renderable, 1u);
    EXPECT_EQ(packet.objects.order[2].renderable, 0u);
    EXPECT_EQ(packet.blended.size(), 1u) << "instances of one draw";
}

TEST_F(SceneColorCopyTest, LayersAreBackToFrontAndTheNearestHaveOneEach) {
    scene::MaterialInstance* const look = glass();
    for (const double z : { -3.0, 2.0, -1.0, 0.0, 1.0 }) add(double3(z, 0, z), look, 1);
    add(double3(0, 0, -4), glass(shader::Blending::Fade), 2);
    scene::MaterialInstance* const late = material();
    late->raster.depthWrite = false;
    add(double3(0, 0, 3), late, 3);
    for (const uint8_t layers : { uint8_t{ 2 }, uint8_t{ 3 }, uint8_t{ 5 }, uint8_t{ 8 }, uint8_t{ 255 } }) {
        view.quality.refractionLayers = layers;
        ViewPacket const& packet = mainView();
        ASSERT_EQ(packet.blended.size(), 7u) << "none is an instance of another";
        for (uint32_t i = 0; i < 5; ++i) {
            constexpr uint32_t kByDistance[] = { 0, 2, 3, 4, 1 };
            EXPECT_EQ(packet.objects.order[packet.blended[1 + i].firstObject].renderable, kByDistance[i]);
        }
        const size_t count = std::min<size_t>(layers, 5);
        ASSERT_EQ(packet.pictures.size(), count);
        EXPECT_EQ(packet.pictures[0].firstDraw, 1u);
        for (size_t i = 1; i < count; ++i) EXPECT_EQ(packet.pictures[i].firstDraw, 6 - (count - i));
        EXPECT_GT(packet.pictures[count - 1].pixels(), 0u);
    }
}

TEST_F(SceneColorCopyTest, WithOneObjectOrOnlyBlendedOnesThereIsOneLayer) {
    view.quality.refractionLayers = 4;
    add(double3(0, 0, 0), glass(shader::Blending::Fade), 1);
    EXPECT_EQ(mainView().pictures.size(), 1u);
    add(double3(1, 0, 0), glass(), 2);
    EXPECT_EQ(mainView().pictures.size(), 1u);
}

TEST_F(SceneColorCopyTest, LevelsAreThoseThatTheRoughnessReads) {
    EXPECT_EQ(levelsOfRoughness(0, 1000), 1);
    EXPECT_EQ(levelsOfRoughness(-1, 1000), 1);
    EXPECT_EQ(levelsOfRoughness(1, 1e9f), kMostPictureLevels + 2) << "more than any picture has";
    // A lobe of p pixels reads level log2(2.4 (p^2 + 1/4)) / 2 and the one behind it.
    EXPECT_EQ(levelsOfRoughness(0.1f, 100), 3) << "1.7 pixels: level 1.45";
    EXPECT_EQ(levelsOfRoughness(0.3f, 600), 9) << "92 pixels: level 7.2";
    uint8_t before = 1;
    for (float roughness = 0.02f; roughness < 1; roughness += 0.02f) {
        const uint8_t levels = levelsOfRoughness(roughness, 600);
        EXPECT_GE(levels, before);
        before = levels;
    }
}

TEST_F(SceneColorCopyTest, FewerLevelsLieInTheSameRectangle) {
    scene::MaterialInstance* const look = glass();
    look->parameters.resize(16);
    add(double3(0, 0, 0), look, 1);
    const SceneColorCopy all = mainView().pictures[0];
    look->material->roughnessBound = 4;
    for (const float roughness : { 0.0f, 0.05f, 1.0f, std::numeric_limits<float>::quiet_NaN() }) {
        std::memcpy(look->parameters.data() + 4, &roughness, sizeof(float));
        const SceneColorCopy copy = mainView().pictures[0];
        EXPECT_EQ(copy.rect, all.rect);
        if (roughness < 0.1f)
            EXPECT_LT(copy.levels, all.levels) << roughness;
        else
            EXPECT_EQ(copy.levels, all.levels) << roughness;
    }
}

} // namespace
} // namespace filament_core::prepare
