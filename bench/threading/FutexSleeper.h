// SPDX-License-Identifier: Apache-2.0
/// FutexSleeper: a thread that only sleeps on a futex: measures how long the operating system takes to wake a thread.
///   Use     the lower bound of the wake-up workloads: no runtime with sleeping threads can be faster.
///   Thread  created, used and destroyed on one thread.
#pragma once

#include <atomic>
#include <cstdint>
#include <thread>

namespace filament_core::bench {

class FutexSleeper {
public:
    explicit FutexSleeper(bool pinned);
    ~FutexSleeper();
    FutexSleeper(FutexSleeper const&) = delete;
    FutexSleeper& operator=(FutexSleeper const&) = delete;

    /// After `idle` nanoseconds without work: nanoseconds from the wake-up until the thread runs.
    int64_t wakeUp(int64_t idle);

private:
    void sleepAndAnswer(bool pinned);

    std::atomic<uint32_t> mWord{ 0 }; ///< incremented to wake the thread that sleeps on it
    std::atomic<int64_t> mAwake{ 0 }; ///< when it ran, 0: not yet
    std::atomic<bool> mStopping{ false };
    std::thread mThread;
};

} // namespace filament_core::bench
