// SPDX-License-Identifier: Apache-2.0
/// FreshStack: goes on with a deep recursion on the stack of another thread.
///   Why     a wait() runs jobs, which wait, which run jobs: the nesting has no bound, the stack has. Near its end the
///           thread lends its seat to a helper with a new stack, and sleeps until the helper comes back. Threads, not
///           switched stacks: debuggers, sanitizers and unwinders understand them.
///   Thread  any; the helper inherits ThreadState and the context of assertions. Other thread-locals are the helper's.
///   Memory  8 MiB of address space a helper, of which the operating system provides what is touched.
///   Limits  between two looks at the stack a job may use 256 KiB, on a small stack a quarter of it.
///   Fails   ends the process with a message when the operating system refuses another thread.
///   Cost    isStackLow(): a compare; callOnFreshStack(): starting and ending a thread, 30 to 100 us per 8 MiB of
///           nesting.
#pragma once

#include "jobsystem/Seat.h"

#include <cstdint>

namespace filament::jobs {

/// Finds out where the calling thread's stack ends; once per thread.
void measureStack();

inline bool isStackLow() {
    if (tThread.stackFloor == 0) [[unlikely]]
        measureStack();
    return reinterpret_cast<uintptr_t>(__builtin_frame_address(0)) < tThread.stackFloor;
}

void callOnFreshStack(void (*call)(void*), void* argument);

template <class F>
void callOnFreshStack(F& function) {
    callOnFreshStack([](void* erased) { (*static_cast<F*>(erased))(); }, &function);
}

} // namespace filament::jobs
