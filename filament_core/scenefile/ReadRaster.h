// SPDX-License-Identifier: Apache-2.0
/// readRaster: the raster state of a copy in a scene file, as Engine sets it for a material instance:
///   "colorWrite", "depthWrite", "depthCulling"   true or false;
///   "stencil"   { "test": "equal", "onFail", "onDepthFail", "onPass": "replace", "reference", "readMask", "writeMask"
///               }, the same for both sides (Stencil.h has the words).
///   Fails   as JsonReader.
#pragma once

#include "filament_core/scenefile/JsonReader.h"

#include <filament_core/SceneFile.h>

namespace filament_core::scenefile {

void readRaster(JsonReader& reader, SceneFileRaster& raster);

} // namespace filament_core::scenefile
