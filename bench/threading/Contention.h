// SPDX-License-Identifier: Apache-2.0
/// Contention: what the threads of the job system do to each other, by job, with 1 to 16 workers (--contention). Counts
/// instead of times: they can be read where workers are more than cores, and their growth shows what more cores would
/// wait for.
///   Out     a table: counts by job, and the slope of their logarithm over that of the workers from 4 to 16.
///   Thread  main thread.
///   Limits  with more workers than cores, threads run in turns: races that need two cores at once are seldom lost
///           here. tests/jobsystem/WakingModelTest.cpp counts them with a core for each worker.
#pragma once

#include "jobsystem/Contention.h"

#include <cstdint>
#include <string>
#include <vector>

namespace filament_core::bench {

struct ContentionRow {
    std::string workload;
    uint32_t workers = 0;
    uint64_t jobs = 0;
    jobs::ContentionCounts counts;

    double byJob(jobs::Contention kind) const { return static_cast<double>(counts[kind]) / static_cast<double>(jobs); }
};

/// `quick`: small amounts. Every row also prints.
std::vector<ContentionRow> measureContention(bool quick);

} // namespace filament_core::bench
