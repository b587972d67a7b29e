// SPDX-License-Identifier: Apache-2.0
/// JobStorage: a fixed pool of jobs. Every thread caches a few free jobs; the rest are in batches on a shared stack.
///   Thread  a Cache belongs to one thread at a time; any thread may allocate and release without a Cache.
///   Memory  72 bytes per job, all allocated by the constructor.
///   Limits  a Cache holds up to 64 free jobs.
///   Fails   allocate() returns null if no job is free.
///   Cost    a few instructions, and one compare-and-swap on the shared stack every 32 calls.
#pragma once

#include "jobsystem/IndexStack.h"
#include "jobsystem/Job.h"

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>

namespace filament_core::jobs {

class JobStorage {
public:
    static constexpr uint32_t kBatch = 32;

    struct Cache {
        std::array<uint32_t, 2 * kBatch> free{};
        uint32_t count = 0;
    };

    explicit JobStorage(uint32_t capacity);

    Job* allocate(Cache* cache) {
        if (cache && cache->count != 0) [[likely]]
            return &mJobs[cache->free[--cache->count]];
        return allocateShared(cache);
    }
    void release(Cache* cache, Job& job) {
        const auto index = static_cast<uint32_t>(&job - mJobs.get());
        if (cache && cache->count != cache->free.size()) [[likely]] {
            cache->free[cache->count++] = index;
        } else {
            releaseShared(cache, index);
        }
    }

private:
    Job* allocateShared(Cache* cache);
    void releaseShared(Cache* cache, uint32_t job);
    void refill(Cache& cache);
    void flush(Cache& cache);

    static constexpr uint32_t kNone = IndexStack<>::kNone;

    std::unique_ptr<Job[]> mJobs;
    std::unique_ptr<std::atomic<uint32_t>[]> mNextInBatch;
    IndexStack<> mBatches; // each batch is named by its first job
};

} // namespace filament_core::jobs
