// SPDX-License-Identifier: Apache-2.0
/// Shared by the benchmarks of this folder: scenes in which everything is visible, and clocks.
#pragma once

#include "base/Statistics.h"
#include "filament_core/prepare/DrawList.h"
#include "filament_core/prepare/ObjectData.h"
#include "filament_core/prepare/SortItems.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <benchmark/benchmark.h>
#include <time.h>

#include <algorithm>
#include <memory>
#include <vector>

namespace filament_core::prepare {

/// Scene, view and jobs according to the arguments "renderables", "looks" (1, or 64 materials x 16 meshes, or one each)
/// and "workers" (threads besides the caller).
struct Setup {
    explicit Setup(benchmark::State const& state)
            : count(static_cast<uint32_t>(state.range(0))), jobs({ .workers = static_cast<int>(state.range(2)) }),
              view(BoxScene::cubeView(count)), space(makeViewSpace(view)) {
        const auto looks = static_cast<uint32_t>(state.range(1));
        boxes.addCube(count, std::min(looks, 64u), std::max(looks / 64, 1u));
    }

    scene::Renderables const& renderables() const { return boxes.scene.renderables; }
    VisibleItems cull() { return cullRenderables(jobs, arena, renderables(), space, prepare::ViewKind::Color, counts); }
    std::span<SortItem> keys() { return writeKeys(jobs, arena, renderables(), cull()); }
    std::span<const SortItem> order() { return sortItems(jobs, arena, keys()); }

    uint32_t count;
    BoxScene boxes;
    jobs::JobSystem jobs;
    Arena arena;
    ViewInput view;
    ViewSpace space;
    ViewCounts counts;
};

/// Memory like that of upload commands: aligned to cache lines.
class UploadMemory {
public:
    explicit UploadMemory(size_t objects) : mBytes((objects + 1) * sizeof(shader::ObjectData)) {
        void* first = mBytes.data();
        size_t bytes = mBytes.size();
        mObjects = { static_cast<shader::ObjectData*>(
                             std::align(64, objects * sizeof(shader::ObjectData), first, bytes)),
                     objects };
    }
    std::span<shader::ObjectData> objects() { return mObjects; }

private:
    std::vector<std::byte> mBytes;
    std::span<shader::ObjectData> mObjects;
};

/// Times of one operation in seconds: medians, because other processes make some of them long.
class Samples {
public:
    /// Calls and times `function`; returns its wall time.
    template <class F>
    double time(F&& function) {
        const double wall = now(CLOCK_MONOTONIC), threads = now(CLOCK_PROCESS_CPUTIME_ID);
        function();
        mThreads.push_back(now(CLOCK_PROCESS_CPUTIME_ID) - threads);
        mWall.push_back(now(CLOCK_MONOTONIC) - wall);
        return mWall.back();
    }

    double wall() { return median(mWall); }
    /// All threads of the process together, including waiting.
    double threads() { return median(mThreads); }

    /// Counters: nanoseconds per renderable.
    void report(benchmark::State& state, uint32_t renderables) {
        state.counters["wall_ns"] = wall() * 1e9 / renderables;
        state.counters["threads_ns"] = threads() * 1e9 / renderables;
    }

private:
    static double now(clockid_t clock) {
        timespec time{};
        clock_gettime(clock, &time);
        return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
    }

    std::vector<double> mWall, mThreads;
};

inline constexpr const char* kRenderables = "renderables";
inline constexpr const char* kLooks = "looks";
inline constexpr const char* kWorkers = "workers";

} // namespace filament_core::prepare
