// SPDX-License-Identifier: Apache-2.0
// The value of a drawing order: how many draws it merges into, and how often a pixel is shaded (the boxes as solid
// squares in a depth buffer of 256 x 256; 1 is the minimum). "order" is the engine's (SortKey.h), or for comparison: by
// depth in quarters of an octave and then by state; by draw and then by depth; exactly front to back; the order of the
// scene.
#include "bench/filament_core/prepare/PrepareSetup.h"

#include <array>
#include <cmath>

namespace filament_core::prepare {
namespace {

enum Order : int64_t { Engine, DepthThenState, DrawThenDepth, FrontToBack, SceneOrder };

constexpr int kPixels = 256;

uint64_t keyOf(Order order, SortItem const& engine, uint32_t depth) {
    constexpr uint64_t kState = (1ull << 55) - (1ull << 10);
    switch (order) {
    case Order::Engine:
        return engine.key;
    case Order::DepthThenState:
        return static_cast<uint64_t>(coarseStep(depth)) << 55 | (engine.key & kState);
    case Order::DrawThenDepth:
        return engine.key & ((1ull << 55) - 1);
    case Order::FrontToBack:
        return depth;
    case Order::SceneOrder:
        return 0;
    }
    return 0;
}

class DepthBuffer {
public:
    explicit DepthBuffer(ViewSpace const& space) : mSpace(space), mNearest(kPixels * kPixels, 0.0f) {}

    void draw(float3 center, float3 halfExtent) {
        const float4 clip = mSpace.clipFromWorld * float4(center, 1);
        const float size = halfExtent.y * std::abs(mSpace.clipFromView[1][1]) / clip.w;
        const auto pixel = [](float ndc) {
            return static_cast<int>(std::clamp((ndc * 0.5f + 0.5f) * kPixels, 0.0f, static_cast<float>(kPixels)));
        };
        const float x = clip.x / clip.w, y = clip.y / clip.w, z = clip.z / clip.w;
        for (int row = pixel(y - size); row < pixel(y + size); ++row) {
            for (int column = pixel(x - size); column < pixel(x + size); ++column) shade(row * kPixels + column, z);
        }
    }

    double shadedPerPixel() const {
        const auto covered = std::ranges::count_if(mNearest, [](float depth) { return depth > 0; });
        return static_cast<double>(mShaded) / static_cast<double>(covered);
    }

private:
    void shade(int pixel, float z) {
        float& nearest = mNearest[static_cast<size_t>(pixel)];
        if (z <= nearest) return; // reversed depth
        nearest = z;
        ++mShaded;
    }

    ViewSpace const& mSpace;
    std::vector<float> mNearest;
    uint64_t mShaded = 0;
};

void drawOrder(benchmark::State& state) {
    Setup setup(state);
    const auto order = static_cast<Order>(state.range(3));
    const VisibleItems visible = setup.cull();
    const std::span<SortItem> keyed = writeKeys(setup.jobs, setup.arena, setup.renderables(), visible);
    std::vector<SortItem> items(keyed.begin(), keyed.end());
    for (size_t i = 0; i < items.size(); ++i) {
        // everything is visible: no gaps between the slots
        items[i].key = keyOf(order, keyed[i], static_cast<uint32_t>(visible.slots[i].key));
    }
    std::span<const SortItem> sorted;
    Samples samples;
    for (auto _ : state) {
        std::vector<SortItem> copy = items;
        Arena arena;
        state.SetIterationTime(samples.time([&] { sorted = setup.arena.copy(sortItems(setup.jobs, arena, copy)); }));
    }
    const DrawLists draws = mergeInstances(setup.jobs, setup.arena, setup.renderables(), sorted, setup.counts);
    DepthBuffer depth(setup.space);
    for (SortItem const& item : sorted) {
        scene::BoundsColumns const& bounds = setup.renderables().bounds;
        depth.draw(float3(bounds.centerAt(item.renderable) - setup.space.cameraWorld),
                   bounds.halfExtentAt(item.renderable));
    }
    constexpr std::array kNames{ "engine", "depth, then state", "draw, then depth", "front to back", "scene" };
    state.SetLabel(kNames[static_cast<size_t>(order)]);
    state.counters["draws"] = static_cast<double>(draws.opaque.size());
    state.counters["shaded_per_pixel"] = depth.shadedPerPixel();
}
BENCHMARK(drawOrder)
        ->ArgNames({ kRenderables, kLooks, kWorkers, "order" })
        ->ArgsProduct({ { 10'000, 100'000 },
                        { 1, 64, 1024, 100'032 },
                        { 0 },
                        { Engine, DepthThenState, DrawThenDepth, FrontToBack, SceneOrder } })
        ->Iterations(3)
        ->UseManualTime();

} // namespace
} // namespace filament_core::prepare
