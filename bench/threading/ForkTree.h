// SPDX-License-Identifier: Apache-2.0
/// forkTree: a binary tree of jobs that wait for jobs, of this engine's job system. Returns the leaves, 2^depth.
///   Thread  any.   Fails: std::bad_alloc.
#pragma once

#include "jobsystem/JobSystem.h"

#include <cstdint>

namespace filament_core::bench {

inline uint32_t forkTree(jobs::JobSystem& jobs, uint32_t depth) {
    if (depth == 0) return 1;
    uint32_t left = 0;
    jobs::JobGroup group(jobs);
    group.run<"tree">([&] { left = forkTree(jobs, depth - 1); });
    const uint32_t right = forkTree(jobs, depth - 1);
    group.wait();
    return left + right;
}

} // namespace filament_core::bench
