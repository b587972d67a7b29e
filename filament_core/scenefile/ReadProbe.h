// SPDX-License-Identifier: Apache-2.0
/// readProbe: a reflection probe of a scene file.
///   Fields  "at", "halfExtent", "degrees" of the box; "blend" in metres; "capture": where in the box the cube was
///           captured; "intensity", "diffuse", "name" (ReflectionProbe.h); "file": named as an environment's, along the
///           axes of the box. Without a file the engine captures the scene, without its probes.
///   Fails   as JsonReader.
#pragma once

#include "filament_core/scenefile/JsonReader.h"

#include <filament_core/SceneFile.h>

namespace filament_core::scenefile {

void readProbe(JsonReader& reader, SceneFileProbe& probe);

} // namespace filament_core::scenefile
