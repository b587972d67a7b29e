// SPDX-License-Identifier: Apache-2.0
/// CpuSet: the cores that this process may use, and how a thread is tied to one of them or named.
///   Thread  any; pinning and naming act on the calling thread.
///   Fails   never: a core that cannot be pinned to is reported in the log, and the thread stays where it was.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace filament::jobs {

/// Logical cores of the affinity mask that threads started here inherit, ascending; at least one entry.
std::vector<int> coresOfProcess();

/// False (and a warning in the log) if the operating system refuses.
bool pinThisThread(int core);

/// What debuggers and profilers show; the operating system keeps 15 characters.
void nameThisThread(std::string const& name);

} // namespace filament::jobs
