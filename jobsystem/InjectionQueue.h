// SPDX-License-Identifier: Apache-2.0
/// InjectionQueue: jobs from threads that have no deque.
///   Order   `count` is raised after an item is in, at one point of the total order of seq_cst operations: the point
///           that a sleeper's announcement is ordered against. The queue may look empty to a thread that races with
///           others although an item is left; nobody sleeps while the count is positive, so it is not forgotten.
///   Thread  any.
///   Memory  grows with the jobs in it and keeps what it grew to.
///   Fails   push() returns false when memory is exhausted.
#pragma once

#include "jobsystem/Job.h"

// The queue has fences that gcc's thread sanitizer ignores; its data is ordered without them.
#if defined(__SANITIZE_THREAD__)
#pragma GCC diagnostic ignored "-Wtsan"
#endif
#include <concurrentqueue.h>

#include <atomic>
#include <cstdint>

namespace filament::jobs {

class InjectionQueue {
public:
    bool push(Job& job) {
        if (!mQueue.enqueue(&job)) return false;
        mCount.fetch_add(1, std::memory_order_seq_cst);
        return true;
    }

    Job* pop() {
        Job* job = nullptr;
        if (isEmpty() || !mQueue.try_dequeue(job)) return nullptr;
        mCount.fetch_sub(1, std::memory_order_seq_cst);
        return job;
    }

    bool isEmpty() const { return mCount.load(std::memory_order_seq_cst) <= 0; }

private:
    moodycamel::ConcurrentQueue<Job*> mQueue;
    alignas(kCacheLineBytes) std::atomic<int64_t> mCount{ 0 };
};

} // namespace filament::jobs
