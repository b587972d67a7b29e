// SPDX-License-Identifier: Apache-2.0
// std::async with std::launch::async: one thread per job in the libraries of gcc and clang. Only small numbers are
// sensible.
#include "bench/threading/Clock.h"
#include "bench/threading/Placement.h"
#include "bench/threading/Runtime.h"

#include <functional>
#include <future>
#include <utility>
#include <vector>

namespace filament_core::bench {
namespace {

uint32_t forkTree(uint32_t depth) {
    if (depth == 0) return 1;
    std::future<uint32_t> left = std::async(std::launch::async, forkTree, depth - 1);
    const uint32_t right = forkTree(depth - 1);
    return left.get() + right;
}

class StdAsyncRuntime final : public Runtime {
public:
    explicit StdAsyncRuntime(RuntimeOptions const& options) : mThreads(options.threads), mPinned(options.pinned) {}

    void enter() override {
        if (mPinned) mPin.emplace(coreOfThread(0));
    }
    void leave() override { mPin.reset(); }

    void emptyJobs(uint32_t count, uint64_t repeats) override {
        std::vector<std::future<void>> futures(count);
        for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
            for (auto& future : futures) future = std::async(std::launch::async, [] {});
            for (auto& future : futures) future.get();
        }
    }

    uint32_t tree(uint32_t depth) override { return forkTree(depth); }

    void loop(SpinWork const& work, uint64_t count, uint64_t repeats) override {
        std::vector<std::future<void>> futures(mThreads - 1);
        for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
            const auto part = [&, repeat](unsigned thread) {
                pinTo(thread);
                keep(work.run(count * thread / mThreads, count * (thread + 1) / mThreads, repeat));
            };
            for (unsigned i = 1; i < mThreads; ++i) futures[i - 1] = std::async(std::launch::async, part, i);
            part(0);
            for (auto& future : futures) future.get();
        }
    }

    void chain(uint32_t links, uint64_t repeats) override { graph(links, repeats); }

    void graph(uint32_t links, uint64_t repeats) override {
        for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
            std::future<void> last = std::async(std::launch::async, [] {});
            for (uint32_t i = 1; i < links; ++i)
                last = std::async(std::launch::async, [before = std::move(last)]() mutable { before.get(); });
            last.get();
        }
    }

    void relay(uint32_t links, uint64_t repeats) override {
        std::vector<std::future<void>> futures(links);
        const std::function<void(uint32_t)> link = [&](uint32_t i) {
            if (i + 1 < links) futures[i + 1] = std::async(std::launch::async, link, i + 1);
        };
        for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
            futures[0] = std::async(std::launch::async, link, 0u);
            for (auto& future : futures) future.get(); // a link ends after setting the next future
        }
    }

    void spinJobs(std::span<const uint32_t> steps) override {
        std::vector<std::future<void>> futures;
        for (size_t i = 0; i < steps.size(); ++i)
            futures.push_back(std::async(std::launch::async, [this, thread = i % mThreads, count = steps[i]] {
                pinTo(static_cast<unsigned>(thread));
                keep(spinSteps(count, count));
            }));
        for (auto& future : futures) future.get();
    }

    std::optional<int64_t> wakeUp(int64_t idle) override {
        if (mThreads == 1) return std::nullopt;
        StartSignal started;
        spinFor(idle);
        const int64_t now = wallNow();
        std::future<void> job = std::async(std::launch::async, [&] {
            pinTo(1);
            started.raise();
        });
        return started.wait(now);
    }

    uint32_t affordableJobs() const override { return 64; }

private:
    /// A new thread inherits the caller's core, so it moves to its own first.
    void pinTo(unsigned thread) const {
        if (mPinned && thread != 0) pinToCore(coreOfThread(thread));
    }

    const unsigned mThreads;
    const bool mPinned;
    std::optional<PinnedScope> mPin;
};

} // namespace

std::unique_ptr<Runtime> makeStdAsyncRuntime(RuntimeOptions const& options) {
    return std::make_unique<StdAsyncRuntime>(options);
}

} // namespace filament_core::bench
