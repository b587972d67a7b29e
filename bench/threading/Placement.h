// SPDX-License-Identifier: Apache-2.0
/// Placement: the cores that a measurement uses, pinning for a scope, and a process that hogs a core.
///   Thread  pinning acts on the calling thread.
///   Fails   if a core cannot be used, the thread stays where it was; HogProcess::isRunning() reports whether the hog
///           could be started.
#pragma once

#include <sys/types.h>

#include <vector>

namespace filament_core::bench {

/// Logical cores that this process could use when it started, ascending; queried once.
std::vector<int> const& allowedCores();

/// The core of thread `index` when threads are pinned one per core: 0 is the caller.
int coreOfThread(unsigned index);

/// Pins the calling thread to a core; the destructor, on the same thread, allows all cores again. (It does not restore
/// the previous mask: a pool may have started the thread from a pinned one.)
class PinnedScope {
public:
    explicit PinnedScope(int core);
    ~PinnedScope();
    PinnedScope(PinnedScope const&) = delete;
    PinnedScope& operator=(PinnedScope const&) = delete;
};

/// The calling thread may run on this core only. False if the system refuses.
bool pinToCore(int core);

/// A real separate process that spins on one core when told to, and sleeps otherwise. It ends with this process.
class HogProcess {
public:
    explicit HogProcess(int core);
    ~HogProcess();
    HogProcess(HogProcess const&) = delete;
    HogProcess& operator=(HogProcess const&) = delete;

    bool isRunning() const { return mChild > 0; }
    void hog();    ///< returns when the child has the core
    void relent(); ///< returns when it is stopped

private:
    pid_t mChild = -1;
};

} // namespace filament_core::bench
