// SPDX-License-Identifier: Apache-2.0
/// CpuQuota: how much processor time the cgroups of this process allow it.
///   In      /proc/self/cgroup, /proc/self/mountinfo, and of the process's own group and each group above it `cpu.max`
///           (version 2) or `cpu.cfs_quota_us` and `cpu.cfs_period_us` (version 1); both versions may be mounted at
///           once.
///   Out     processors' worth of time: 1.5 is 150 ms in every 100 ms; infinity where nothing limits.
///   Thread  any.   Memory  none kept.
///   Limits  what lies above a container's own view is not seen: its root group stands for them.
///   Fails   never: a file that is absent, unreadable or malformed limits nothing.
///   Cost    0.04 ms: a few small files.
///   Source  man 7 cgroups; Documentation/admin-guide/cgroup-v2.rst and scheduler/sched-bwc.rst of the Linux kernel.
#pragma once

#include <filesystem>

namespace filament::jobs {

/// `root` is where /proc and the mounts are looked up; tests put a directory of their own there.
double cpuQuota(std::filesystem::path const& root = "/");

} // namespace filament::jobs
