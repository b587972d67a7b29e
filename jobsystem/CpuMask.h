// SPDX-License-Identifier: Apache-2.0
/// CpuMask: a set of cores as Linux takes it.
///   Memory  1 KiB.   Fails: null if there is no memory.
#pragma once

#include <sched.h>

#include <cstddef>
#include <memory>

namespace filament_core::jobs {

/// The largest configuration of Linux; the kernel refuses a mask shorter than its own.
inline constexpr int kMaxCores = 8192;
inline const size_t kCpuMaskBytes = CPU_ALLOC_SIZE(kMaxCores);

struct FreeCpuMask {
    void operator()(cpu_set_t* mask) const { CPU_FREE(mask); }
};
using CpuMask = std::unique_ptr<cpu_set_t, FreeCpuMask>;

/// Without any core.
inline CpuMask makeCpuMask() {
    CpuMask mask(CPU_ALLOC(kMaxCores));
    if (mask) CPU_ZERO_S(kCpuMaskBytes, mask.get());
    return mask;
}

} // namespace filament_core::jobs
