// SPDX-License-Identifier: Apache-2.0
// oneTBB: task_group and parallel_for inside an arena of the same number of threads.
#include "bench/threading/Clock.h"
#include "bench/threading/Placement.h"
#include "bench/threading/Runtime.h"

#define TBB_PREVIEW_TASK_GROUP_EXTENSIONS 1 // a task may return the task to run next
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>
#include <oneapi/tbb/task_scheduler_observer.h>

#include <deque>
#include <map>

namespace filament_core::bench {
namespace {

uint32_t forkTree(uint32_t depth) {
    if (depth == 0) return 1;
    uint32_t left = 0;
    tbb::task_group group;
    group.run([&] { left = forkTree(depth - 1); });
    const uint32_t right = forkTree(depth - 1);
    group.wait();
    return left + right;
}

/// A continuation: the task that ends passes on the next one, which then runs without going through a queue.
struct Link {
    tbb::task_group& group;
    uint32_t left;
    tbb::task_handle operator()() const { return left > 0 ? group.defer(Link{ group, left - 1 }) : tbb::task_handle{}; }
};

/// A task that starts the next one.
struct Relay {
    tbb::task_group& group;
    uint32_t left;
    void operator()() const {
        if (left > 0) group.run(Relay{ group, left - 1 });
    }
};

/// Pins every thread while it works in the arena.
class Pinning final : public tbb::task_scheduler_observer {
public:
    explicit Pinning(tbb::task_arena& arena) : tbb::task_scheduler_observer(arena) {}
    void on_scheduler_entry(bool) override {
        tPin.emplace(coreOfThread(static_cast<unsigned>(tbb::this_task_arena::current_thread_index())));
    }
    void on_scheduler_exit(bool) override { tPin.reset(); }

private:
    static thread_local std::optional<PinnedScope> tPin;
};
thread_local std::optional<PinnedScope> Pinning::tPin;

class OneTbbRuntime final : public Runtime {
public:
    explicit OneTbbRuntime(RuntimeOptions const& options)
            : mThreads(options.threads), mArena(static_cast<int>(options.threads)), mPinning(mArena),
              mPinned(options.pinned) {}

    ~OneTbbRuntime() override { mPinning.observe(false); }

    // The caller stays in the arena between enter() and leave(), like an app's main thread.
    void enter() override {
        mControl.emplace(tbb::global_control::max_allowed_parallelism, mThreads);
        if (mPinned) mPinning.observe(true);
    }
    void leave() override {
        mPinning.observe(false);
        mControl.reset();
    }

    void emptyJobs(uint32_t count, uint64_t repeats) override {
        mArena.execute([&] {
            tbb::task_group group;
            for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
                for (uint32_t i = 0; i < count; ++i) group.run([] {});
                group.wait();
            }
        });
    }

    uint32_t tree(uint32_t depth) override {
        return mArena.execute([&] { return forkTree(depth); });
    }

    void loop(SpinWork const& work, uint64_t count, uint64_t repeats) override {
        mArena.execute([&] {
            for (uint64_t repeat = 0; repeat < repeats; ++repeat)
                tbb::parallel_for(tbb::blocked_range<uint64_t>(0, count),
                                  [&](auto const& range) { keep(work.run(range.begin(), range.end(), repeat)); });
        });
    }

    void chain(uint32_t links, uint64_t repeats) override {
        mArena.execute([&] {
            tbb::task_group group;
            for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
                group.run(Link{ group, links - 1 });
                group.wait();
            }
        });
    }

    void graph(uint32_t links, uint64_t repeats) override {
        using Node = tbb::flow::continue_node<tbb::flow::continue_msg>;
        mArena.execute([&] {
            tbb::flow::graph graph;
            std::deque<Node> nodes;
            for (uint32_t i = 0; i < links; ++i) {
                nodes.emplace_back(graph, [](tbb::flow::continue_msg) {});
                if (i > 0) tbb::flow::make_edge(nodes[i - 1], nodes[i]);
            }
            for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
                nodes.front().try_put(tbb::flow::continue_msg());
                graph.wait_for_all();
            }
        });
    }

    void relay(uint32_t links, uint64_t repeats) override {
        mArena.execute([&] {
            tbb::task_group group;
            for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
                group.run(Relay{ group, links - 1 });
                group.wait();
            }
        });
    }

    void spinJobs(std::span<const uint32_t> steps) override {
        mArena.execute([&] {
            tbb::task_group group;
            for (const uint32_t count : steps) group.run([count] { keep(spinSteps(count, count)); });
            group.wait();
        });
    }

    std::optional<int64_t> wakeUp(int64_t idle) override {
        if (mThreads == 1) return std::nullopt;
        return mArena.execute([&] {
            tbb::task_group group;
            StartSignal started;
            spinFor(idle);
            const int64_t now = wallNow();
            group.run([&] { started.raise(); });
            const int64_t latency = started.wait(now);
            group.wait();
            return latency;
        });
    }

private:
    const unsigned mThreads;
    tbb::task_arena mArena;
    Pinning mPinning;
    std::optional<tbb::global_control> mControl;
    const bool mPinned;
};

} // namespace

std::unique_ptr<Runtime> makeOneTbbRuntime(RuntimeOptions const& options) {
    return std::make_unique<OneTbbRuntime>(options);
}

} // namespace filament_core::bench
