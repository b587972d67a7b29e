// SPDX-License-Identifier: Apache-2.0
/// StdAtomics: what the lock-free parts are made of. They take it as a template parameter, so that a test can put in
/// atomics whose every interleaving and every stale read it chooses itself (tests/jobsystem/ModelChecker.h).
///   Thread  any.
///   Fails   never. wait() may also return for no reason: call it in a loop that looks at the word.
///   Cost    Atomic is std::atomic itself; wait() and notify...() are one futex system call each, without the table of
///           waiters and the spinning that std::atomic::wait() puts around it: callers know whether anybody waits.
#pragma once

#include <atomic>
#include <cstdint>

namespace filament::jobs {

struct StdAtomics {
    template <class T>
    using Atomic = std::atomic<T>;
    /// What one thread at a time may touch.
    template <class T>
    using Plain = T;

    /// Sleeps until a notify, unless `word` differs from `old` by now; both happen in one step.
    static void wait(std::atomic<uint32_t>& word, uint32_t old);
    static void notifyOne(std::atomic<uint32_t>& word);
    static void notifyAll(std::atomic<uint32_t>& word);
};

} // namespace filament::jobs
