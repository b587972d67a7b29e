// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/Affinity.h"

#include "base/Log.h"
#include "jobsystem/CpuMask.h"

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <tuple>

namespace filament_core::jobs {
namespace {

bool contains(std::span<const int> cores, int core) {
    return std::find(cores.begin(), cores.end(), core) != cores.end();
}

std::vector<int> indicesOf(std::span<const Cpu> cpus) {
    std::vector<int> indices;
    for (Cpu const& cpu : cpus) indices.push_back(cpu.index);
    return indices;
}

int bindToMask(std::span<const int> cores) {
    const CpuMask mask = makeCpuMask();
    if (!mask) return ENOMEM;
    for (int core : cores) {
        if (core < 0 || core >= kMaxCores) return EINVAL;
        CPU_SET_S(core, kCpuMaskBytes, mask.get());
    }
    return pthread_setaffinity_np(pthread_self(), kCpuMaskBytes, mask.get());
}

void reportIgnored(AffinityPolicy const& policy, Topology const& topology, std::string_view owner) {
    const std::vector<int> cores = indicesOf(topology.cpus);
    for (int core : policy.avoidedCores) {
        if (!contains(cores, core))
            log(Severity::Warning, "{}: avoiding core {} has no effect: this process may run only on cores {}", owner,
                core, rangesOf(cores));
    }
    for (Cpu const& cpu : allowedCpus(policy, topology)) {
        if (contains(policy.avoidedCores, cpu.index))
            log(Severity::Warning, "{}: core {} cannot be avoided: no other core is left", owner, cpu.index);
    }
}

} // namespace

// ---------------------------------------------------------------------------------------------- policy

AffinityPolicy AffinityPolicy::avoiding(int core) const {
    AffinityPolicy policy = *this;
    if (!contains(policy.avoidedCores, core)) policy.avoidedCores.push_back(core);
    return policy;
}

std::vector<Cpu> allowedCpus(AffinityPolicy const& policy, Topology const& topology) {
    std::vector<Cpu> cpus = topology.cpus;
    const auto keepUnlessNoneIsLeft = [&](auto const& isAllowed) {
        std::vector<Cpu> kept;
        std::copy_if(cpus.begin(), cpus.end(), std::back_inserter(kept), isAllowed);
        if (!kept.empty()) cpus = std::move(kept);
    };
    if (policy.kind == AffinityPolicy::Kind::BigCores) {
        const auto slower = [](Cpu const& a, Cpu const& b) { return a.efficiencyClass < b.efficiencyClass; };
        const int best = std::max_element(cpus.begin(), cpus.end(), slower)->efficiencyClass;
        keepUnlessNoneIsLeft([&](Cpu const& cpu) { return cpu.efficiencyClass == best; });
    }
    keepUnlessNoneIsLeft([&](Cpu const& cpu) { return !contains(policy.avoidedCores, cpu.index); });
    return cpus;
}

uint32_t defaultWorkerCount(AffinityPolicy const& policy) {
    if (policy.isNone()) return readCpuBudget().usableThreads - 1;
    const Topology topology = readTopology();
    return std::min(topology.usableThreads - 1, static_cast<uint32_t>(allowedCpus(policy, topology).size()));
}

Result<void> requireCore(int core, std::string_view option) {
    const std::vector<int> cores = coresOfThisThread();
    if (contains(cores, core)) return {};
    return fail(ErrorCode::InvalidArgument,
                "{}: there is no core {} for this process; choose one of {}, or -1 for none", option, core,
                rangesOf(cores));
}

// ---------------------------------------------------------------------------------------------- threads

bool bindThisThread(std::span<const int> cores) {
    const int error = bindToMask(cores);
    if (error != 0)
        log(Severity::Warning, "cannot bind a thread to core {}: {}; it stays where it was", rangesOf(cores),
            std::strerror(error));
    return error == 0;
}

bool pinThisThread(int core) { return bindThisThread({ &core, 1 }); }

void nameThisThread(std::string const& name) { pthread_setname_np(pthread_self(), name.substr(0, 15).c_str()); }

std::string nameOfThisThread() {
    char name[16] = {};
    pthread_getname_np(pthread_self(), name, sizeof(name));
    return name;
}

// ---------------------------------------------------------------------------------------------- pins

CorePins::~CorePins() {
    if (mRegistry) mRegistry->giveBack(*this);
}

void CorePins::swap(CorePins& other) noexcept {
    std::swap(mRegistry, other.mRegistry);
    std::swap(mCores, other.mCores);
    std::swap(mCallerCore, other.mCallerCore);
}

CoreRegistry& CoreRegistry::ofProcess() {
    static auto& registry = *new CoreRegistry; // never destroyed: cores may be returned as the process ends
    return registry;
}

CorePins CoreRegistry::lend(Topology const& topology, std::span<const Cpu> candidates, uint32_t threads,
                            std::string_view owner) {
    if (threads == 0 || candidates.empty()) return {};
    const std::lock_guard lock(mMutex);
    const int callerCore = leastUsed(topology, topology.cpus).index;
    ++use(callerCore).callers;
    std::vector<int> cores;
    uint32_t shared = 0;
    while (cores.size() < threads) {
        const int core = leastUsed(topology, candidates).index;
        if (use(core).pins++ > 0) ++shared;
        cores.push_back(core);
    }
    if (shared > 0)
        log(Severity::Warning, "{}: {} of {} pinned threads share a core with another one: only {} cores are available",
            owner, shared, threads, candidates.size());
    return { *this, std::move(cores), callerCore };
}

CorePins CoreRegistry::reserve(int core) {
    if (core < 0 || core >= kMaxCores) return {};
    const std::lock_guard lock(mMutex);
    ++use(core).pins;
    return { *this, { core }, -1 };
}

void CoreRegistry::giveBack(CorePins const& pins) {
    const std::lock_guard lock(mMutex);
    for (int core : pins.cores()) --use(core).pins;
    if (pins.callerCore() >= 0) --use(pins.callerCore()).callers;
}

CoreRegistry::Use& CoreRegistry::use(int core) {
    const auto index = static_cast<size_t>(core);
    if (index >= mUses.size()) mUses.resize(index + 1);
    return mUses[index];
}

// Prefers, in this order: the hardware thread with the fewest pins, the physical core with the fewest users, a core
// that no caller is expected to use, the faster class, the cache that is already in use, and the lowest number.
Cpu const& CoreRegistry::leastUsed(Topology const& topology, std::span<const Cpu> candidates) {
    std::vector<int> ofPhysicalCore(topology.cpus.size());
    for (Cpu const& cpu : topology.cpus)
        ofPhysicalCore[static_cast<size_t>(cpu.physicalCore)] += use(cpu.index).pins + use(cpu.index).callers;
    const auto rank = [&](Cpu const& cpu) {
        Use const& used = use(cpu.index);
        return std::tuple(used.pins, ofPhysicalCore[static_cast<size_t>(cpu.physicalCore)], used.callers,
                          -cpu.efficiencyClass, cpu.cacheGroup, cpu.index);
    };
    return *std::min_element(candidates.begin(), candidates.end(),
                             [&](Cpu const& a, Cpu const& b) { return rank(a) < rank(b); });
}

// ---------------------------------------------------------------------------------------------- placement

WorkerPlacement::WorkerPlacement(AffinityPolicy const& policy, uint32_t workers, std::string_view owner)
        : mRepins(policy.repinsAfterWaits) {
    if (policy.isNone()) return;
    const Topology topology = readTopology();
    reportIgnored(policy, topology, owner);
    const std::vector<Cpu> allowed = allowedCpus(policy, topology);
    if (policy.kind == AffinityPolicy::Kind::Pin)
        mPins = CoreRegistry::ofProcess().lend(topology, allowed, workers, owner);
    else if (allowed.size() < topology.cpus.size())
        mWorkerCores = indicesOf(allowed);
    mUnpinnedCores = indicesOf(allowedCpus(AffinityPolicy{ .avoidedCores = policy.avoidedCores }, topology));
}

std::span<const int> WorkerPlacement::coresOf(uint32_t worker) const {
    return worker < mPins.cores().size() ? mPins.cores().subspan(worker, 1) : std::span(mWorkerCores);
}

void WorkerPlacement::placeWorker(uint32_t worker) const {
    if (const std::span<const int> cores = coresOf(worker); !cores.empty()) bindThisThread(cores);
}

void WorkerPlacement::placeWorkerAfterWait(uint32_t worker) const {
    if (!mRepins) return;
    if (const std::span<const int> cores = coresOf(worker); !cores.empty()) bindToMask(cores);
}

void WorkerPlacement::placeBackgroundThread() const {
    if (!mUnpinnedCores.empty()) bindThisThread(mUnpinnedCores);
}

} // namespace filament_core::jobs
