// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/CullRenderables.h"

#include "filament_core/prepare/CullBlocks.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <initializer_list>
#include <limits>
#include <map>
#include <vector>

namespace filament_core::prepare {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

struct CullTest : testing::Test, BoxScene {
    Arena arena;
    ViewCounts counts;
    ViewSpace space = makeViewSpace({ .camera = Camera::lookAt({ 0, 0, 10 }, { 0, 0, 0 }), .size = { 640, 480 } });

    scene::Renderables const& renderables() const { return scene.renderables; }

    VisibleItems cull(int workers = 0) {
        jobs::JobSystem jobs({ .workers = workers });
        return cullRenderables(jobs, arena, renderables(), space, ViewKind::Color, counts);
    }

    /// Some of every kind: boxes in and out of view, mirrored, never culled, without indices, collapsed, NaN; in
    /// layers.
    void addMixture(uint32_t count, double3 middle = double3(0)) {
        const auto* look = material();
        Random random(count + 1);
        for (uint32_t i = 0; i < count; ++i) {
            double4x4 world(random.next() % 16 ? random.within(-2, 2) * (random.next() % 4 ? 1 : 0.02) : 0.0);
            const double3 place(random.within(-15, 15), random.within(-15, 15), random.within(-30, 15));
            world[3] = double4(middle + place, 1);
            scene::RenderableInput input = box(world, look, 1 + random.next() % 7);
            input.culled = random.next() % 8 != 0;
            if (random.next() % 8 == 0) input.geometry.indexCount = 0;
            if (random.next() % 16 == 0) input.boundsMax.y = kNaN;
            if (random.next() % 16 == 0) input.boundsMax.x = kInfinity;
            if (random.next() % 2 == 0)
                input.layers = static_cast<uint8_t>(random.next() % 3 ? 1u << random.next() % 8 : 0u);
            addRenderable(scene, input);
        }
    }

    /// Takes what rests into blocks.
    void settle() {
        for (int i = 0; i < 200; ++i) scene.renderables.blocks.settle(renderables().bounds, renderables().flags);
    }

    /// How many renderables culling looks at.
    uint32_t looked() {
        jobs::JobSystem jobs({ .workers = 0 });
        const auto may = cullBlocks(jobs, arena, renderables().blocks, space.frustum, space.cameraWorld);
        uint32_t count = may.empty() ? renderables().count() : 0;
        for (const uint64_t word : may) count += static_cast<uint32_t>(std::popcount(word));
        return count;
    }

    bool isTooSmall(uint32_t i) const {
        const float3 center(renderables().bounds.centerAt(i) - space.cameraWorld);
        return space.pixels.missesAll(center, renderables().bounds.halfExtentAt(i));
    }

    bool isVisible(uint32_t i) const {
        const uint8_t flags = renderables().flags[i];
        if (flags & (scene::kNeverDrawn | scene::kCollapsed)) return false;
        if ((renderables().layers[i] & space.visibleLayers) == 0) return false;
        if (!(flags & scene::kCulled)) return true;
        const float3 center(renderables().bounds.centerAt(i) - space.cameraWorld);
        return intersects(space.frustum, center, renderables().bounds.halfExtentAt(i)) && !isTooSmall(i);
    }

    void expectWhatOneByOneSees(VisibleItems const& visible) {
        std::vector<uint32_t> seen, expected;
        for (size_t range = 0; range + 1 < visible.firsts.size(); ++range) {
            const size_t count = visible.firsts[range + 1] - visible.firsts[range];
            for (SortItem const& item : visible.slots.subspan(range * kCullRange, count)) {
                seen.push_back(item.renderable);
                const float3 center(renderables().bounds.centerAt(item.renderable) - space.cameraWorld);
                EXPECT_EQ(item.key, depthBits(glm::dot(space.forward, center)));
                const bool mirrored = renderables().flags[item.renderable] & scene::kMirrored;
                EXPECT_EQ(item.draw, drawOf(renderables().drawable[item.renderable], mirrored));
            }
        }
        uint32_t nothing = 0, elsewhere = 0;
        for (uint32_t i = 0; i < renderables().count(); ++i) {
            if (isVisible(i)) expected.push_back(i);
            const bool isNothing = renderables().flags[i] & (scene::kNeverDrawn | scene::kCollapsed);
            nothing += isNothing;
            elsewhere += !isNothing && (renderables().layers[i] & space.visibleLayers) == 0;
        }
        EXPECT_EQ(seen, expected);
        EXPECT_EQ(counts.renderables, renderables().count());
        EXPECT_EQ(counts.visible, expected.size());
        EXPECT_EQ(counts.nothingToDraw, nothing);
        EXPECT_EQ(counts.inOtherLayers, elsewhere);
        EXPECT_EQ(counts.outOfView + counts.tooSmall, renderables().count() - counts.visible - nothing - elsewhere);
    }
};

struct CullCountTest : CullTest, testing::WithParamInterface<uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Renderables, CullCountTest,
                         testing::Values(0, 1, 7, 8, 9, 255, 256, 257, 2047, 2048, 2049, 10'003));

TEST_P(CullCountTest, SeesExactlyWhatTheScalarTestSeesForAnyNumberOfWorkers) {
    addMixture(GetParam());
    for (int workers : { 0, 3 }) expectWhatOneByOneSees(cull(workers));
    EXPECT_TRUE(GetParam() < 1000 || counts.tooSmall > 10) << counts.tooSmall;
}

struct CullBlocksTest : CullTest, testing::WithParamInterface<double> {};
INSTANTIATE_TEST_SUITE_P(Offset, CullBlocksTest, testing::Values(0, 1e4, -3e9));

TEST_P(CullBlocksTest, LeaveOutNothingThatIsInView) {
    const double3 middle(GetParam(), 0.1 * GetParam(), 0);
    addMixture(20'003, middle);
    settle();
    Random random(5);
    uint32_t least = renderables().count();
    for (int i = 0; i < 40; ++i) {
        const double3 eye = middle + double3(random.within(-40, 40), random.within(-40, 40), random.within(-40, 40));
        const double3 at = middle + double3(random.within(-15, 15), random.within(-15, 15), random.within(-30, 15));
        space = makeViewSpace({ .camera = Camera::lookAt(eye, at, { .verticalFovDegrees = i % 2 ? 3.0f : 30.0f }),
                                .size = { 640, 480 },
                                .visibleLayers = static_cast<Layers>(i % 4 == 0 ? 0x5D : kAllLayers) });
        least = std::min(least, looked());
        for (const int workers : { 0, 3 }) expectWhatOneByOneSees(cull(workers));
        for (int moved = 0; moved < 50; ++moved) {
            double4x4 world(random.within(0.01, 2));
            world[3] = double4(i % 2 ? at : eye - 2.0 * (at - eye), 1);
            place(scene.renderables, random.next() % renderables().count(), world);
        }
        expectWhatOneByOneSees(cull());
        if (i % 10 == 0) settle();
    }
    EXPECT_LT(least, renderables().count() / 3) << "a third is never culled, or has no usable box";
}

TEST_F(CullTest, BlocksChangeNothingInShadowMaps) {
    addMixture(20'003);
    for (uint32_t i = 0; i < renderables().count(); i += 5) scene.renderables.flags[i] |= scene::kCastsNoShadows;
    space = makeViewSpace(
            { .camera = Camera::lookAt({ 0, 0, 40 }, { 3, 2, 1 }, { .verticalFovDegrees = 5 }), .size = { 64, 64 } });
    jobs::JobSystem jobs({ .workers = 0 });
    ViewCounts without, with;
    const VisibleItems all = cullRenderables(jobs, arena, renderables(), space, ViewKind::Shadow, without);
    settle();
    EXPECT_LT(looked(), renderables().count() / 2);
    const VisibleItems blocks = cullRenderables(jobs, arena, renderables(), space, ViewKind::Shadow, with);
    EXPECT_TRUE(std::ranges::equal(all.firsts, blocks.firsts));
    EXPECT_TRUE(std::ranges::equal(all.spans, blocks.spans));
    for (size_t range = 0; range + 1 < all.firsts.size(); ++range)
        for (size_t i = 0; i < all.firsts[range + 1] - all.firsts[range]; ++i)
            ASSERT_EQ(all.slots[range * kCullRange + i].renderable, blocks.slots[range * kCullRange + i].renderable);
    EXPECT_EQ(without.nothingToDraw, with.nothingToDraw);
    EXPECT_EQ(without.outOfView, with.outOfView);
    EXPECT_EQ(without.tooSmall, with.tooSmall);
}

TEST_F(CullTest, OnlyTrianglesThatStayInTheirBoxAreTooSmall) {
    const auto place = [](double x) {
        double4x4 world(0.001);
        world[3] = double4(x, 0, 0, 1);
        return world;
    };
    auto* moving = material();
    materials.back().package.depthReadsParameters = true; // a vertex block, say
    auto* ofCamera = material();
    materials.back().package.vertexDomain = shader::VertexDomain::View;
    scene::RenderableInput lines = box(place(0.1), material(), 1), kept = box(place(0.1), material(), 1);
    lines.geometry.isOfTriangles = false;
    kept.culled = false;
    add(place(0.1), moving), add(place(0.1), ofCamera), addRenderable(scene, lines), addRenderable(scene, kept);
    EXPECT_EQ(cull().count(), 4u);
    add(place(0.1), material());
    EXPECT_EQ(cull().count(), 4u);
    EXPECT_EQ(counts.tooSmall, 1u);
    space.pixels = {};
    EXPECT_EQ(cull().count(), 5u);
}

TEST_P(CullCountTest, SeesExactlyTheLayersOfTheView) {
    addMixture(GetParam());
    for (const Layers visible : std::initializer_list<Layers>{ 0x01, 0x02, 0x84, 0x7F, 0x00, 0xFE }) {
        space.visibleLayers = visible;
        for (int workers : { 0, 3 }) expectWhatOneByOneSees(cull(workers));
    }
    EXPECT_TRUE(GetParam() < 1000 || counts.inOtherLayers > 0);
}

TEST_F(CullTest, WhatIsInNoLayerIsNeverDrawnUntilItIsInOneAgain) {
    const Renderable one = add(double3(0), material()), other = add(double3(1, 0, 0), material());
    setLayers(scene.renderables, one, kAllLayers, 0);
    EXPECT_EQ(cull().count(), 1u);
    EXPECT_EQ(counts.nothingToDraw, 1u);
    setLayers(scene.renderables, one, 0b110, 0b011); // only layer 1 is in both
    setLayers(scene.renderables, other, 0b110, 0b011);
    EXPECT_EQ(scene.renderables.layers[0], 0b010);
    EXPECT_EQ(scene.renderables.layers[1], 0b011);
    EXPECT_EQ(cull().count(), 2u);
    space.visibleLayers = 0b001;
    EXPECT_EQ(cull().count(), 1u);
    remove(scene.renderables, one); // the other moves into the gap, with its layers
    EXPECT_EQ(cull().count(), 1u);
    space.visibleLayers = 0b100;
    EXPECT_EQ(cull().count(), 0u);
    EXPECT_EQ(counts.inOtherLayers, 1u);
}

TEST_F(CullTest, NothingInViewLeavesNothing) {
    const auto* look = material();
    for (int i = 0; i < 300; ++i) add({ 0.0, 0.0, 20.0 + i }, look);
    EXPECT_EQ(cull().count(), 0u);
    EXPECT_EQ(counts.outOfView, 300u);
}

TEST_F(CullTest, WhatMayNotBeDroppedIsVisibleFromBehind) {
    scene::RenderableInput input = box(double4x4(1.0), material(), 1);
    input.worldFromObject[3].z = 1000;
    input.culled = false;
    addRenderable(scene, input);
    EXPECT_EQ(cull().count(), 1u);
}

TEST_F(CullTest, ATransformThatIsNotANumberHasNothingToDraw) {
    double4x4 world(1.0);
    world[1].z = std::numeric_limits<double>::quiet_NaN();
    add(world, material());
    EXPECT_EQ(cull().count(), 0u);
    EXPECT_EQ(counts.nothingToDraw, 1u);
}

TEST_F(CullTest, SpansHoldTheNearestAndTheFarthestVisibleRenderableOfEachDraw) {
    addMixture(5000);
    for (int workers : { 0, 3 }) {
        const VisibleItems visible = cull(workers);
        std::map<uint32_t, DepthSpan> expected;
        for (uint32_t i = 0; i < renderables().count(); ++i) {
            if (!isVisible(i)) continue;
            const float3 center(renderables().bounds.centerAt(i) - space.cameraWorld);
            const uint32_t step = coarseStep(depthBits(glm::dot(space.forward, center)));
            const uint32_t draw = drawOf(renderables().drawable[i], renderables().flags[i] & scene::kMirrored);
            const auto [span, isNew] = expected.try_emplace(draw, DepthSpan{ step, step });
            if (!isNew) span->second = { std::min(span->second.nearest, step), std::max(span->second.farthest, step) };
        }
        EXPECT_GT(expected.size(), 7u);
        for (auto const& [draw, span] : expected) {
            EXPECT_EQ(visible.spanOf(draw).nearest, span.nearest);
            EXPECT_EQ(visible.spanOf(draw).farthest, span.farthest);
        }
    }
}

} // namespace
} // namespace filament_core::prepare
