// SPDX-License-Identifier: Apache-2.0
/// FreshStack: continues a deep recursion on the stack of another thread.
///   Why     a wait() runs jobs, which wait, which run jobs: the nesting is unbounded, but the stack is not. Near its
///           end the thread lends its seat to a helper thread with a new stack and sleeps until the helper returns.
///           These are threads rather than switched stacks because debuggers, sanitizers and unwinders understand
///           threads. Where the operating system refuses a thread, the stack is switched.
///   Thread  any; the helper inherits ThreadState and the assertion context. Other thread-locals are the helper's own.
///   Memory  8 MiB of address space per helper; the operating system provides only the pages that are touched.
///   Limits  between two checks of the stack a job may use 256 KiB; on a small stack, a quarter of the stack.
///   Fails   ends the process with a message if there is no memory for another stack.
///   Cost    isStackLow(): a compare; callOnFreshStack(): starting and ending a thread, 30 to 100 us per 8 MiB of
///           nesting.
#pragma once

#include "jobsystem/Seat.h"

#include <cstdint>

namespace filament_core::jobs {

/// Finds the end of the calling thread's stack; once per thread.
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

} // namespace filament_core::jobs
