// SPDX-License-Identifier: Apache-2.0
// Picks without a device: which objects one pixel may show, and where it is.
#include "filament_core/prepare/PreparePick.h"

#include "filament_core/prepare/ViewConstants.h"
#include "filament_core/scene/SceneNodes.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace filament_core::prepare {
namespace {

struct PreparePickTest : testing::Test, BoxScene {
    jobs::JobSystem jobs{ { .workers = 1 } };
    Arena arena;
    ViewInput view{ .camera = Camera::lookAt({ 0, 0, 10 }, { 0, 0, 0 }, { .verticalFovDegrees = 60 }),
                    .size = { 640, 480 } };
    scene::MaterialInstance* glass = material(shader::Blending::Transparent);
};

TEST_F(PreparePickTest, FindsWhatThePixelMaySeeAndLittleElse) {
    Random random(5);
    for (int i = 0; i < 2000; ++i) add({ random.within(-8, 8), random.within(-8, 8), random.within(-9, 3) }, glass);
    const uint2 pixel(400, 100);
    const PreparedPick pick = preparePick(jobs, arena, scene, view, pixel);
    const std::set<uint32_t> found(pick.renderables.begin(), pick.renderables.end());
    EXPECT_EQ(found.size(), pick.packet.views[0].opaque.size());
    const double up = std::tan(glm::radians(30.0));
    const double3 along((400.5 / 640 * 2 - 1) * up * 640 / 480, -(100.5 / 480 * 2 - 1) * up, -1);
    size_t met = 0;
    for (uint32_t i = 0; i < scene.renderables.count(); ++i) {
        const double3 from = double3(0, 0, 10) - scene.renderables.bounds.centerAt(i);
        const double3 a = (-0.5 - from) / along, b = (0.5 - from) / along;
        const double3 low = glm::min(a, b), high = glm::max(a, b);
        const bool isHit = std::max({ low.x, low.y, low.z, 0.0 }) <= std::min({ high.x, high.y, high.z });
        met += isHit;
        EXPECT_TRUE(!isHit || found.contains(i)) << i;
    }
    EXPECT_GT(met, 5u);
    EXPECT_LT(found.size(), 3 * met) << "a pixel is no picture";
}

TEST_F(PreparePickTest, BeyondTheLimitTheNearestAreKept) {
    for (uint32_t i = 0; i < kMostCandidates + 500; ++i) add({ 0, 0, -0.01 * i }, glass, 1 + i % 3);
    const PreparedPick pick = preparePick(jobs, arena, scene, view, { 320, 240 });
    ASSERT_EQ(pick.renderables.size(), kMostCandidates);
    EXPECT_LT(*std::ranges::max_element(pick.renderables), kMostCandidates);
    for (DrawCall const& draw : pick.packet.views[0].opaque) EXPECT_EQ(draw.instanceCount, 1u);
}

TEST_F(PreparePickTest, UniformsAreThoseOfTheWholeView) {
    add(double3(0), glass);
    const PreparedPick pick = preparePick(jobs, arena, scene, view, { 320, 240 });
    EXPECT_EQ(pick.packet.views[0].uniforms.clipFromWorld, makeViewSpace(view).clipFromWorld);
}

TEST_F(PreparePickTest, APointIsWhereItsDepthAndItsPixelSay) {
    const double3 point(1.7, -0.4, -3);
    const ViewSpace space = makeViewSpace(view);
    const double4 clip = double4x4(space.clipFromWorld) * double4(point - space.cameraWorld, 1);
    const double2 at = (double2(clip) / clip.w + 1.0) * 0.5 * double2(view.size);
    const PickedPoint picked = pickedPoint(view.camera, view.size, uint2(at), static_cast<float>(clip.z / clip.w));
    EXPECT_NEAR(picked.distanceMeters, 13, 1e-5);
    EXPECT_LT(glm::distance(picked.positionWorld, point), 13 * 1.2 * std::tan(glm::radians(30.0)) / 240);
}

TEST_F(PreparePickTest, PrimitivesAreCountedInTheOrderInWhichTheyWereAdded) {
    const Node node = scene.transforms.add({}, double4x4(1), "node");
    std::vector<Renderable> attached;
    for (int i = 0; i < 4; ++i) scene::attach(scene, attached.emplace_back(add(double3(0), glass)), node);
    for (uint32_t i = 0; i < 4; ++i) EXPECT_EQ(primitiveOf(scene, attached[i]), i);
    removeRenderable(scene, attached[1]);
    EXPECT_EQ(primitiveOf(scene, attached[3]), 2u);
    EXPECT_EQ(primitiveOf(scene, add(double3(0), glass)), 0u);
}

} // namespace
} // namespace filament_core::prepare
