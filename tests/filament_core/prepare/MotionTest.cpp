// SPDX-License-Identifier: Apache-2.0
// What moved between two frames: generated scenes in which a known set of boxes moves, comes and goes.
#include "filament_core/prepare/LastFrame.h"
#include "filament_core/prepare/PrepareMotion.h"
#include "filament_core/scene/SceneSkins.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <set>

namespace filament_core::prepare {
namespace {

struct MotionTest : testing::Test, BoxScene {
    Arena arena;
    LastFrame last;
    ViewInput view = cubeView(100);

    /// Draws a frame, and keeps it as the last one.
    FramePacket frame() { return frameOf(scene); }
    FramePacket frameOf(scene::SceneData& drawn) {
        jobs::JobSystem jobs({ .workers = 0 });
        const jobs::AdoptedThread seat(jobs);
        view.debugView = DebugView::Motion;
        const std::array views{ view };
        const FramePacket packet = prepareFrame(jobs, arena, drawn, views, {}, last);
        last.keep(drawn, view, packet);
        return packet;
    }

    static double4x4 placeAt(double3 at) {
        double4x4 world(1.0);
        world[3] = double4(at, 1);
        return world;
    }
};

std::span<const DrawCall> moved(FramePacket const& packet) {
    return packet.motionView == kNowhere ? std::span<const DrawCall>{} : packet.views[packet.motionView].opaque;
}

TEST_F(MotionTest, RecordsArePairsOfNowAndThen) {
    Random random(1);
    addCube(100, 3, 4);
    for (int round = 0; round < 20; ++round) {
        (void)frame();
        std::set<uint32_t> expected;
        std::vector<scene::Placement> before = scene.renderables.placement;
        for (uint32_t i = 0; i < 100; ++i) {
            if (random.next() % 4) continue;
            const double3 at(random.within(-3, 3), random.within(-3, 3), -random.within(0, 6));
            setTransform(scene, scene.renderables.index.handleAt(i), placeAt(at));
            expected.insert(i);
        }
        const FramePacket packet = frame();
        EXPECT_EQ(packet.demand.of(Effect::Motion).count, expected.size());
        ObjectList const& objects = packet.views[packet.motionView].objects;
        ASSERT_EQ(objects.size(), 2 * expected.size());
        uint32_t next = 0;
        for (DrawCall const& draw : moved(packet)) {
            EXPECT_EQ(draw.firstObject, next) << "draws lie one after the other";
            next += 2 * draw.instanceCount;
        }
        EXPECT_EQ(next, objects.size());
        for (uint32_t record = 0; record < next; record += 2) {
            scene::Placement const& now = objects.placements[objects.order[record].renderable];
            scene::Placement const& then = objects.placements[objects.order[record + 1].renderable];
            const auto isNow = [&](uint32_t i) {
                return std::memcmp(&scene.renderables.placement[i], &now, sizeof(now)) == 0;
            };
            const auto found = std::ranges::find_if(expected, isNow);
            ASSERT_NE(found, expected.end());
            EXPECT_EQ(std::memcmp(&before[*found], &then, sizeof(then)), 0);
            expected.erase(found);
        }
    }
}

// Both records of an object lie in one window, and so do all instances of a draw.
TEST_F(MotionTest, WhatSharesADrawInTheImageSharesOneHereWithinWindows) {
    scene::MaterialInstance* const look = material();
    view = cubeView(400);
    for (int i = 0; i < 400; ++i) add(double3(0.01 * (i % 20), 0.01 * (i / 20), 0), look);
    (void)frame();
    for (uint32_t i = 0; i < 400; ++i) {
        if (i % 3) setTransform(scene, scene.renderables.index.handleAt(i), placeAt({ 0.01 * i, 0, 0.001 * i }));
    }
    const FramePacket packet = frame();
    uint32_t objects = 0;
    for (DrawCall const& draw : moved(packet)) {
        EXPECT_EQ(draw.firstObject / 256, (draw.firstObject + 2 * draw.instanceCount - 1) / 256);
        objects += draw.instanceCount;
    }
    EXPECT_EQ(objects, 266u);
    EXPECT_LE(moved(packet).size(), packet.mainView().opaque.size() + 3) << "the windows hold 128 objects";
}

TEST_F(MotionTest, WhatWasNotThereHasNone) {
    scene::MaterialInstance* const look = material();
    add(double3(0, 0, 0), look);
    const Renderable second = add(double3(1, 0, 0), look);
    (void)frame();
    removeRenderable(scene, scene.renderables.index.handleAt(0)); // the second one takes its position
    add(double3(0, 1, 0), look);
    EXPECT_TRUE(moved(frame()).empty());
    setTransform(scene, second, placeAt({ 1, 0.5, 0 }));
    EXPECT_EQ(moved(frame()).size(), 1u);
    last.forget();
    setTransform(scene, second, placeAt({ 1, 0, 0 }));
    EXPECT_TRUE(moved(frame()).empty()) << "there is no last frame";
}

TEST_F(MotionTest, PrimitivesOfOneSkinShareItsLastBonesToo) {
    const Skin skin = scene::addSkin(scene, { .bones = std::vector<shader::BoneData>(6) });
    const auto pose = [&](double x) {
        scene::setBones(scene, skin, std::vector<float4x4>(6, float4x4(placeAt({ x, 0, 0 }))));
    };
    pose(0);
    scene::MaterialInstance* const look = material();
    for (uint32_t mesh = 1; mesh <= 3; ++mesh) {
        const scene::RenderableInput input = box(double4x4(1.0), look, mesh);
        scene::addDeformed(scene, input,
                           { .skin = skin, .jointSets = 1, .restBounds = { input.boundsMin, input.boundsMax } });
    }
    EXPECT_EQ(frame().deformations.boneCount, 6u);
    pose(0.5);
    const FramePacket packet = frame();
    EXPECT_EQ(moved(packet).size(), 3u);
    EXPECT_EQ(packet.deformations.boneCount, 12u) << "now and then";
    for (DeformationPlace const& place : packet.deformations.places) EXPECT_EQ(place.last.begin, 6u);
    EXPECT_EQ(std::ranges::count(packet.deformations.places, true, &DeformationPlace::ownsLastBones), 1);
}

TEST_F(MotionTest, OnlyOpaqueObjectsInViewHaveIt) {
    const Renderable solid = add(double3(0, 0, 0), material());
    const Renderable blended = add(double3(1, 0, 0), material(shader::Blending::Transparent));
    const Renderable behind = add(double3(0, 0, 100), material());
    (void)frame();
    for (const Renderable renderable : { solid, blended, behind })
        setTransform(scene, renderable, placeAt(double3(0.2, 0.2, renderable == behind ? 100 : 0)));
    EXPECT_EQ(moved(frame()).size(), 1u);
}

TEST_F(MotionTest, VertexBlocksThatReadTheTimeMoveWithIt) {
    scene::MaterialInstance* const look = material();
    add(double3(0, 0, 0), look);
    look->material->package.readsFrame = true;
    (void)frame();
    view.timeSeconds = 0.5;
    EXPECT_TRUE(moved(frame()).empty()) << "a fragment block";
    look->material->package.depthReadsParameters = true;
    (void)frame();
    EXPECT_TRUE(moved(frame()).empty());
    view.timeSeconds = 1;
    EXPECT_EQ(moved(frame()).size(), 1u);
}

TEST_F(MotionTest, PlacesInTheViewMoveWithTheCamera) {
    for (const auto domain :
         { shader::VertexDomain::View, shader::VertexDomain::Device, shader::VertexDomain::World }) {
        scene::MaterialInstance* const look = material();
        look->material->package.vertexDomain = domain;
        scene::RenderableInput input = box(double4x4(1.0), look, 1);
        input.culled = false;
        addRenderable(scene, input);
    }
    (void)frame();
    EXPECT_TRUE(moved(frame()).empty());
    view.camera = Camera::lookAt({ 0.1, 0, 8 }, { 0, 0, 0 });
    EXPECT_EQ(moved(frame()).size(), 2u);
}

// A frame of another scene, or of another size, knows neither places nor the camera nor the exposure of the last one.
TEST_F(MotionTest, AnotherSceneAndAnotherSizeBeginAnew) {
    const auto drawn = [&](scene::SceneData& of, double x) {
        view.camera = Camera::lookAt({ x, 0, 8 }, { x, 0, 0 });
        view.timeSeconds += 0.5;
        setTransform(of, of.renderables.index.handleAt(0), placeAt({ x, 0, 0 }));
        return frameOf(of);
    };
    BoxScene other;
    other.add(double3(0), other.material());
    add(double3(0), material());
    view.effects.autoExposure.enabled = true;
    view.effects.motionBlur.enabled = true;
    const auto expectFirst = [&](FramePacket const& packet, bool isFirst) {
        EXPECT_EQ(moved(packet).size(), isFirst ? 0u : 1u);
        EXPECT_EQ(packet.last.isElsewhere, !isFirst);
        EXPECT_EQ(packet.last.secondsSince, isFirst ? 0 : 0.5f);
    };
    expectFirst(drawn(scene, 0), true);
    expectFirst(drawn(scene, 0.25), false);
    expectFirst(drawn(other.scene, 0.5), true);
    expectFirst(drawn(other.scene, 0.75), false);
    view.size = view.size * 2u;
    expectFirst(drawn(other.scene, 0), true);
    expectFirst(drawn(other.scene, 0.25), false);
    expectFirst(drawn(scene, 0.5), true);
}

TEST_F(MotionTest, TheLastFrameIsSeenFromThisOne) {
    add(double3(0, 0, 0), material());
    const Camera first = view.camera = Camera::lookAt({ 1e7, 2, 5 }, { 1e7, 0, 0 });
    EXPECT_FALSE(frame().last.isElsewhere) << "there was none";
    view.camera = Camera::lookAt({ 1e7 + 0.5, 2.25, 4 }, { 1e7, 0.5, 0 });
    const LastView seen = frame().last;
    EXPECT_TRUE(seen.isElsewhere);
    const double3 point(1e7 + 0.3, 0.4, -2), fromHere = point - view.camera.position();
    const double4 wanted = double4x4(first.clipFromView(1)) * (glm::inverse(first.worldFromView) * double4(point, 1));
    const double4 found = double4x4(seen.clipFromWorld) * double4(fromHere, 1);
    for (int i = 0; i < 2; ++i) EXPECT_NEAR(found[i] / found.w, wanted[i] / wanted.w, 1e-5);
    EXPECT_NEAR(dot(double4(seen.alongView), double4(fromHere, 1)), wanted.w, 1e-4);
}

} // namespace
} // namespace filament_core::prepare
