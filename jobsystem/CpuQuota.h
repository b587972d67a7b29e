// SPDX-License-Identifier: Apache-2.0
/// CpuQuota: how much processor time the cgroups of this process allow it.
///   In      /proc/self/cgroup, /proc/self/mountinfo, and `cpu.max` (version 2) or `cpu.cfs_quota_us` and
///           `cpu.cfs_period_us` (version 1) of the process's own group and each group above it; both versions may be
///           mounted at once.
///   Out     processors' worth of time: 1.5 is 150 ms in every 100 ms; infinity without a limit.
///   Thread  any.   Memory  none kept.
///   Limits  groups above a container's own view are not visible: its root group stands for them.
///   Fails   never: an absent, unreadable or malformed file sets no limit.
///   Cost    0.04 ms to read a few small files.
///   Source  man 7 cgroups; Documentation/admin-guide/cgroup-v2.rst and scheduler/sched-bwc.rst of the Linux kernel.
#pragma once

#include <filesystem>

namespace filament_core::jobs {

/// `root`: where /proc and the mounts are; tests pass a directory of their own.
double cpuQuota(std::filesystem::path const& root = "/");

} // namespace filament_core::jobs
