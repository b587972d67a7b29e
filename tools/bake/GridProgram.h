// SPDX-License-Identifier: Apache-2.0
/// GridProgram: the files of filament-bake --grid: an irradiance grid as a JSON file describes it.
///   Fields  "at", "halfExtent" and "degrees" of the box in metres; "blend"; "name", which names the file, too;
///           "spacing" of the first grid in metres; "maxProbes", "maxError", "heldOut", "judged", "paths", "depthSize",
///           "maxBounces", "seed", "leakPoints" (GridSettings).
///   Out     NAME.grid, NAME-report.json, and the report in lines on standard output.
///   Thread  any; works on the job system.   Fails: as JsonReader and checkGridSettings(); errors of the file system.
#pragma once

#include "tools/bake/IrradianceBake.h"
#include "tools/bake/Options.h"

#include <filesystem>

namespace filament_core::bake {

Result<GridSettings> readGridSettings(std::filesystem::path const& file);

struct GridInput {
    GridSettings settings;
    reference::TracedScenePtr scene;
    uint64_t hash = 0; ///< of all that the probes depend on
};
/// Adds to `warnings`.
Result<GridInput> readGridInput(Options const& options, jobs::JobSystem& jobs, std::vector<std::string>& warnings);

Result<void> writeGrid(BakedGrid const& baked, std::filesystem::path const& folder);

} // namespace filament_core::bake
