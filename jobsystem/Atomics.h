// SPDX-License-Identifier: Apache-2.0
/// StdAtomics: the atomics that the lock-free parts are built on. They are a template parameter, so that a test can
/// substitute atomics that go through every interleaving and every stale read (tests/jobsystem/ModelChecker.h).
///   Thread  any.
///   Fails   never. wait() may return spuriously: call it in a loop that checks the word.
///   Cost    Atomic is std::atomic itself. wait() and notify...() are one futex system call each, without the waiter
///           table and the spinning of std::atomic::wait(): callers know whether anybody waits.
#pragma once

#include <atomic>
#include <cstdint>

namespace filament_core::jobs {

struct StdAtomics {
    template <class T>
    using Atomic = std::atomic<T>;
    /// Data that one thread at a time may touch.
    template <class T>
    using Plain = T;

    /// Sleeps until a notify, unless `word` already differs from `old`; check and sleep are one atomic step.
    static void wait(std::atomic<uint32_t>& word, uint32_t old);
    static void notifyOne(std::atomic<uint32_t>& word);
    static void notifyAll(std::atomic<uint32_t>& word);
};

} // namespace filament_core::jobs
