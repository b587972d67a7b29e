// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/SceneData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace filament_core::scene {
namespace {

struct SceneDataTest : testing::Test {
    Material material;
    MaterialInstance instance{ .material = &material };
    SceneData scene;

    Renderable add(double x) {
        double4x4 world(1.0);
        world[3].x = x;
        return addRenderable(
                scene,
                { .material = &instance, .boundsMin = float3(-1), .boundsMax = float3(1), .worldFromObject = world });
    }
};

TEST_F(SceneDataTest, KeepsHandlesValidWhenOthersAreRemoved) {
    const Renderable a = add(0), b = add(10), c = add(20);
    removeRenderable(scene, a);
    Renderables const& r = scene.renderables;
    ASSERT_EQ(r.count(), 2u);
    EXPECT_EQ(r.bounds.centerAt(r.index.at(b)).x, 10);
    EXPECT_EQ(r.bounds.centerAt(r.index.at(c)).x, 20);
    setTransform(scene, c, double4x4(2.0));
    EXPECT_EQ(r.bounds.halfExtentAt(r.index.at(c)), float3(2));
    EXPECT_EQ(r.bounds.halfExtentAt(r.index.at(b)), float3(1));
}

TEST_F(SceneDataTest, EveryColumnHasTheSameLengthAfterRandomAddsAndRemoves) {
    std::vector<Renderable> live;
    uint32_t random = 1;
    for (int i = 0; i < 2000; ++i) {
        random = random * 1664525u + 1013904223u;
        if (live.empty() || random >> 31) {
            live.push_back(add(i));
        } else {
            const size_t victim = (random >> 8) % live.size();
            removeRenderable(scene, live[victim]);
            live[victim] = live.back();
            live.pop_back();
        }
    }
    Renderables const& r = scene.renderables;
    EXPECT_EQ(r.count(), live.size());
    for (size_t size : { r.bounds.size(), r.flags.size(), r.drawable.size(), r.placement.size(), r.objectBounds.size(),
                         r.layers.size() }) {
        EXPECT_EQ(size, live.size());
    }
}

TEST_F(SceneDataTest, MarksMirroredTransforms) {
    const Renderable a = add(0);
    double4x4 mirror(1.0);
    mirror[0][0] = -1;
    setTransform(scene, a, mirror);
    EXPECT_TRUE(scene.renderables.flags[0] & kMirrored);
    setTransform(scene, a, double4x4(1.0));
    EXPECT_FALSE(scene.renderables.flags[0] & kMirrored);
}

TEST_F(SceneDataTest, TurnsANonFiniteTransformIntoNothing) {
    const Renderable a = add(0);
    double4x4 broken(1.0);
    broken[3].y = std::numeric_limits<double>::quiet_NaN();
    setTransform(scene, a, broken);
    EXPECT_EQ(scene.renderables.bounds.halfExtentAt(0), float3(0));
    EXPECT_TRUE(std::isfinite(scene.renderables.bounds.centerAt(0).y));
    EXPECT_TRUE(scene.renderables.flags[0] & kCollapsed);
    setTransform(scene, a, double4x4(1.0));
    EXPECT_FALSE(scene.renderables.flags[0] & kCollapsed);
}

TEST_F(SceneDataTest, BoundsCoverEveryRenderable) {
    EXPECT_TRUE(sceneBounds(scene).empty());
    add(-3);
    add(7);
    const Box box = sceneBounds(scene);
    EXPECT_EQ(box.min, double3(-4, -1, -1));
    EXPECT_EQ(box.max, double3(8, 1, 1));
}

TEST(GeometryLayouts, GivesEqualLayoutsTheSameIndex) {
    GeometryLayouts layouts;
    GeometryLayout a, b;
    b.topology = backend::PrimitiveType::Lines;
    const uint32_t first = layouts.intern(a);
    EXPECT_NE(layouts.intern(b), first);
    EXPECT_EQ(layouts.intern(a), first);
    EXPECT_EQ(layouts[layouts.intern(b)].topology, backend::PrimitiveType::Lines);
}

} // namespace
} // namespace filament_core::scene
