// SPDX-License-Identifier: Apache-2.0
// Eigen: the pool of TensorFlow, with a work-stealing deque per thread, and the loops of its tensors. Its callers
// cannot help: one that waits sleeps, so the pool has as many threads as others have together with the caller.
#include "bench/threading/Clock.h"
#include "bench/threading/Placement.h"
#include "bench/threading/Runtime.h"

#define EIGEN_USE_THREADS
#include <unsupported/Eigen/CXX11/Tensor>

#include <functional>
#include <thread>

namespace filament_core::bench {
namespace {

/// What Eigen asks for to make its threads: thread i goes to the core of thread first + i if they are pinned.
class Environment {
public:
    struct Task {
        std::function<void()> f; // Eigen tests if it is empty
    };
    class EnvThread {
    public:
        explicit EnvThread(std::function<void()> run) : mThread(std::move(run)) {}
        ~EnvThread() { mThread.join(); }
        void OnCancel() {}

    private:
        std::thread mThread;
    };

    Environment(bool pinned, unsigned first) : mPinned(pinned), mNext(first) {}

    EnvThread* CreateThread(std::function<void()> run) {
        return new EnvThread([pinned = mPinned, core = coreOfThread(mNext++), run = std::move(run)] {
            if (pinned) pinToCore(core);
            run();
        });
    }
    Task CreateTask(std::function<void()> run) { return { std::move(run) }; }
    void ExecuteTask(Task const& task) { task.f(); }

private:
    bool mPinned;
    unsigned mNext;
};
using Pool = Eigen::ThreadPoolTempl<Environment>;

/// A job that starts the next one.
struct Relay {
    Pool& pool;
    Eigen::Notification& ended;
    uint32_t left;
    void operator()() const {
        if (left > 0)
            pool.Schedule(Relay{ pool, ended, left - 1 });
        else
            ended.Notify();
    }
};

class EigenRuntime final : public Runtime {
public:
    explicit EigenRuntime(RuntimeOptions const& options)
            : mThreads(static_cast<int>(options.threads)), mPinned(options.pinned),
              mPool(mThreads, true, Environment(options.pinned, 0)), mDevice(&mPool, mThreads) {}

    void enter() override {
        if (mPinned) mPin.emplace(coreOfThread(0));
    }
    void leave() override { mPin.reset(); }

    void emptyJobs(uint32_t count, uint64_t repeats) override {
        for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
            Eigen::Barrier ended(count);
            for (uint32_t i = 0; i < count; ++i) mPool.Schedule([&] { ended.Notify(); });
            ended.Wait();
        }
    }

    uint32_t tree(uint32_t) override { return 0; } // left out

    void loop(SpinWork const& work, uint64_t count, uint64_t repeats) override {
        const Eigen::TensorOpCost cost(0, 0, work.itemNs * 3); // by item: bytes read, bytes written, cycles at 3 GHz
        for (uint64_t repeat = 0; repeat < repeats; ++repeat)
            mDevice.parallelFor(static_cast<Eigen::Index>(count), cost, [&](Eigen::Index begin, Eigen::Index end) {
                keep(work.run(static_cast<uint64_t>(begin), static_cast<uint64_t>(end), repeat));
            });
    }

    void chain(uint32_t, uint64_t) override {} // left out
    void graph(uint32_t, uint64_t) override {} // left out

    void relay(uint32_t links, uint64_t repeats) override {
        for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
            Eigen::Notification ended;
            mPool.Schedule(Relay{ mPool, ended, links - 1 });
            ended.Wait();
        }
    }

    void spinJobs(std::span<const uint32_t> steps) override {
        Eigen::Barrier ended(static_cast<unsigned>(steps.size()));
        for (const uint32_t count : steps)
            mPool.Schedule([&, count] {
                keep(spinSteps(count, count));
                ended.Notify();
            });
        ended.Wait();
    }

    std::optional<int64_t> wakeUp(int64_t idle) override {
        if (mThreads == 1) return std::nullopt;
        if (!mOthers) {
            mOthers.emplace(mThreads - 1, true, Environment(mPinned, 1));
            Eigen::Notification exists;
            mOthers->Schedule([&] { exists.Notify(); });
            exists.Wait();
        }
        Eigen::Notification ended;
        StartSignal started;
        spinFor(idle);
        const int64_t now = wallNow();
        mOthers->Schedule([&] {
            started.raise();
            ended.Notify();
        });
        const int64_t latency = started.wait(now);
        ended.Wait();
        return latency;
    }

private:
    const int mThreads;
    const bool mPinned;
    Pool mPool;
    Eigen::ThreadPoolDevice mDevice;
    std::optional<Pool> mOthers; // without a thread on the core of the caller, who computes while they sleep
    std::optional<PinnedScope> mPin;
};

} // namespace

std::unique_ptr<Runtime> makeEigenRuntime(RuntimeOptions const& options) {
    return std::make_unique<EigenRuntime>(options);
}

} // namespace filament_core::bench
