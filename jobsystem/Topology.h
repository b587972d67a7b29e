// SPDX-License-Identifier: Apache-2.0
/// Topology: which processors this process may use, what they share, and how many threads they feed.
///   In      hwloc for the machine, the calling thread's affinity mask (which threads started by it inherit; taskset,
///           cpuset cgroups and containers arrive there), the cgroups' CPU quota (CpuQuota.h).
///   Thread  any. Call it before the calling thread is pinned: a thread tied to one core sees a machine of one core.
///   Memory  the description of the machine is loaded once per process, at the first readTopology(), and kept.
///   Fails   never: what is not known (no /sys, a processor that hwloc does not list) counts as a core of its own, of
///           the only class, in the first cache group.
///   Cost    readCpuBudget 0.05 ms; readTopology the same and, once a process, 0.4 ms for hwloc (2 cores).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace filament::jobs {

/// One hardware thread: what the operating system calls a CPU, and what options of the engine call a core.
struct Cpu {
    int index = 0;           ///< the operating system's number
    int physicalCore = 0;    ///< hardware threads of one core have the same; counts up from 0 within a Topology
    int smtRank = 0;         ///< 0: the first hardware thread of its core that this process may use
    int cacheGroup = 0;      ///< those that share the last level of cache (L3, or else L2) have the same; from 0
    int efficiencyClass = 0; ///< more is faster; big.LITTLE and hybrid machines have several
    int maxMegahertz = 0;    ///< 0: unknown
};

/// How many threads can run at a time.
struct CpuBudget {
    std::vector<int> cores{};   ///< operating system's numbers, ascending; at least one
    double quota = 0;           ///< processors' worth of time; infinity: no limit
    uint32_t usableThreads = 1; ///< floor(min(cores, quota)), at least 1
};

struct Topology {
    std::vector<Cpu> cpus{}; ///< those of the affinity mask, by index; at least one
    double quota = 0;
    uint32_t usableThreads = 1;
};

/// Another machine than this one, for tests.
struct TopologySource {
    std::filesystem::path root = "/"; ///< of /proc and the cgroup mounts
    std::vector<int> cores{};         ///< the affinity mask; empty: the calling thread's
    std::string hwlocXml{};           ///< the machine as hwloc exports it; empty: this one
};

/// The affinity mask of the calling thread, ascending; at least one.
std::vector<int> coresOfThisThread();
/// floor(min(cores, quota)), at least 1.
uint32_t usableThreads(size_t cores, double quota);

CpuBudget readCpuBudget(TopologySource const& source = {});
Topology readTopology(TopologySource const& source = {});

/// "0-3,8" for messages; `cores` is ascending.
std::string rangesOf(std::span<const int> cores);

} // namespace filament::jobs
