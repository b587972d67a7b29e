// SPDX-License-Identifier: Apache-2.0
/// Placement: which cores a measurement uses, pinning for the length of a scope, and a process that hogs a core.
///   Thread  pinning acts on the calling thread.
///   Fails   a core that cannot be pinned to leaves the thread where it was; a hog that cannot be started runs nowhere:
///           HogProcess::isRunning() says so.
#pragma once

#include <sys/types.h>

#include <vector>

namespace filament::bench {

/// Logical cores that this process could use when it started, ascending; asked once.
std::vector<int> const& allowedCores();

/// The core of thread `index` when threads are pinned one a core: 0 is the caller.
int coreOfThread(unsigned index);

/// Ties the calling thread to a core; the destructor, on the same thread, gives it all allowed cores. (Not the mask
/// from before: a pool may have started the thread from one that was pinned.)
class PinnedScope {
public:
    explicit PinnedScope(int core);
    ~PinnedScope();
    PinnedScope(PinnedScope const&) = delete;
    PinnedScope& operator=(PinnedScope const&) = delete;
};

/// The calling thread may run on this core only. False if the system refuses.
bool pinToCore(int core);

/// A real other process that spins on one core, asleep until told to hog. It dies with this process.
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

} // namespace filament::bench
