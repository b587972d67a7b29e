// SPDX-License-Identifier: Apache-2.0
/// WriteValues: lights, cameras and views as a scene file has them.
///   Out     only what differs from the defaults, except for places, directions and intensities; floats by the fewest
///           digits that give them again.
///   Thread  any; pure.
#pragma once

#include "filament_core/scenefile/JsonReader.h"

#include <filament_core/SceneFile.h>

namespace filament_core::scenefile {

/// The list of the light's kind: "points".
const char* listOf(LightDesc const& light);
Json toJson(LightDesc const& light);
/// Into "camera" and "exposure". `origin`: of the scene.
void writeCamera(Json& tree, Camera const& camera, double3 const& origin);
/// Into "view", "quality" and "effects". `defaults`: of a file that says nothing.
void writeView(Json& tree, View const& view, View const& defaults);

} // namespace filament_core::scenefile
