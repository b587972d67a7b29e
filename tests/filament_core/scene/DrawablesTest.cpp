// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/Renderables.h"

#include <gtest/gtest.h>

#include <map>
#include <vector>

namespace filament_core::scene {
namespace {

struct DrawablesTest : testing::Test {
    Material solid{ .id = 5 }, glass{ .id = 6 };
    MaterialInstance a{ .id = 1, .material = &solid }, b{ .id = 2, .material = &solid },
            c{ .id = 3, .material = &glass };
    Drawables drawables;

    DrawablesTest() { glass.package.blending = shader::Blending::Transparent; }

    static Geometry mesh(uint32_t number) {
        return { .vertices = backend::BufferHandle::make(number, 1), .firstIndex = number, .indexCount = 3 };
    }
};

TEST_F(DrawablesTest, GivesEqualPairsOneNumberAndDifferentPairsDifferentOnes) {
    const uint32_t first = drawables.acquire({ mesh(1), &a });
    EXPECT_EQ(drawables.acquire({ mesh(1), &a }), first);
    EXPECT_NE(drawables.acquire({ mesh(2), &a }), first);
    EXPECT_NE(drawables.acquire({ mesh(1), &b }), first);
    Geometry wide = mesh(1);
    wide.indexFormat = backend::IndexFormat::UInt32;
    EXPECT_NE(drawables.acquire({ wide, &a }), first);
    EXPECT_EQ(drawables.count(), 4u);
    EXPECT_EQ(drawables.use(first).users, 2u);
    EXPECT_EQ(drawables[first].geometry, mesh(1));
}

TEST_F(DrawablesTest, GivesANumberOutAgainOnlyWhenItsLastUserIsGone) {
    const uint32_t first = drawables.acquire({ mesh(1), &a });
    drawables.acquire({ mesh(1), &a });
    drawables.release(first);
    EXPECT_NE(drawables.acquire({ mesh(2), &a }), first);
    drawables.release(first);
    EXPECT_EQ(drawables.acquire({ mesh(3), &c }), first);
    EXPECT_EQ(drawables[first].material, &c);
    EXPECT_EQ(drawables.limit(), 2u);
}

TEST_F(DrawablesTest, OrdersByMaterialThenInstanceAndMarksWhatBlends) {
    const auto order = [&](MaterialInstance const* instance) {
        return drawables.use(drawables.acquire({ mesh(1), instance })).order;
    };
    EXPECT_EQ(order(&a), 5u << Drawables::kInstanceBits | 1);
    EXPECT_LT(order(&a), order(&b));
    EXPECT_EQ(order(&c), Drawables::kBlendedOrder | 6u << Drawables::kInstanceBits | 3);
}

TEST_F(DrawablesTest, KnowsWhetherAnythingOccludes) {
    const float3 corners[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
    const uint32_t indices[] = { 0, 1, 2 };
    const Occluder occluder = makeOccluder(corners, indices);
    Geometry wall = mesh(1);
    wall.occluder = occluder.get();
    drawables.acquire({ mesh(2), &a });
    drawables.acquire({ wall, &c }); // transparent
    EXPECT_FALSE(drawables.hasOccluders());
    const uint32_t first = drawables.acquire({ wall, &a }), second = drawables.acquire({ wall, &b });
    drawables.acquire({ wall, &a });
    drawables.release(first);
    drawables.release(second);
    EXPECT_TRUE(drawables.hasOccluders());
    a.raster.depthWrite = false;
    drawables.updateUses();
    EXPECT_FALSE(drawables.hasOccluders());
    a.raster.depthWrite = true;
    drawables.updateUses();
    EXPECT_TRUE(drawables.hasOccluders());
    drawables.release(first);
    EXPECT_FALSE(drawables.hasOccluders());
}

TEST_F(DrawablesTest, CountsUsersRightThroughRandomUse) {
    std::map<uint32_t, uint32_t> users;              // by mesh
    std::vector<std::pair<uint32_t, uint32_t>> live; // mesh, number
    uint32_t random = 1;
    for (int i = 0; i < 20'000; ++i) {
        random = random * 1664525u + 1013904223u;
        if (live.empty() || random >> 31) {
            const uint32_t number = (random >> 8) % 50;
            live.emplace_back(number, drawables.acquire({ mesh(number), &a }));
            ++users[number];
        } else {
            const size_t victim = (random >> 8) % live.size();
            drawables.release(live[victim].second);
            if (--users[live[victim].first] == 0) users.erase(live[victim].first);
            live[victim] = live.back();
            live.pop_back();
        }
        ASSERT_EQ(drawables.count(), users.size());
    }
    for (auto const& [number, drawable] : live) {
        EXPECT_EQ(drawables[drawable].geometry, mesh(number));
        EXPECT_EQ(drawables.use(drawable).users, users[number]);
    }
    EXPECT_LE(drawables.limit(), 50u);
}

using DrawablesDeathTest = DrawablesTest;

TEST_F(DrawablesDeathTest, RefusesToReleaseWhatNobodyUses) {
    const uint32_t number = drawables.acquire({ mesh(1), &a });
    drawables.release(number);
    EXPECT_DEATH(drawables.release(number), "once a use");
    EXPECT_DEATH(drawables.release(17), "once a use");
}

} // namespace
} // namespace filament_core::scene
