// SPDX-License-Identifier: Apache-2.0
#include "tools/view/stage/LoadedProbes.h"

#include "filament_core/assets/files/FileBytes.h"

#include <algorithm>

namespace filament_core::view {
namespace {

Result<IrradianceGridDesc> readGrid(std::filesystem::path const& file) {
    const Result<std::vector<std::byte>> bytes = assets::readFileBytes(file);
    if (!bytes) return bytes.error();
    Result<IrradianceGridDesc> grid = readIrradianceGrid(*bytes);
    if (!grid) return fail(grid.error().code, "{}: {}", file.string(), grid.error().message);
    return grid;
}

} // namespace

void LoadedProbes::wantGrids(Document const& document, bool again, Messages& messages) {
    auto known = std::exchange(mGrids, {});
    for (DocumentGrid const& grid : document.grids) {
        if (grid.file.empty() || mGrids.contains(grid.file)) continue;
        if (const auto found = known.find(grid.file); found != known.end() && !again) {
            mGrids.emplace(grid.file, std::move(found->second));
            continue;
        }
        Result<IrradianceGridDesc> read = readGrid(grid.file);
        if (read)
            mGrids.emplace(grid.file, std::move(*read));
        else
            messages.addOnce(read.error().message);
    }
}

void LoadedProbes::want(Engine& engine, Document const& document, bool again, Abandoned& abandoned,
                        Messages& messages) {
    wantGrids(document, again, messages);
    DocumentEnvironment options{ .options = document.environment.options };
    options.options.sun = EnvironmentSun::Keep;
    const bool areOthers = !(options == mOptions);
    mOptions = options;
    for (auto entry = mEntries.begin(); entry != mEntries.end();) {
        if (std::ranges::find(document.probes, entry->first, &DocumentProbe::file) != document.probes.end()) {
            ++entry;
            continue;
        }
        if (entry->second.load) entry->second.load->abandon(abandoned);
        if (entry->second.light) mRetired.push_back(std::move(*entry->second.light));
        entry = mEntries.erase(entry);
    }
    for (DocumentProbe const& probe : document.probes) {
        if (probe.file.empty() || (!again && !areOthers && mEntries.contains(probe.file))) continue;
        Entry& entry = mEntries[probe.file];
        if (entry.load) entry.load->abandon(abandoned);
        options.file = probe.file;
        entry.load.emplace(engine, options);
    }
}

bool LoadedProbes::poll(Engine& engine, size_t sliceBytes, Messages& messages) {
    bool isNew = false;
    for (auto& [file, entry] : mEntries) {
        if (!entry.load || !entry.load->poll(sliceBytes).isFinished) continue;
        Result<Environment> light = entry.load->take(engine);
        entry.load.reset();
        if (!light) {
            messages.add(light.error().message);
            continue;
        }
        if (entry.light) mRetired.push_back(std::move(*entry.light));
        entry.light.emplace(std::move(*light));
        isNew = true;
    }
    return isNew;
}

void LoadedProbes::drop(Abandoned& abandoned) {
    for (auto& [file, entry] : mEntries) {
        if (entry.load) entry.load->abandon(abandoned);
        entry.load.reset();
    }
}

std::optional<ReflectionProbeDesc> LoadedProbes::find(DocumentProbe const& probe) const {
    const auto found = mEntries.find(probe.file);
    if (!probe.isOn || found == mEntries.end() || !found->second.light) return std::nullopt;
    return ReflectionProbeDesc{ .centerWorld = probe.centerWorld,
                                .halfExtentMeters = probe.halfExtentMeters,
                                .blendMeters = probe.blendMeters,
                                .light = found->second.light->indirectLight(),
                                .intensity = probe.intensity,
                                .lightsDiffuse = probe.lightsDiffuse,
                                .name = probe.name };
}

std::optional<IrradianceGridDesc> LoadedProbes::find(DocumentGrid const& grid) const {
    const auto found = mGrids.find(grid.file);
    if (!grid.isOn || found == mGrids.end()) return std::nullopt;
    IrradianceGridDesc desc = found->second;
    desc.intensity *= grid.intensity;
    return desc;
}

std::optional<std::filesystem::path> LoadedProbes::firstLoading() const {
    for (auto const& [file, entry] : mEntries)
        if (entry.load) return file;
    return std::nullopt;
}

} // namespace filament_core::view
