// SPDX-License-Identifier: Apache-2.0
/// Patience: how often a thread without work of its own looks at what others have.
///   Why     a look takes the cache line that the victim writes with every push, a theft takes several: some 100 ns
///   each
///           to the victim. So looks become rarer while there is nothing, and a theft whose job was shorter than what
///           it cost puts off the next one: stealing must pay.
///   Use     begin();  while (...) { if (isTimeToLook(now)) look, then looked(now); }  after a theft:
///   learn(nanoseconds) Thread  one.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace filament::jobs {

inline int64_t nanosecondsNow() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
            .count();
}

/// Tells the core that this is a busy-wait: 10 to 60 ns.
inline void pauseCore() {
#if defined(__x86_64__) || defined(__i386__)
    __builtin_ia32_pause();
#elif defined(__aarch64__)
    asm volatile("yield" ::: "memory");
#endif
}

class Patience {
public:
    static constexpr int64_t kShortestInterval = 100, kLongestInterval = 1000;
    static constexpr int64_t kWorthStealing = 400;

    void begin(int64_t now) {
        mInterval = kShortestInterval;
        mNextLook = now + mDelay;
    }
    bool isTimeToLook(int64_t now) const { return now >= mNextLook; }
    void looked(int64_t now) {
        mNextLook = now + mInterval;
        mInterval = std::min(2 * mInterval, kLongestInterval);
    }
    /// How long the stolen job and what it forked kept this thread busy.
    void learn(int64_t nanoseconds) { mDelay = nanoseconds < kWorthStealing ? kLongestInterval : 0; }

private:
    int64_t mInterval = kShortestInterval;
    int64_t mNextLook = 0;
    int64_t mDelay = 0; // of the first look
};

} // namespace filament::jobs
