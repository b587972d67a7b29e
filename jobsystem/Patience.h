// SPDX-License-Identifier: Apache-2.0
/// Patience: how often a thread without work looks at the deques of others, and when it steals.
///   Why     a look takes the cache line that the victim writes with every push; a theft takes several and the job's:
///           100 to 500 ns of the victim's time. A job that its owner would finish sooner is not worth stealing.
///   How     looks become rarer while there is nothing to steal. A thief takes only items that it saw at its last look,
///           so items that an owner pushes and takes within kSecondLook stay with the owner. After a theft that did not
///           pay, the next look waits.
///   Use     begin();
///           while (...) if (isTimeToLook(now)) { look: isStillThere() ? take, return : leave;  looked(now); }
///           and learn(nanoseconds) when the stolen job is done.
///   Thread  one.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>

namespace filament_core::jobs {

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
    static constexpr int64_t kFirstInterval = 100,
                             kLongestInterval = 1000; // in nanoseconds, while there is nothing
    static constexpr int64_t kSecondLook = 250;       // after the first look that saw an item
    static constexpr int64_t kDisappointment = 2000;  // longest interval while items are gone at the second look
    static constexpr int64_t kWorthStealing = 400;    // a theft alone takes 200 to 300

    void begin(int64_t now) {
        mInterval = kFirstInterval;
        mNextLook = now + mDelay;
        mDelay = 0;
        mSighting = {};
    }
    bool isTimeToLook(int64_t now) const { return now >= mNextLook; }

    /// During a look: whether the oldest item of `deque`, whose items are [oldest, end), was there at the last look.
    bool isStillThere(const void* deque, int64_t oldest, int64_t end) {
        if (mSuspect.deque == deque && oldest < mSuspect.end) return true;
        if (!mSighting.deque) mSighting = { deque, end };
        return false;
    }

    /// After a look that took nothing: whether it saw an item.
    bool looked(int64_t now) {
        const bool isFirstSighting = mSighting.deque && !mSuspect.deque;
        if (isFirstSighting) {
            mNextLook = now + kSecondLook;
        } else {
            mNextLook = now + mInterval;
            mInterval = std::min(2 * mInterval, mSuspect.deque ? kDisappointment : kLongestInterval);
        }
        const bool sawWork = mSighting.deque != nullptr;
        mSuspect = isFirstSighting ? mSighting : Sighting{};
        mSighting = {};
        return sawWork;
    }

    /// Takes the time of the theft, the stolen job and its forks. False if the next look should wait.
    bool learn(int64_t nanoseconds) {
        if (nanoseconds >= kWorthStealing) return true;
        mDelay = kLongestInterval;
        mSuspect = {};
        return false;
    }

private:
    struct Sighting {
        const void* deque = nullptr; // null: nothing seen
        int64_t end = 0;
    };

    int64_t mInterval = kFirstInterval;
    int64_t mNextLook = 0;
    int64_t mDelay = 0; // before the first look
    Sighting mSuspect;  // at the last look; stays while thefts succeed: the items seen are taken one by one
    Sighting mSighting; // at this look
};

} // namespace filament_core::jobs
