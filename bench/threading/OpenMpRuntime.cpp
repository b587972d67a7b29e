// SPDX-License-Identifier: Apache-2.0
// OpenMP: tasks created by one thread of a team, and loops divided statically, its default.
#include "bench/threading/Clock.h"
#include "bench/threading/Placement.h"
#include "bench/threading/Runtime.h"

#include <omp.h>

#include <vector>

namespace filament_core::bench {
namespace {

uint32_t forkTree(uint32_t depth) {
    if (depth == 0) return 1;
    uint32_t left = 0;
#pragma omp task shared(left)
    left = forkTree(depth - 1);
    const uint32_t right = forkTree(depth - 1);
#pragma omp taskwait
    return left + right;
}

/// A task that starts the next one.
void relayFrom(uint32_t left) {
    if (left == 0) return;
#pragma omp task
    relayFrom(left - 1);
}

class OpenMpRuntime final : public Runtime {
public:
    explicit OpenMpRuntime(RuntimeOptions const& options)
            : mThreads(static_cast<int>(options.threads)), mPinned(options.pinned) {
        omp_set_dynamic(0); // exactly the requested number of threads
    }

    void enter() override {
        if (!mPinned) return;
        mPins = std::vector<std::optional<PinnedScope>>(static_cast<size_t>(mThreads));
#pragma omp parallel num_threads(mThreads)
        mPins[static_cast<size_t>(omp_get_thread_num())].emplace(
                coreOfThread(static_cast<unsigned>(omp_get_thread_num())));
    }

    void leave() override {
        if (!mPinned) return;
#pragma omp parallel num_threads(mThreads) // every thread restores its own mask
        mPins[static_cast<size_t>(omp_get_thread_num())].reset();
    }

    void emptyJobs(uint32_t count, uint64_t repeats) override {
#pragma omp parallel num_threads(mThreads)
#pragma omp single
        for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
            for (uint32_t i = 0; i < count; ++i) {
#pragma omp task
                asm volatile("");
            }
#pragma omp taskwait
        }
    }

    uint32_t tree(uint32_t depth) override {
        uint32_t leaves = 0;
#pragma omp parallel num_threads(mThreads)
#pragma omp single
        leaves = forkTree(depth);
        return leaves;
    }

    void loop(SpinWork const& work, uint64_t count, uint64_t repeats) override {
        for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
#pragma omp parallel num_threads(mThreads)
            { // schedule(static) written out: one part per thread
                const auto thread = static_cast<uint64_t>(omp_get_thread_num());
                const auto threads = static_cast<uint64_t>(omp_get_num_threads());
                keep(work.run(count * thread / threads, count * (thread + 1) / threads, repeat));
            }
        }
    }

    void chain(uint32_t links, uint64_t repeats) override { graph(links, repeats); }

    void graph(uint32_t links, uint64_t repeats) override {
        [[maybe_unused]] char link = 0; // the address that the dependences name
#pragma omp parallel num_threads(mThreads)
#pragma omp single
        for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
            for (uint32_t i = 0; i < links; ++i) {
#pragma omp task depend(inout : link)
                asm volatile("");
            }
#pragma omp taskwait
        }
    }

    void relay(uint32_t links, uint64_t repeats) override {
#pragma omp parallel num_threads(mThreads)
#pragma omp single
        for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
#pragma omp taskgroup
            relayFrom(links);
        }
    }

    void spinJobs(std::span<const uint32_t> steps) override {
#pragma omp parallel num_threads(mThreads)
#pragma omp single
        for (const uint32_t count : steps) {
#pragma omp task firstprivate(count)
            keep(spinSteps(count, count));
        }
    }

    std::optional<int64_t> wakeUp(int64_t idle) override {
        if (mThreads == 1) return std::nullopt;
        StartSignal started;
        int64_t latency = 0;
#pragma omp parallel num_threads(mThreads)
#pragma omp master // the others wait for tasks at the end of the region
        {
            spinFor(idle);
            const int64_t now = wallNow();
#pragma omp task shared(started)
            started.raise();
            latency = started.wait(now);
        }
        return latency;
    }

private:
    const int mThreads;
    const bool mPinned;
    std::vector<std::optional<PinnedScope>> mPins; // by thread of the team
};

} // namespace

std::unique_ptr<Runtime> makeOpenMpRuntime(RuntimeOptions const& options) {
    return std::make_unique<OpenMpRuntime>(options);
}

} // namespace filament_core::bench
