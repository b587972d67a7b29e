// SPDX-License-Identifier: Apache-2.0
/// Clock: wall and CPU time in nanoseconds, waiting without sleeping, and waiting until this process is quiet.
///   Thread  any.
///   Fails   never.
#pragma once

#include <atomic>
#include <cstdint>
#include <ctime>

namespace filament_core::bench {

inline int64_t nanosecondsOf(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<int64_t>(now.tv_sec) * 1'000'000'000 + now.tv_nsec;
}

inline int64_t wallNow() { return nanosecondsOf(CLOCK_MONOTONIC); }
inline int64_t threadCpuNow() { return nanosecondsOf(CLOCK_THREAD_CPUTIME_ID); }

/// A hint to the core that this is a busy-wait.
inline void relax() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    asm volatile("yield" ::: "memory");
#endif
}

/// Keeps this core busy: other threads see an app thread that computes, not one that sleeps.
inline void spinFor(int64_t nanoseconds) {
    const int64_t end = wallNow() + nanoseconds;
    while (wallNow() < end) relax();
}

/// Records when a job started that another thread must run. wait() gives up after a second, so that a lost wake-up
/// appears as a latency of a second instead of a hang.
class StartSignal {
public:
    void raise() { mStarted.store(wallNow(), std::memory_order_release); }
    int64_t wait(int64_t since) const {
        constexpr int64_t kGiveUp = 1'000'000'000;
        for (;;) {
            if (const int64_t started = mStarted.load(std::memory_order_acquire)) return started - since;
            if (wallNow() - since > kGiveUp) return kGiveUp;
            relax();
        }
    }

private:
    std::atomic<int64_t> mStarted{ 0 };
};

/// Sleeps until the other threads of this process sleep too, or 100 ms have passed. Thread pools spin for up to 20 ms
/// after their last job (libgomp), and the next contender must not pay for that.
void settle();

} // namespace filament_core::bench
