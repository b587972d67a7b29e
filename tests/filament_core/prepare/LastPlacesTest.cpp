// SPDX-License-Identifier: Apache-2.0
// Where renderables were in the last frame, beside a copy of all of them: LastFrame keeps what moves, the scene what
// rested.
#include "filament_core/prepare/LastFrame.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <gtest/gtest.h>

#include <cstring>
#include <optional>

namespace filament_core::prepare {
namespace {

/// Every place, of the frame that was kept.
struct Copy {
    std::vector<Renderable> handles;
    std::vector<scene::Placement> placements;

    void keep(scene::Renderables const& renderables) {
        placements = renderables.placement;
        handles.clear();
        for (uint32_t i = 0; i < renderables.count(); ++i) handles.push_back(renderables.index.handleAt(i));
    }
    scene::Placement const* placement(scene::Renderables const& renderables, uint32_t at) const {
        return at < handles.size() && handles[at] == renderables.index.handleAt(at) ? &placements[at] : nullptr;
    }
};

struct LastPlacesTest : testing::Test, BoxScene {
    struct Seen {
        LastFrame last;
        Copy copy;
    };
    Arena arena;
    ViewInput view = cubeView(1000);
    scene::MaterialInstance const* look = material();
    Random random{ 3 };
    uint32_t known = 0, unknown = 0;

    double3 somewhere() { return { random.within(-9, 9), random.within(-9, 9), random.within(-9, 0) }; }
    Renderable any() { return scene.renderables.index.handleAt(random.next() % scene.renderables.count()); }

    void move(Renderable renderable) {
        double4x4 world(1.0);
        world[3] = double4(somewhere(), 1);
        setTransform(scene, renderable, world);
    }
    /// What a renderer does in a frame.
    void begin() { settle(scene.renderables); }
    void keep(Seen& seen) {
        jobs::JobSystem jobs({ .workers = 0 });
        const jobs::AdoptedThread seat(jobs);
        view.debugView = DebugView::Motion;
        const std::array views{ view };
        arena.reset();
        seen.last.keep(scene, view, prepareFrame(jobs, arena, scene, views));
        seen.copy.keep(scene.renderables);
    }
    void expectPlaces(Seen const& seen) {
        for (uint32_t at = 0; at < scene.renderables.count(); ++at) {
            scene::Placement const* const found = seen.last.placement(scene, at);
            scene::Placement const* const expected = seen.copy.placement(scene.renderables, at);
            ASSERT_EQ(found != nullptr, expected != nullptr) << at;
            ++(found ? known : unknown);
            if (!found) continue;
            ASSERT_EQ(std::memcmp(found, expected, sizeof(scene::Placement)), 0) << at;
        }
    }
};

TEST_F(LastPlacesTest, AreThoseOfACopyOfAll) {
    Seen first, second; // two renderers that take turns now and then
    for (int i = 0; i < 300; ++i) add(somewhere(), look);
    begin();
    keep(first), keep(second);
    for (int frame = 0; frame < 600; ++frame) {
        for (uint32_t i = random.next() % 4; i > 0; --i) move(any());
        if (frame % 3 == 0) move(scene.renderables.index.handleAt(7));
        if (frame % 50 < 2) {
            const Renderable twice = any();
            move(twice), move(twice);
            add(somewhere(), look);
            removeRenderable(scene, any());
        }
        begin();
        expectPlaces(first);
        if (frame % 20 == 0) expectPlaces(second), keep(second);
        keep(first);
    }
    EXPECT_GT(known, 100'000u);
    EXPECT_GT(unknown, 20u);
}

TEST_F(LastPlacesTest, AreKeptOfWhatMovesAlone) {
    for (int i = 0; i < 1000; ++i) add(somewhere(), look);
    Seen seen;
    begin();
    keep(seen);
    EXPECT_EQ(seen.last.keptPlaces(), 1000u) << "all of them are new";
    const Renderable moving = any();
    for (uint32_t frame = 0; frame < 4 * scene::RestingBlocks::kRestFrames; ++frame) {
        move(moving);
        begin();
        keep(seen);
    }
    EXPECT_EQ(seen.last.keptPlaces(), 1u);
    for (uint32_t frame = 0; frame < 4 * scene::RestingBlocks::kRestFrames; ++frame) begin(), keep(seen);
    EXPECT_EQ(seen.last.keptPlaces(), 0u);
    move(moving);
    expectPlaces(seen);
}

TEST_F(LastPlacesTest, AreUnknownAfterManyFramesOfOthers) {
    for (int i = 0; i < 50; ++i) add(somewhere(), look);
    Seen seen;
    begin();
    keep(seen);
    for (uint32_t frame = 0; frame < 3 * scene::RestingBlocks::kRestFrames; ++frame) begin();
    for (uint32_t at = 0; at < 50; ++at) EXPECT_EQ(seen.last.placement(scene, at), nullptr);
}

} // namespace
} // namespace filament_core::prepare
