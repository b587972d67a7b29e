// SPDX-License-Identifier: Apache-2.0
#include "jobsystem/Topology.h"

#include "jobsystem/CpuMask.h"
#include "jobsystem/CpuQuota.h"

#include <fmt/format.h>
#include <hwloc.h>
#include <sched.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <map>
#include <memory>
#include <string_view>

namespace filament_core::jobs {
namespace {

struct FreeTopology {
    void operator()(hwloc_topology_t topology) const { hwloc_topology_destroy(topology); }
};
using HwlocTopology = std::unique_ptr<hwloc_topology, FreeTopology>;

// The speed of processors of one kind.
struct CpuKind {
    int efficiencyClass = 0;
    int maxMegahertz = 0;
};

// Load only cores and caches: loading everything takes 2 ms the first time. hwloc's x86 discovery would query each CPU,
// moving the calling thread from one to the next; the operating system has the same information.
HwlocTopology loadHwloc(std::string const& xml) {
    hwloc_topology_t raw = nullptr;
    if (hwloc_topology_init(&raw) != 0) return nullptr;
    HwlocTopology topology(raw);
    hwloc_topology_set_components(raw, HWLOC_TOPOLOGY_COMPONENTS_FLAG_BLACKLIST, "x86");
    hwloc_topology_set_all_types_filter(raw, HWLOC_TYPE_FILTER_KEEP_NONE);
    for (hwloc_obj_type_t type : { HWLOC_OBJ_CORE, HWLOC_OBJ_L2CACHE, HWLOC_OBJ_L3CACHE })
        hwloc_topology_set_type_filter(raw, type, HWLOC_TYPE_FILTER_KEEP_ALL);
    hwloc_topology_set_flags(raw, HWLOC_TOPOLOGY_FLAG_INCLUDE_DISALLOWED | HWLOC_TOPOLOGY_FLAG_DONT_CHANGE_BINDING |
                                          HWLOC_TOPOLOGY_FLAG_NO_DISTANCES | HWLOC_TOPOLOGY_FLAG_NO_MEMATTRS);
    if (!xml.empty() && hwloc_topology_set_xmlbuffer(raw, xml.c_str(), static_cast<int>(xml.size()) + 1) != 0)
        return nullptr;
    return hwloc_topology_load(raw) == 0 ? std::move(topology) : nullptr;
}

int megahertz(unsigned infoCount, hwloc_info_s const* infos) {
    for (hwloc_info_s const& info : std::span(infos, infoCount)) {
        if (info.name != std::string_view("FrequencyMaxMHz")) continue;
        int value = 0;
        std::from_chars(info.value, info.value + std::string_view(info.value).size(), value);
        return std::max(value, 0);
    }
    return 0;
}

// hwloc ranks kinds by the capacity, type and frequency that the system reports. If those do not suffice, it ranks none
// (-1); then the frequency alone decides.
std::vector<CpuKind> cpuKinds(hwloc_topology_t topology) {
    std::vector<CpuKind> kinds(static_cast<size_t>(std::max(0, hwloc_cpukinds_get_nr(topology, 0))));
    std::vector<int> frequencies;
    for (unsigned i = 0; i < kinds.size(); ++i) {
        unsigned infoCount = 0;
        hwloc_info_s* infos = nullptr;
        hwloc_cpukinds_get_info(topology, i, nullptr, &kinds[i].efficiencyClass, &infoCount, &infos, 0);
        kinds[i].maxMegahertz = megahertz(infoCount, infos);
        frequencies.push_back(kinds[i].maxMegahertz);
    }
    std::sort(frequencies.begin(), frequencies.end());
    frequencies.erase(std::unique(frequencies.begin(), frequencies.end()), frequencies.end());
    for (CpuKind& kind : kinds) {
        if (kind.efficiencyClass >= 0) continue;
        const auto rank = std::lower_bound(frequencies.begin(), frequencies.end(), kind.maxMegahertz);
        kind.efficiencyClass = static_cast<int>(rank - frequencies.begin());
    }
    return kinds;
}

Cpu cpuOf(hwloc_topology_t topology, hwloc_obj_t unit, std::span<const CpuKind> kinds) {
    const auto numberOf = [](hwloc_obj_t object) { return static_cast<int>(object->logical_index); };
    hwloc_obj_t core = hwloc_get_ancestor_obj_by_type(topology, HWLOC_OBJ_CORE, unit);
    hwloc_obj_t cache = hwloc_get_ancestor_obj_by_type(topology, HWLOC_OBJ_L3CACHE, unit);
    if (!cache) cache = hwloc_get_ancestor_obj_by_type(topology, HWLOC_OBJ_L2CACHE, unit);
    const int kind = hwloc_cpukinds_get_by_cpuset(topology, unit->cpuset, 0);
    const CpuKind speed = kind >= 0 && kind < std::ssize(kinds) ? kinds[static_cast<size_t>(kind)] : CpuKind();
    return { .index = static_cast<int>(unit->os_index),
             .physicalCore = core ? numberOf(core) : numberOf(unit),
             .cacheGroup = cache ? numberOf(cache) : 0,
             .efficiencyClass = speed.efficiencyClass,
             .maxMegahertz = speed.maxMegahertz };
}

// All CPUs of the machine, allowed or not, with hwloc's numbers. Empty if hwloc finds nothing.
std::vector<Cpu> describeMachine(std::string const& xml) {
    std::vector<Cpu> cpus;
    const HwlocTopology topology = loadHwloc(xml);
    if (!topology) return cpus;
    const std::vector<CpuKind> kinds = cpuKinds(topology.get());
    hwloc_obj_t unit = nullptr;
    while ((unit = hwloc_get_next_obj_by_type(topology.get(), HWLOC_OBJ_PU, unit)))
        cpus.push_back(cpuOf(topology.get(), unit, kinds));
    return cpus;
}

std::vector<Cpu> const& thisMachine() {
    static const std::vector<Cpu> cpus = describeMachine({});
    return cpus;
}

// Numbers names 0, 1, 2, ... in the order of first use.
class Renumbering {
public:
    int operator()(int name) { return mNumbers.try_emplace(name, static_cast<int>(mNumbers.size())).first->second; }

private:
    std::map<int, int> mNumbers;
};

std::vector<Cpu> selectCpus(std::span<const Cpu> machine, std::span<const int> cores) {
    std::vector<Cpu> selected;
    Renumbering physicalCores, cacheGroups;
    std::map<int, int> smtThreads;
    for (int core : cores) {
        const auto known = std::find_if(machine.begin(), machine.end(), [&](Cpu const& c) { return c.index == core; });
        Cpu cpu = known != machine.end() ? *known : Cpu{ .index = core, .physicalCore = -1 - core };
        cpu.physicalCore = physicalCores(cpu.physicalCore);
        cpu.cacheGroup = cacheGroups(cpu.cacheGroup);
        cpu.smtRank = smtThreads[cpu.physicalCore]++;
        selected.push_back(cpu);
    }
    return selected;
}

} // namespace

std::vector<int> coresOfThisThread() {
    const CpuMask mask = makeCpuMask();
    std::vector<int> cores;
    if (mask && sched_getaffinity(0, kCpuMaskBytes, mask.get()) == 0) {
        for (int core = 0; core < kMaxCores; ++core) {
            if (CPU_ISSET_S(core, kCpuMaskBytes, mask.get())) cores.push_back(core);
        }
    }
    if (cores.empty()) cores.push_back(0);
    return cores;
}

uint32_t usableThreads(size_t cores, double quota) {
    return static_cast<uint32_t>(std::max(1.0, std::min(static_cast<double>(cores), quota)));
}

CpuBudget readCpuBudget(TopologySource const& source) {
    CpuBudget budget;
    budget.cores = source.cores.empty() ? coresOfThisThread() : source.cores;
    budget.quota = cpuQuota(source.root);
    budget.usableThreads = usableThreads(budget.cores.size(), budget.quota);
    return budget;
}

Topology readTopology(TopologySource const& source) {
    const CpuBudget budget = readCpuBudget(source);
    const bool here = source.hwlocXml.empty();
    return { here ? selectCpus(thisMachine(), budget.cores)
                  : selectCpus(describeMachine(source.hwlocXml), budget.cores),
             budget.quota, budget.usableThreads };
}

std::string rangesOf(std::span<const int> cores) {
    std::string text;
    for (size_t first = 0, last = 0; first < cores.size(); first = ++last) {
        while (last + 1 < cores.size() && cores[last + 1] == cores[last] + 1) ++last;
        fmt::format_to(std::back_inserter(text), "{}{}", text.empty() ? "" : ",", cores[first]);
        if (last > first) fmt::format_to(std::back_inserter(text), "-{}", cores[last]);
    }
    return text;
}

} // namespace filament_core::jobs
