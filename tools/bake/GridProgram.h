// SPDX-License-Identifier: Apache-2.0
/// GridProgram: filament-bake --grid: an irradiance grid as a JSON file describes it.
///   Fields  "at", "halfExtent" and "degrees" of the box in metres; "blend"; "name", which names the file, too;
///           "spacing" of the first grid in metres; "maxProbes", "maxError", "heldOut", "judged", "paths", "depthSize",
///           "maxBounces", "seed", "leakPoints" (GridSettings).
///   Out     NAME.grid, NAME-report.json, and the report in lines on standard output.
///   Thread  any; works on the job system.   Fails: as JsonReader and bakeIrradianceGrid(); errors of the file system.
#pragma once

#include "tools/bake/IrradianceBake.h"

#include <filesystem>

namespace filament_core::bake {

Result<GridSettings> readGridSettings(std::filesystem::path const& file);

/// `exposure`: ProbeSettings::exposure. Returns the file that was written.
Result<std::filesystem::path> runGrid(reference::TracedScene const& scene, std::filesystem::path const& file,
                                      double exposure, std::filesystem::path const& folder, jobs::JobSystem& jobs);

} // namespace filament_core::bake
