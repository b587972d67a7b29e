// SPDX-License-Identifier: Apache-2.0
// Boost.Asio: an io_context that the workers run(). It is the queue of asio::thread_pool, with the one function more
// that a waiting thread needs: poll_one() runs a job of others. Asio counts no jobs, so each batch counts its own.
#include "bench/threading/Clock.h"
#include "bench/threading/Placement.h"
#include "bench/threading/Runtime.h"

#include <boost/asio/defer.hpp>
#include <boost/asio/executor_work_guard.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/strand.hpp>

#include <atomic>
#include <thread>
#include <vector>

namespace filament_core::bench {
namespace {

namespace asio = boost::asio;

/// Jobs that have not ended. Who waits helps first; it sleeps only when the queue is empty, so what it waits for runs.
class Pending {
public:
    explicit Pending(uint32_t jobs) : mLeft(jobs) {}
    void done() {
        if (mLeft.fetch_sub(1, std::memory_order_acq_rel) == 1) mLeft.notify_one();
    }
    void wait(asio::io_context& context) const {
        while (const uint32_t left = mLeft.load(std::memory_order_acquire))
            if (context.poll_one() == 0) mLeft.wait(left, std::memory_order_acquire);
    }

private:
    std::atomic<uint32_t> mLeft;
};

uint32_t forkTree(asio::io_context& context, uint32_t depth) {
    if (depth == 0) return 1;
    uint32_t left = 0;
    Pending fork(1);
    asio::post(context, [&] {
        left = forkTree(context, depth - 1);
        fork.done();
    });
    const uint32_t right = forkTree(context, depth - 1);
    fork.wait(context);
    return left + right;
}

/// A continuation: defer() keeps the next job on this thread until this one has returned.
struct Link {
    asio::io_context& context;
    Pending& pending;
    uint32_t left;
    void operator()() const {
        if (left > 0)
            asio::defer(context, Link{ context, pending, left - 1 });
        else
            pending.done();
    }
};

/// A job that starts the next one.
struct Relay {
    asio::io_context& context;
    Pending& pending;
    uint32_t left;
    void operator()() const {
        if (left > 0)
            asio::post(context, Relay{ context, pending, left - 1 });
        else
            pending.done();
    }
};

class AsioRuntime final : public Runtime {
public:
    explicit AsioRuntime(RuntimeOptions const& options)
            : mThreads(options.threads), mPinned(options.pinned), mOpen(asio::make_work_guard(mContext)) {
        for (unsigned i = 1; i < mThreads; ++i)
            mWorkers.emplace_back([this, i] {
                if (mPinned) pinToCore(coreOfThread(i));
                mContext.run();
            });
    }

    ~AsioRuntime() override {
        mOpen.reset(); // run() returns
        for (std::thread& worker : mWorkers) worker.join();
    }

    void enter() override {
        if (mPinned) mPin.emplace(coreOfThread(0));
    }
    void leave() override { mPin.reset(); }

    void emptyJobs(uint32_t count, uint64_t repeats) override {
        for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
            Pending pending(count);
            for (uint32_t i = 0; i < count; ++i) asio::post(mContext, [&] { pending.done(); });
            pending.wait(mContext);
        }
    }

    uint32_t tree(uint32_t depth) override { return forkTree(mContext, depth); }

    void loop(SpinWork const& work, uint64_t count, uint64_t repeats) override {
        const uint64_t parts = uint64_t{ 4 } * mThreads; // Asio has no loops; by hand one cuts a few parts a thread
        for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
            Pending pending(static_cast<uint32_t>(parts));
            for (uint64_t part = 0; part < parts; ++part)
                asio::post(mContext, [&, part, repeat] {
                    keep(work.run(count * part / parts, count * (part + 1) / parts, repeat));
                    pending.done();
                });
            pending.wait(mContext);
        }
    }

    void chain(uint32_t links, uint64_t repeats) override {
        for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
            Pending last(1);
            asio::post(mContext, Link{ mContext, last, links - 1 });
            last.wait(mContext);
        }
    }

    /// A strand runs what it is given one after the other.
    void graph(uint32_t links, uint64_t repeats) override {
        const auto strand = asio::make_strand(mContext);
        for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
            Pending pending(links);
            for (uint32_t i = 0; i < links; ++i) asio::post(strand, [&] { pending.done(); });
            pending.wait(mContext);
        }
    }

    void relay(uint32_t links, uint64_t repeats) override {
        for (uint64_t repeat = 0; repeat < repeats; ++repeat) {
            Pending last(1);
            asio::post(mContext, Relay{ mContext, last, links - 1 });
            last.wait(mContext);
        }
    }

    void spinJobs(std::span<const uint32_t> steps) override {
        Pending pending(static_cast<uint32_t>(steps.size()));
        for (const uint32_t count : steps)
            asio::post(mContext, [&, count] {
                keep(spinSteps(count, count));
                pending.done();
            });
        pending.wait(mContext);
    }

    std::optional<int64_t> wakeUp(int64_t idle) override {
        if (mThreads == 1) return std::nullopt;
        Pending pending(1);
        StartSignal started;
        spinFor(idle);
        const int64_t now = wallNow();
        asio::post(mContext, [&] {
            started.raise();
            pending.done();
        });
        const int64_t latency = started.wait(now);
        pending.wait(mContext);
        return latency;
    }

    /// The queue gives the oldest job first, which in a tree is the largest one: waits nest on the stack, half as deep
    /// as there are leaves.
    uint32_t affordableLeaves() const override { return 1024; }

private:
    const unsigned mThreads;
    const bool mPinned;
    /// Without a hint of 1 for one thread: with it, polls in jobs lose count of the work and the queue stops.
    asio::io_context mContext;
    asio::executor_work_guard<asio::io_context::executor_type> mOpen; // run() does not return for want of jobs
    std::vector<std::thread> mWorkers;
    std::optional<PinnedScope> mPin;
};

} // namespace

std::unique_ptr<Runtime> makeAsioRuntime(RuntimeOptions const& options) {
    return std::make_unique<AsioRuntime>(options);
}

} // namespace filament_core::bench
