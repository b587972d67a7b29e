// SPDX-License-Identifier: Apache-2.0
/// InjectionQueue: holds jobs from threads that have no deque.
///   Order   `count` is incremented after an item is in, by a seq_cst operation; a sleeper's announcement is ordered
///           against it. The queue may look empty to a racing thread although an item is left. Nobody sleeps while the
///           count is positive, so the item is not lost.
///   Thread  any.
///   Memory  grows with the number of queued jobs, and does not shrink.
///   Fails   push() returns false if memory runs out.
#pragma once

#include "jobsystem/Job.h"

// The queue uses fences, which gcc's thread sanitizer ignores; its data is ordered without them.
#if defined(__SANITIZE_THREAD__)
#pragma GCC diagnostic ignored "-Wtsan"
#endif
#include <concurrentqueue.h>

#include <atomic>
#include <cstdint>

namespace filament_core::jobs {

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

} // namespace filament_core::jobs
