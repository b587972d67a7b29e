// SPDX-License-Identifier: Apache-2.0
/// WorkerClocks: how much CPU time other threads of this process have used, whatever they did with it: jobs, looking
/// for work, falling asleep. A thread that another process preempts does not go on counting, unlike a stopwatch in a
/// job.
///   Thread  any. The threads named must be alive.
///   Fails   never: a thread that ended counts as it did last, which is nothing.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string_view>
#include <vector>

namespace filament::bench {

/// Threads of this process that debuggers show by this name; 15 bytes at most.
std::vector<pid_t> threadsNamed(std::string_view wanted);

/// Nanoseconds that these threads have been on a core since they started, all together.
int64_t cpuNanosecondsOf(std::vector<pid_t> const& threads);

} // namespace filament::bench
