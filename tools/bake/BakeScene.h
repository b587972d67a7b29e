// SPDX-License-Identifier: Apache-2.0
/// prepareBake: the files and lights of a command line, ready to be baked.
///   Thread  any, one call at a time; works on the job system.
///   Fails   errors of the loaders, with path; those of makeAtlas().
#pragma once

#include "tools/bake/BakeModel.h"
#include "tools/bake/HeldOut.h"
#include "tools/bake/Options.h"

namespace filament_core::bake {

struct BakeScene {
    BakeModel model;
    Atlas atlas;
    std::vector<AtlasTexel> texels;
    std::vector<HeldOutPoint> heldOut;
    reference::TracedScenePtr scene;
    uint64_t hash = 0; ///< of all that their light depends on
    std::vector<std::string> warnings;

    /// What is traced: texels, then held-out points.
    size_t traced() const { return texels.size() + heldOut.size(); }
};

Result<BakeScene> prepareBake(Options const& options, jobs::JobSystem& jobs);

/// The scene alone, for probes. Adds to `warnings`; `hash`: of all that its light depends on.
Result<reference::TracedScenePtr> traceScene(Options const& options, jobs::JobSystem& jobs,
                                             std::vector<std::string>& warnings, uint64_t& hash);

} // namespace filament_core::bake
