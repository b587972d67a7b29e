// SPDX-License-Identifier: Apache-2.0
/// Affinity: places the threads of a job system on cores, as an AffinityPolicy requests.
///   Pins    a registry of the process counts the pinned threads of each core, so that two systems share a core only if
///           none is free. Distinct physical cores are lent first, then their other hardware threads, faster ones
///           first. One core is lent last: it is kept for the thread that made the system.
///   Thread  CoreRegistry: any. placeWorker() and *ThisThread() place the calling thread.
///   Fails   never: a core that does not exist, or that the operating system refuses, is named in a warning and
///           ignored.
///   Cost    one system call per thread that is placed; none for a system without a policy.
#pragma once

#include "base/Result.h"
#include "jobsystem/AffinityPolicy.h"
#include "jobsystem/Topology.h"

#include <cstdint>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace filament_core::jobs {

/// The processors that a policy allows for workers; never empty, because a policy that allows none is ignored.
std::vector<Cpu> allowedCpus(AffinityPolicy const& policy, Topology const& topology);

/// The number of usable threads minus one for the caller, but at most one per allowed core.
uint32_t defaultWorkerCount(AffinityPolicy const& policy);

/// InvalidArgument unless this process may run on `core`; `option` names the user's option in the message.
Result<void> requireCore(int core, std::string_view option);

/// False, with a warning, if the operating system refuses; the thread then stays where it was.
bool bindThisThread(std::span<const int> cores);
bool pinThisThread(int core);
/// The name that debuggers and profilers show; the operating system keeps 15 bytes.
void nameThisThread(std::string const& name);
std::string nameOfThisThread();

class CoreRegistry;

/// Cores on loan, returned by the destructor.
class CorePins {
public:
    CorePins() = default;
    CorePins(CoreRegistry& registry, std::vector<int> cores, int callerCore)
            : mRegistry(&registry), mCores(std::move(cores)), mCallerCore(callerCore) {}
    CorePins(CorePins&& other) noexcept { swap(other); }
    CorePins& operator=(CorePins&& other) noexcept {
        CorePins(std::move(other)).swap(*this);
        return *this;
    }
    ~CorePins();

    /// One core per thread; cores repeat if there are fewer cores than threads.
    std::span<const int> cores() const { return mCores; }
    /// Kept free for the requesting thread if possible; -1: none.
    int callerCore() const { return mCallerCore; }

private:
    void swap(CorePins& other) noexcept;

    CoreRegistry* mRegistry = nullptr;
    std::vector<int> mCores;
    int mCallerCore = -1;
};

/// Records which threads are pinned to which core.
class CoreRegistry {
public:
    /// The registry shared by all systems.
    static CoreRegistry& ofProcess();

    /// Lends `threads` cores out of `candidates`, the least used first; `topology` says which ones are neighbours.
    CorePins lend(Topology const& topology, std::span<const Cpu> candidates, uint32_t threads, std::string_view owner);
    /// Records a thread that other code binds to `core`, so that lend() uses that core last. -1 is no core.
    CorePins reserve(int core);
    void giveBack(CorePins const& pins);

private:
    struct Use {
        int pins = 0;    // threads bound to it
        int callers = 0; // systems that keep it free for the thread that made them
    };

    Cpu const& leastUsed(Topology const& topology, std::span<const Cpu> candidates);
    Use& use(int core);

    std::mutex mMutex;
    std::vector<Use> mUses; // indexed by core
};

/// Where the threads of one system run: its constructor decides, and each thread applies it when it starts.
class WorkerPlacement {
public:
    WorkerPlacement(AffinityPolicy const& policy, uint32_t workers, std::string_view owner);

    void placeWorker(uint32_t worker) const;
    /// Again, without a warning, if the policy requires it.
    void placeWorkerAfterWait(uint32_t worker) const;
    /// For background threads: anywhere except on the avoided cores.
    void placeBackgroundThread() const;

private:
    std::span<const int> coresOf(uint32_t worker) const;

    bool mRepins = false;
    CorePins mPins;                  // for Pin, by worker
    std::vector<int> mWorkerCores;   // for BigCores and avoided cores; empty: no restriction
    std::vector<int> mUnpinnedCores; // for threads started by a pinned thread; empty: they inherit its mask
};

} // namespace filament_core::jobs
