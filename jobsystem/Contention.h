// SPDX-License-Identifier: Apache-2.0
/// Contention: what the threads of a job system did to each other beside running jobs, counted. Where cores are few,
/// the growth of these counts with the workers says what more cores would wait for.
///   In      count(), from the paths that others feel: a thread that forks, takes and joins its own jobs counts
///           nothing.
///   Thread  count(): any; it writes to the seat of the calling thread, and threads without one are not counted.
///   Memory  one cache line per seat.  Cost: two instructions where a cache line or a system call is lost anyway.
#pragma once

#include "jobsystem/Atomics.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace filament_core::jobs {

class JobSystem;

enum class Contention : uint8_t {
    LostRace,    ///< a compare-exchange that another thread's change made fail
    Look,        ///< another thread's deques were looked at: up to two cache lines
    StealTry,    ///< a theft from a deque that held something
    Steal,       ///< ... that got a job
    WakeUp,      ///< system calls that wake
    Sleep,       ///< system calls that sleep
    SharedQueue, ///< jobs into or out of the queue of threads without a seat
    SharedPool,  ///< batches of free jobs from or to the stack that all threads share
};
inline constexpr size_t kContentionKinds = 8;
const char* nameOf(Contention kind); ///< "lost races"

struct ContentionCounts {
    std::array<uint64_t, kContentionKinds> by{};

    uint64_t operator[](Contention kind) const { return by[static_cast<size_t>(kind)]; }
    ContentionCounts operator-(ContentionCounts const& earlier) const {
        ContentionCounts difference = *this;
        for (size_t i = 0; i < kContentionKinds; ++i) difference.by[i] -= earlier.by[i];
        return difference;
    }
};

/// Of one seat: written by its occupant only.
struct alignas(64) ContentionCells {
    std::array<std::atomic<uint64_t>, kContentionKinds> by{};

    void add(Contention kind, uint64_t times) {
        std::atomic<uint64_t>& cell = by[static_cast<size_t>(kind)];
        cell.store(cell.load(std::memory_order_relaxed) + times, std::memory_order_relaxed);
    }
};

void count(Contention kind, uint64_t times = 1);

/// For the lock-free parts, which their tests run with other atomics.
template <class Policy>
void countLostRace() {
    if constexpr (std::is_same_v<Policy, StdAtomics>) count(Contention::LostRace);
    if constexpr (requires { Policy::lostRace(); }) Policy::lostRace();
}

/// Of all seats, since the system began: take the difference of two calls for a stretch of work.
ContentionCounts contentionOf(JobSystem& jobs);

} // namespace filament_core::jobs
