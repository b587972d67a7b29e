// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/Atomics.h"

#include "jobsystem/Contention.h"

#include <climits>
#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace filament_core::jobs {
namespace {

static_assert(sizeof(std::atomic<uint32_t>) == 4 && std::atomic<uint32_t>::is_always_lock_free, "a futex word");

void futex(std::atomic<uint32_t>& word, int operation, uint32_t value) {
    // EAGAIN (the word changed) and EINTR (a signal) count as spurious wake-ups; no other error is possible.
    syscall(SYS_futex, &word, operation | FUTEX_PRIVATE_FLAG, value, nullptr, nullptr, 0);
}

} // namespace

void StdAtomics::wait(std::atomic<uint32_t>& word, uint32_t old) {
    count(Contention::Sleep);
    futex(word, FUTEX_WAIT, old);
}

void StdAtomics::notifyOne(std::atomic<uint32_t>& word) {
    count(Contention::WakeUp);
    futex(word, FUTEX_WAKE, 1);
}

void StdAtomics::notifyAll(std::atomic<uint32_t>& word) {
    count(Contention::WakeUp);
    futex(word, FUTEX_WAKE, INT_MAX);
}

} // namespace filament_core::jobs
