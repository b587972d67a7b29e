// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/ShadowReceivers.h"

#include "tests/filament_core/prepare/BoxScene.h"

#include <gtest/gtest.h>

#include <limits>

namespace filament_core::prepare {
namespace {

struct SceneInLightSpaceTest : testing::Test, BoxScene {
    Arena arena;
    Random random{ 11 };

    double4x4 placeAt(double3 at, double size) {
        double4x4 world(size);
        world[3] = double4(at, 1);
        return world;
    }
    double3 somewhere(double far) {
        return { random.within(-far, far), random.within(-far, far), random.within(-far, far) };
    }

    /// One after the other.
    LightSpaceBox expected(double3x3 const& axes, Layers layers) const {
        scene::Renderables const& all = scene.renderables;
        LightSpaceBox box;
        for (uint32_t i = 0; i < all.count(); ++i) {
            if ((all.flags[i] & (scene::kNeverDrawn | scene::kCollapsed)) || (all.layers[i] & layers) == 0) continue;
            box.add(inLightSpace(axes, all.bounds.centerAt(i), all.bounds.halfExtentAt(i)));
        }
        return box;
    }
    void expectExact(Layers layers = kAllLayers) {
        for (int i = 0; i < 10; ++i) {
            const double3x3 axes = worldFromLight(glm::normalize(somewhere(1)));
            const LightSpaceBox box = expected(axes, layers);
            for (const int workers : { 0, 3 }) {
                jobs::JobSystem jobs({ .workers = workers });
                const jobs::AdoptedThread seat(jobs);
                arena.reset();
                const LightSpaceBox found = sceneInLightSpace(jobs, arena, scene.renderables, axes, layers);
                EXPECT_EQ(found.min, box.min);
                EXPECT_EQ(found.max, box.max);
            }
        }
    }
};

TEST_F(SceneInLightSpaceTest, IsThatOfEveryRenderableWhetherOrNotItIsInABlock) {
    const auto* look = material();
    for (uint32_t i = 0; i < 12'000; ++i) {
        scene::RenderableInput input = box(placeAt(somewhere(100), random.within(0.1, 3)), look, 1);
        input.layers = i % 3 ? 0x01 : 0x06;
        if (i % 500 == 0) input.boundsMax.x = std::numeric_limits<float>::quiet_NaN();
        addRenderable(scene, input);
    }
    expectExact();
    for (int i = 0; i < 10; ++i) settle(scene.renderables);
    EXPECT_TRUE(scene.renderables.blocks.holdMost());
    expectExact();
    expectExact(0x02);
    expectExact(0x80); // nothing
    // The outermost are hidden, or move inwards and outwards.
    for (uint32_t i = 0; i < scene.renderables.count(); ++i) {
        if (glm::length(scene.renderables.bounds.centerAt(i)) < 130) continue;
        setVisible(scene.renderables, scene.renderables.index.handleAt(i), i % 2 == 0);
        if (i % 5 == 0) place(scene.renderables, i, placeAt(somewhere(i % 10 ? 20 : 120), 1));
    }
    expectExact();
}

} // namespace
} // namespace filament_core::prepare
