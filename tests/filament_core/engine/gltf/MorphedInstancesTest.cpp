// SPDX-License-Identifier: Apache-2.0
// Copies of one mesh with morph targets, each with weights of its own, drawn as instances: the bits of draws of their
// own.
#include "tests/filament_core/engine/gltf/CopiesStage.h"

namespace filament_core {
namespace {

using test::Copied;
using test::CopiesStage;
using test::expectTheBitsOfSeparateDraws;

/// The second of two frames, in which weights and bones have changed.
Image drawMoved(CopiesStage& stage) {
    stage.draw();
    stage.pose(1);
    return stage.draw();
}

constexpr auto kAsItIs = [](CopiesStage&) {};

TEST(MorphedInstances, HaveTheBitsOfSeparateDraws) {
    expectTheBitsOfSeparateDraws({ .hasSkins = false, .hasTargets = true }, kAsItIs,
                                 [](CopiesStage& stage) { return stage.draw(); });
}

TEST(MorphedInstances, WithSkinsCastShadowsOfTheirOwnPoses) {
    expectTheBitsOfSeparateDraws(
            { .hasTargets = true }, [](CopiesStage& stage) { stage.view.quality.shadows = ShadowFilter::Pcf3; },
            drawMoved);
}

TEST(MorphedInstances, HaveTheMotionOfTheirOwnWeightsAndBones) {
    for (const bool hasSkins : { false, true }) {
        expectTheBitsOfSeparateDraws(
                { .hasSkins = hasSkins, .hasTargets = true },
                [](CopiesStage& stage) { stage.view.effects.motionBlur.enabled = true; }, drawMoved, 2);
    }
}

TEST(MorphedInstances, FarFromTheOriginAreAccumulatedAndShowTheirMotion) {
    expectTheBitsOfSeparateDraws(
            { .hasTargets = true, .originWorld = { 3e7, -2e7, 5e6 } },
            [](CopiesStage& stage) { stage.view.quality.antiAliasing = AntiAliasing::Taa; }, drawMoved, 2);
    expectTheBitsOfSeparateDraws(
            { .hasTargets = true, .originWorld = { 3e7, -2e7, 5e6 } },
            [](CopiesStage& stage) { stage.view.debugView = DebugView::Motion; }, drawMoved, 2);
}

TEST(MorphedInstances, AreNumberedAndPickedWhereTheyAreSeen) {
    expectTheBitsOfSeparateDraws(
            { .hasTargets = true }, [](CopiesStage& stage) { stage.view.debugView = DebugView::ObjectIds; }, drawMoved);
    auto engine = test::makeEngine(Backend::Vulkan);
    ASSERT_TRUE(engine);
    CopiesStage together(*engine, test::Draws::Together, { .hasTargets = true }),
            alone(*engine, test::Draws::Alone, { .hasTargets = true });
    const auto hitAt = [](CopiesStage& stage, uint2 pixel) {
        const auto hit = stage.renderer.waitPick(stage.renderer.pick(stage.scene, stage.view, pixel));
        EXPECT_TRUE(hit.ok());
        const auto found = std::ranges::find(stage.copies, hit->renderable);
        return std::pair(found - stage.copies.begin(), hit->distanceMeters);
    };
    int hits = 0;
    for (uint32_t y = 6; y < 72; y += 11) {
        for (uint32_t x = 5; x < 96; x += 9) {
            const auto expected = hitAt(alone, { x, y }), found = hitAt(together, { x, y });
            EXPECT_EQ(found.first, expected.first) << x << ' ' << y;
            EXPECT_NEAR(found.second, expected.second, 1e-6) << "a step of the depth: candidates have another order";
            hits += expected.first < test::kCopies;
        }
    }
    EXPECT_GT(hits, 5);
}

} // namespace
} // namespace filament_core
