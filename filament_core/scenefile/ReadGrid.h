// SPDX-License-Identifier: Apache-2.0
/// readGrid: an irradiance grid of a scene file.
///   Fields  "at", "halfExtent", "degrees" of the box; "blend" in metres; "intensity", "name" (IrradianceGrid.h); and
///           either "file", which filament-bake wrote and whose box counts, named as models are, or "count" with
///           "probes", x first, of which each has "ambient" light from all directions (candela / m2) and "directed"
///           light that comes "from" a direction; "inside": true for what is in geometry. The last probe stands for
///           those that follow it.
///   Fails   as JsonReader; errors of files.
#pragma once

#include "filament_core/scenefile/JsonReader.h"

#include <filament_core/SceneFile.h>

namespace filament_core::scenefile {

void readGrid(JsonReader& reader, SceneFileGrid& grid);

} // namespace filament_core::scenefile
