// SPDX-License-Identifier: Apache-2.0
/// SceneGrids: the irradiance grids of a scene file.
///   Fields  "at", "halfExtent", "degrees" of the box; "blend" in metres; "intensity", "name" (IrradianceGrid.h); and
///           either "file", which filament-bake wrote and whose box counts, named as models are, or "count" with
///           "probes", x first, of which each has "ambient" light from all directions (candela / m2) and "directed"
///           light that comes "from" a direction; "inside": true for what is in geometry. The last probe stands for
///           those that follow it.
///   Fails   as JsonReader; errors of files.
#pragma once

#include "toolkit/json/JsonReader.h"

#include <filament_core/IrradianceGrid.h>

#include <string>

namespace filament_core::tools {

struct GridSpec {
    IrradianceGridDesc grid{}; ///< without its probes where `file` has them
    std::string file;
};

void readGrid(JsonReader& reader, GridSpec& grid);

} // namespace filament_core::tools
