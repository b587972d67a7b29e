// SPDX-License-Identifier: Apache-2.0
/// WorkerClocks: the CPU time of other threads of this process, for any purpose: jobs, looking for work, falling
/// asleep. Unlike a stopwatch inside a job, it stops while another process preempts the thread.
///   Thread  any. The threads named must be alive.
///   Fails   never: for a thread that has ended the time does not advance.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string_view>
#include <vector>

namespace filament_core::bench {

/// Threads of this process with this name in debuggers; at most 15 bytes.
std::vector<pid_t> threadsNamed(std::string_view wanted);

/// Total nanoseconds that these threads have run on a core since they started.
int64_t cpuNanosecondsOf(std::vector<pid_t> const& threads);

} // namespace filament_core::bench
