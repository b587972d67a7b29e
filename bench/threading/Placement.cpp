// SPDX-License-Identifier: Apache-2.0
#include "bench/threading/Placement.h"

#include "bench/threading/Clock.h"

#include <csignal>
#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <span>
#include <thread>

namespace filament_core::bench {
namespace {

bool restrictTo(std::span<const int> cores) {
    cpu_set_t set;
    CPU_ZERO(&set);
    for (const int core : cores) CPU_SET(core, &set);
    return sched_setaffinity(0, sizeof(set), &set) == 0;
}

std::vector<int> coresOfMask() {
    cpu_set_t set;
    CPU_ZERO(&set);
    std::vector<int> cores;
    if (sched_getaffinity(0, sizeof(set), &set) == 0) {
        for (int core = 0; core < CPU_SETSIZE; ++core)
            if (CPU_ISSET(core, &set)) cores.push_back(core);
    }
    if (cores.empty()) cores.push_back(0);
    return cores;
}

/// Runs in the child after fork(): only calls that are safe between fork and exec in a program with threads.
[[noreturn]] void hogForever(int core, pid_t parent) {
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != parent) _exit(0); // the parent died before the line above
    if (!pinToCore(core)) _exit(1);
    raise(SIGSTOP);
    for (;;) asm volatile("");
}

} // namespace

std::vector<int> const& allowedCores() {
    static const std::vector<int> kCores = coresOfMask();
    return kCores;
}

int coreOfThread(unsigned index) { return allowedCores()[index % allowedCores().size()]; }

bool pinToCore(int core) { return restrictTo({ &core, 1 }); }

PinnedScope::PinnedScope(int core) { pinToCore(core); }
PinnedScope::~PinnedScope() { restrictTo(allowedCores()); }

HogProcess::HogProcess(int core) {
    const pid_t parent = getpid();
    mChild = fork();
    if (mChild == 0) hogForever(core, parent);
    int status = 0;
    if (mChild > 0 && (waitpid(mChild, &status, WUNTRACED) != mChild || !WIFSTOPPED(status))) mChild = -1;
}

HogProcess::~HogProcess() {
    if (mChild <= 0) return;
    kill(mChild, SIGKILL);
    waitpid(mChild, nullptr, 0);
}

void HogProcess::hog() {
    if (mChild <= 0) return;
    kill(mChild, SIGCONT);
    waitpid(mChild, nullptr, WCONTINUED);
    std::this_thread::sleep_for(
            std::chrono::milliseconds(5)); // by then the child is scheduled, unless the core is full
}

void HogProcess::relent() {
    if (mChild <= 0) return;
    kill(mChild, SIGSTOP);
    waitpid(mChild, nullptr, WUNTRACED);
}

} // namespace filament_core::bench
