// SPDX-License-Identifier: Apache-2.0
/// Bakes: scenes whose light tools/bake has traced, for rows that compare baked light with what it replaces.
///   In      a scene and what is to be baked. Its model stands at the origin, once, and does not move.
///   Out     the scene with the lightmap's model, or with an irradiance grid over the box of the model. The box ends 5
///           cm within the faces of the model: in walls of 10 cm.
///   Cost    minutes for fine lightmaps: kept, so each is baked once for all backends and pictures.
///   Thread  one at a time; works on a job system of its own.
///   Fails   errors of the loaders and of tools/bake; InvalidArgument for a scene with copies or an origin.
#pragma once

#include "jobsystem/JobSystem.h"
#include "toolkit/scenes/SceneAssets.h"
#include "tools/accuracy/Settings.h"

#include <map>
#include <optional>

namespace filament_core::accuracy {

class Bakes {
public:
    /// `lightmapPaths`: of each texel. `gridPaths`: of each probe.
    explicit Bakes(uint32_t lightmapPaths = 256, uint32_t gridPaths = 2048)
            : mLightmapPaths(lightmapPaths), mGridPaths(gridPaths) {}

    /// The scene itself where nothing is to be baked. Valid as long as this object and `spec`.
    Result<tools::SceneSpec const*> bake(tools::SceneSpec const& spec, BakeChoice const& choice,
                                         tools::SceneFolders const& folders);

private:
    Result<tools::SceneSpec> make(tools::SceneSpec const& spec, BakeChoice const& choice,
                                  tools::SceneFolders const& folders);

    uint32_t mLightmapPaths, mGridPaths;
    std::map<std::string, tools::SceneSpec> mScenes; // by name and choice
    std::optional<jobs::JobSystem> mJobs;            // once something is baked
};

} // namespace filament_core::accuracy
