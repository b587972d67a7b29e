// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/JobStorage.h"

#include "jobsystem/Contention.h"

namespace filament_core::jobs {

JobStorage::JobStorage(uint32_t capacity)
        : mJobs(std::make_unique_for_overwrite<Job[]>(capacity)),
          mNextInBatch(std::make_unique<std::atomic<uint32_t>[]>(capacity)), mBatches(capacity) {
    for (uint32_t first = 0; first < capacity; first += kBatch) {
        const uint32_t last = (capacity - first < kBatch ? capacity : first + kBatch) - 1;
        for (uint32_t job = first; job < last; ++job) mNextInBatch[job].store(job + 1, std::memory_order_relaxed);
        mNextInBatch[last].store(kNone, std::memory_order_relaxed);
        mBatches.push(first);
    }
}

void JobStorage::refill(Cache& cache) {
    count(Contention::SharedPool);
    for (uint32_t job = mBatches.pop(); job != kNone; job = mNextInBatch[job].load(std::memory_order_relaxed)) {
        cache.free[cache.count++] = job;
    }
}

void JobStorage::flush(Cache& cache) {
    count(Contention::SharedPool);
    // Evict the jobs released longest ago, so that the next allocation is still warm in this core's cache.
    for (uint32_t i = 0; i + 1 < kBatch; ++i) {
        mNextInBatch[cache.free[i]].store(cache.free[i + 1], std::memory_order_relaxed);
    }
    mNextInBatch[cache.free[kBatch - 1]].store(kNone, std::memory_order_relaxed);
    mBatches.push(cache.free[0]);
    for (uint32_t i = kBatch; i < cache.count; ++i) cache.free[i - kBatch] = cache.free[i];
    cache.count -= kBatch;
}

Job* JobStorage::allocateShared(Cache* cache) {
    if (cache) {
        refill(*cache);
        return cache->count == 0 ? nullptr : &mJobs[cache->free[--cache->count]];
    }
    const uint32_t job = mBatches.pop();
    if (job == kNone) return nullptr;
    // Without a cache there is no place for the rest of the batch, which goes back as a smaller one.
    const uint32_t rest = mNextInBatch[job].load(std::memory_order_relaxed);
    if (rest != kNone) mBatches.push(rest);
    return &mJobs[job];
}

void JobStorage::releaseShared(Cache* cache, uint32_t job) {
    if (cache) {
        flush(*cache);
        cache->free[cache->count++] = job;
        return;
    }
    mNextInBatch[job].store(kNone, std::memory_order_relaxed);
    mBatches.push(job);
}

} // namespace filament_core::jobs
