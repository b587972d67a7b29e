// SPDX-License-Identifier: Apache-2.0
/// FakeMachine: the XML that hwloc would export on a different machine.
///   FakeMachine("pack:1 l3:2 core:2 pu:2").kind({ 0, 1 }, { { "FrequencyMaxMHz", "5100" } }).xml()
#pragma once

#include <hwloc.h>

#include <initializer_list>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace filament_core::jobs {

class FakeMachine {
public:
    explicit FakeMachine(const char* synthetic) {
        hwloc_topology_init(&mTopology);
        if (hwloc_topology_set_synthetic(mTopology, synthetic) != 0 || hwloc_topology_load(mTopology) != 0)
            throw std::invalid_argument(synthetic);
    }
    ~FakeMachine() { hwloc_topology_destroy(mTopology); }
    FakeMachine(FakeMachine const&) = delete;
    FakeMachine& operator=(FakeMachine const&) = delete;

    /// Sets what an operating system would report about these processors as a separate kind.
    FakeMachine& kind(std::initializer_list<unsigned> cpus,
                      std::initializer_list<std::pair<const char*, const char*>> properties) {
        hwloc_bitmap_t set = hwloc_bitmap_alloc();
        for (unsigned cpu : cpus) hwloc_bitmap_set(set, cpu);
        std::vector<hwloc_info_s> infos;
        for (auto const& [name, value] : properties)
            infos.push_back({ const_cast<char*>(name), const_cast<char*>(value) }); // hwloc copies them
        hwloc_cpukinds_register(mTopology, set, -1, static_cast<unsigned>(infos.size()), infos.data(), 0);
        hwloc_bitmap_free(set);
        return *this;
    }

    std::string xml() const {
        char* buffer = nullptr;
        int length = 0;
        if (hwloc_topology_export_xmlbuffer(mTopology, &buffer, &length, 0) != 0) throw std::runtime_error("no XML");
        const std::string text(buffer);
        hwloc_free_xmlbuffer(mTopology, buffer);
        return text;
    }

private:
    hwloc_topology_t mTopology = nullptr;
};

} // namespace filament_core::jobs
