// SPDX-License-Identifier: Apache-2.0
// Copies of one skinned mesh, each in its own pose, drawn as instances: the bits of draws of their own, which copies
// have whose material instances differ only by their handles.
#include "tests/filament_core/engine/gltf/CopiesStage.h"

#include <algorithm>

namespace filament_core {
namespace {

using test::CopiesStage;
using test::Draws;
using test::expectTheBitsOfSeparateDraws;
using test::kCopies;

TEST(SkinnedInstances, HaveTheBitsOfSeparateDraws) {
    expectTheBitsOfSeparateDraws(
            {}, [](CopiesStage&) {}, [](CopiesStage& stage) { return stage.draw(); });
}

// Copies cross each other, and blend in the order of their depths; neighbours in this order are instances.
TEST(SkinnedInstances, OfTransparentMaterialsBlendInTheirOrder) {
    std::vector<Image> images;
    for (const Backend backend : test::kBothApis) {
        auto engine = test::makeEngine(backend);
        ASSERT_TRUE(engine);
        for (const Draws how : { Draws::Together, Draws::Alone }) {
            CopiesStage stage(*engine, how, { .package = "gltf_lit_blended" });
            images.push_back(stage.draw());
        }
        test::expectNoErrors(*engine);
    }
    EXPECT_EQ(images[0].pixels, images[1].pixels);
    EXPECT_EQ(images[2].pixels, images[3].pixels);
    EXPECT_EQ(images[0].pixels, images[2].pixels);
}

TEST(SkinnedInstances, CastShadowsOfTheirOwnPoses) {
    expectTheBitsOfSeparateDraws(
            {}, [](CopiesStage& stage) { stage.view.quality.shadows = ShadowFilter::Pcf3; },
            [](CopiesStage& stage) {
                stage.draw(); // the map is drawn again for other poses
                stage.pose(1);
                return stage.draw();
            });
}

TEST(SkinnedInstances, HaveTheMotionOfTheirOwnBones) {
    expectTheBitsOfSeparateDraws(
            {}, [](CopiesStage& stage) { stage.view.effects.motionBlur.enabled = true; },
            [](CopiesStage& stage) {
                stage.draw();
                stage.pose(1);
                return stage.draw();
            },
            2); // the image, and motion
}

TEST(SkinnedInstances, ArePickedWhereTheyAreSeen) {
    for (const Backend backend : test::kBothApis) {
        auto engine = test::makeEngine(backend);
        ASSERT_TRUE(engine);
        CopiesStage together(*engine, Draws::Together), alone(*engine, Draws::Alone);
        const auto hitAt = [](CopiesStage& stage, uint2 pixel) {
            const auto hit = stage.renderer.waitPick(stage.renderer.pick(stage.scene, stage.view, pixel));
            EXPECT_TRUE(hit.ok());
            const auto found = std::ranges::find(stage.copies, hit->renderable);
            return std::pair(found - stage.copies.begin(), hit->distanceMeters);
        };
        int hits = 0;
        for (uint32_t y = 6; y < 72; y += 5) {
            for (uint32_t x = 5; x < 96; x += 6) {
                const auto expected = hitAt(alone, { x, y });
                EXPECT_EQ(hitAt(together, { x, y }), expected) << x << ' ' << y;
                hits += expected.first < kCopies;
            }
        }
        EXPECT_GT(hits, 5);
        test::expectNoErrors(*engine);
    }
}

} // namespace
} // namespace filament_core
