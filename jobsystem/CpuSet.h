// SPDX-License-Identifier: Apache-2.0
/// CpuSet: names that Topology.h and Affinity.h replace.
#pragma once

#include "jobsystem/Affinity.h"
#include "jobsystem/Topology.h"

namespace filament::jobs {

inline std::vector<int> coresOfProcess() { return coresOfThisThread(); }

} // namespace filament::jobs
