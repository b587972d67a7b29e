// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/CpuSet.h"

#include "filament_core/base/Log.h"

#include <pthread.h>
#include <sched.h>

#include <cstring>
#include <memory>

namespace filament::jobs {
namespace {

constexpr int kMaxCores = 8192; // the largest configuration of Linux; the kernel refuses a mask shorter than its own

struct FreeMask {
    void operator()(cpu_set_t* mask) const { CPU_FREE(mask); }
};
using CpuMask = std::unique_ptr<cpu_set_t, FreeMask>;

} // namespace

std::vector<int> coresOfProcess() {
    const size_t bytes = CPU_ALLOC_SIZE(kMaxCores);
    const CpuMask mask(CPU_ALLOC(kMaxCores));
    std::vector<int> cores;
    if (mask && sched_getaffinity(0, bytes, mask.get()) == 0) {
        for (int core = 0; core < kMaxCores; ++core) {
            if (CPU_ISSET_S(core, bytes, mask.get())) cores.push_back(core);
        }
    }
    if (cores.empty()) cores.push_back(0);
    return cores;
}

bool pinThisThread(int core) {
    const size_t bytes = CPU_ALLOC_SIZE(kMaxCores);
    const CpuMask mask(CPU_ALLOC(kMaxCores));
    int error = EINVAL;
    if (mask && core >= 0 && core < kMaxCores) {
        CPU_ZERO_S(bytes, mask.get());
        CPU_SET_S(core, bytes, mask.get());
        error = pthread_setaffinity_np(pthread_self(), bytes, mask.get());
    }
    if (error != 0)
        log(Severity::Warning, "cannot pin a thread to core {}: {}; it stays unpinned", core, std::strerror(error));
    return error == 0;
}

void nameThisThread(std::string const& name) { pthread_setname_np(pthread_self(), name.substr(0, 15).c_str()); }

} // namespace filament::jobs
