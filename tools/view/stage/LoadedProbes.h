// SPDX-License-Identifier: Apache-2.0
/// LoadedProbes: what the reflection probes of a document see, and its irradiance grids, on one engine.
///   Loads    probes in the background, each file once; what was there stays until another one has come. Grids at
///            once: they are small files.
///   Options  those of the document's environment: cubes of probes and of the environment agree in size and format.
///   Life     light that is no longer wanted lives until dropRetired(): the scene may still show it.
///   Thread   the app thread of the engine.
///   Fails    a message, once a load; the probe or grid then lights nothing.
#pragma once

#include "tools/view/stage/Loaded.h"
#include "tools/view/stage/Messages.h"

#include <filament_core/IrradianceGrid.h>
#include <filament_core/ReflectionProbe.h>

#include <map>

namespace filament_core::view {

class LoadedProbes {
public:
    /// Begins to load what is not there, or all of it again.
    void want(Engine& engine, Document const& document, bool again, Abandoned& abandoned, Messages& messages);
    /// True: the scene is to be built again; after that, dropRetired().
    bool poll(Engine& engine, size_t sliceBytes, Messages& messages);
    void drop(Abandoned& abandoned); ///< unfinished loads
    void dropRetired() { mRetired.clear(); }

    /// None: it is off, not there yet, or its file cannot be read.
    std::optional<ReflectionProbeDesc> find(DocumentProbe const& probe) const;
    std::optional<IrradianceGridDesc> find(DocumentGrid const& grid) const;
    bool isLoading() const { return firstLoading().has_value(); }
    std::optional<std::filesystem::path> firstLoading() const;

private:
    struct Entry {
        std::optional<EnvironmentLoad> load{};
        std::optional<Environment> light{};
    };
    void wantGrids(Document const& document, bool again, Messages& messages);

    std::map<std::filesystem::path, Entry> mEntries;
    std::map<std::filesystem::path, IrradianceGridDesc> mGrids;
    DocumentEnvironment mOptions{}; ///< its options alone
    std::vector<Environment> mRetired;
};

} // namespace filament_core::view
