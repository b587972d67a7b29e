// SPDX-License-Identifier: Apache-2.0
/// Topology: the processors that this process may use, what they share, and how many threads they can run.
///   In      hwloc for the machine; the calling thread's affinity mask, which its threads inherit (taskset, cpuset
///           cgroups and containers set it); the CPU quota of the cgroups (CpuQuota.h).
///   Thread  any. Call it before pinning the calling thread: a thread bound to one core sees a machine of one core.
///   Memory  the description of the machine is loaded once per process, at the first readTopology(), and kept.
///   Fails   never: without information (no /sys, or a processor unknown to hwloc) a processor counts as a separate
///           core, of the only class, in the first cache group.
///   Cost    readCpuBudget 0.05 ms; readTopology the same, and once per process 0.4 ms for hwloc (2 cores).
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace filament_core::jobs {

/// One hardware thread: a CPU to the operating system, a core in the options of the engine.
struct Cpu {
    int index = 0;           ///< the operating system's number
    int physicalCore = 0;    ///< equal for hardware threads of one core; counts up from 0 within a Topology
    int smtRank = 0;         ///< 0: the first hardware thread of its core that this process may use
    int cacheGroup = 0;      ///< equal for CPUs that share the last level of cache (L3, or else L2); from 0
    int efficiencyClass = 0; ///< more is faster; big.LITTLE and hybrid machines have several
    int maxMegahertz = 0;    ///< 0: unknown
};

/// How many threads can run at the same time.
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

/// A different machine than this one, for tests.
struct TopologySource {
    std::filesystem::path root = "/"; ///< of /proc and the cgroup mounts
    std::vector<int> cores{};         ///< the affinity mask; empty: that of the calling thread
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

} // namespace filament_core::jobs
