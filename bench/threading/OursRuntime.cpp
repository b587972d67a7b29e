// SPDX-License-Identifier: Apache-2.0
// The engine's own job system.
#include "bench/threading/Clock.h"
#include "bench/threading/ForkTree.h"
#include "bench/threading/Placement.h"
#include "bench/threading/Runtime.h"
#include "jobsystem/JobSystem.h"

#include <deque>
#include <optional>

namespace filament_core::bench {
namespace {

using jobs::JobGroup;
using jobs::JobSystem;

/// A job that starts the next one.
struct Relay {
    JobGroup& group;
    uint32_t left;
    void operator()() const {
        if (left > 0) group.run<"relay">(Relay{ group, left - 1 });
    }
};

/// A continuation: the job that ends returns the next one, which then runs without going through a queue.
struct Link {
    uint32_t left;
    std::optional<Link> operator()() const { return left > 0 ? std::optional(Link{ left - 1 }) : std::nullopt; }
};

class OursRuntime final : public Runtime {
public:
    explicit OursRuntime(RuntimeOptions const& options)
            : mPinned(options.pinned),
              mJobs({ .workers = static_cast<int>(options.threads) - 1,
                      .affinity = options.pinned ? jobs::AffinityPolicy::pin() : jobs::AffinityPolicy::none(),
                      .threadName = "bench" }) {}

    void enter() override {
        if (mPinned) mPin.emplace(coreOfThread(0));
        mSeat.emplace(mJobs);
    }
    void leave() override {
        mSeat.reset();
        mPin.reset();
    }

    void emptyJobs(uint32_t count, uint64_t repeats) override {
        JobGroup group(mJobs);
        for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
            for (uint32_t i = 0; i < count; ++i) group.run<"empty">([] {});
            group.wait();
        }
    }

    uint32_t tree(uint32_t depth) override { return forkTree(mJobs, depth); }

    void loop(SpinWork const& work, uint64_t count, uint64_t repeats) override {
        // a range takes about 5 microseconds, as the header recommends
        const auto grain = static_cast<size_t>(5'000 / work.itemNs);
        for (uint64_t repeat = 0; repeat < repeats; ++repeat)
            parallelFor<"loop">(mJobs, count, grain,
                                [&](size_t begin, size_t end) { keep(work.run(begin, end, repeat)); });
    }

    void chain(uint32_t links, uint64_t repeats) override {
        JobGroup group(mJobs);
        for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
            group.run<"link">(Link{ links - 1 });
            group.wait();
        }
    }

    void graph(uint32_t links, uint64_t repeats) override {
        std::deque<JobGroup> groups; // one per link
        for (uint32_t i = 0; i < links; ++i) groups.emplace_back(mJobs);
        for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
            groups[0].run<"link">([] {});
            for (uint32_t i = 1; i < links; ++i) groups[i - 1].then<"link">(groups[i], [] {});
            for (JobGroup& group : groups) group.wait(); // only the last one can take time
        }
    }

    void relay(uint32_t links, uint64_t repeats) override {
        for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
            JobGroup group(mJobs);
            group.run<"relay">(Relay{ group, links - 1 });
            group.wait();
        }
    }

    void spinJobs(std::span<const uint32_t> steps) override {
        JobGroup group(mJobs);
        for (const uint32_t count : steps) group.run<"spin">([count] { keep(spinSteps(count, count)); });
        group.wait();
    }

    std::optional<int64_t> wakeUp(int64_t idle) override {
        if (mJobs.workerCount() == 0) return std::nullopt;
        JobGroup group(mJobs);
        StartSignal started;
        spinFor(idle);
        const int64_t now = wallNow();
        group.run<"wake">([&] { started.raise(); });
        const int64_t latency = started.wait(now);
        group.wait();
        return latency;
    }

private:
    const bool mPinned;
    JobSystem mJobs;
    std::optional<PinnedScope> mPin;
    std::optional<jobs::AdoptedThread> mSeat;
};

} // namespace

std::unique_ptr<Runtime> makeOursRuntime(RuntimeOptions const& options) {
    return std::make_unique<OursRuntime>(options);
}

} // namespace filament_core::bench
