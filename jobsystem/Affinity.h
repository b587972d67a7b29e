// SPDX-License-Identifier: Apache-2.0
/// Affinity: on which cores the threads of a job system run, as an AffinityPolicy asks.
///   Pins    a registry of the process remembers which core has how many pinned threads, so that two systems share a
///           core only when none is free. Distinct physical cores are lent first, then their other hardware threads,
///           faster ones before slower ones; one core that is lent last is meant for the thread that made the system.
///   Thread  CoreRegistry: any. placeWorker() and *ThisThread(): the calling thread is the one that is placed.
///   Fails   never: a core that is not there, or that the operating system refuses, is named in a warning and left out.
///   Cost    one system call for a thread that is placed; a system without a policy asks nobody.
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

namespace filament::jobs {

/// The processors that a policy leaves to the workers; never empty, because a policy that leaves none avoids nothing.
std::vector<Cpu> allowedCpus(AffinityPolicy const& policy, Topology const& topology);

/// One less than the usable threads, which is the caller, and not more than there are cores for them.
uint32_t defaultWorkerCount(AffinityPolicy const& policy);

/// InvalidArgument unless this process may run on `core`; `option` is what the user set, for the message.
Result<void> requireCore(int core, std::string_view option);

/// False, and a warning, if the operating system refuses; the thread stays where it was.
bool bindThisThread(std::span<const int> cores);
bool pinThisThread(int core);
/// What debuggers and profilers show; the operating system keeps 15 bytes.
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

    /// One for each thread; cores repeat if there are fewer cores than threads.
    std::span<const int> cores() const { return mCores; }
    /// Spared for the thread that asked, as far as there are cores; -1 for none.
    int callerCore() const { return mCallerCore; }

private:
    void swap(CorePins& other) noexcept;

    CoreRegistry* mRegistry = nullptr;
    std::vector<int> mCores;
    int mCallerCore = -1;
};

/// Who is pinned where.
class CoreRegistry {
public:
    /// The one that all systems share.
    static CoreRegistry& ofProcess();

    /// `threads` cores out of `candidates`, the least used first; `topology` tells which ones are neighbours.
    CorePins lend(Topology const& topology, std::span<const Cpu> candidates, uint32_t threads, std::string_view owner);
    /// Notes a thread that somebody else ties to `core`, so that lend() gives that core last. -1 is no core.
    CorePins reserve(int core);
    void giveBack(CorePins const& pins);

private:
    struct Use {
        int pins = 0;    // threads tied to it
        int callers = 0; // systems that spare it for the thread that made them
    };

    Cpu const& leastUsed(Topology const& topology, std::span<const Cpu> candidates);
    Use& use(int core);

    std::mutex mMutex;
    std::vector<Use> mUses; // by the number of the core
};

/// Where the threads of one system run: decided by its constructor, carried out by each thread as it starts.
class WorkerPlacement {
public:
    WorkerPlacement(AffinityPolicy const& policy, uint32_t workers, std::string_view owner);

    void placeWorker(uint32_t worker) const;
    /// For threads that do long work beside the workers: anywhere but on the avoided cores.
    void placeBackgroundThread() const;

private:
    CorePins mPins;                  // of Pin, by worker
    std::vector<int> mWorkerCores;   // of BigCores and avoided cores; empty: no restriction
    std::vector<int> mUnpinnedCores; // what a thread gets that a pinned one starts; empty: what it inherits
};

} // namespace filament::jobs
