// SPDX-License-Identifier: Apache-2.0
/// readModels: the models of a scene file: "model" with "geometry", "variant", "animation" and "copies", and the same
/// for each element of "models".
///   Fails   as JsonReader.
#pragma once

#include "filament_core/scenefile/JsonReader.h"

#include <filament_core/SceneFile.h>

namespace filament_core::scenefile {

void readModels(JsonReader& reader, std::vector<SceneFileModel>& models);

} // namespace filament_core::scenefile
