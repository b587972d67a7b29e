// SPDX-License-Identifier: Apache-2.0
/// SceneRaster: the raster state of a copy in a scene file, as Engine sets it for a material instance:
///   "colorWrite", "depthWrite", "depthCulling"   true or false;
///   "stencil"   { "test": "equal", "onFail", "onDepthFail", "onPass": "replace", "reference", "readMask", "writeMask"
///               }, the same for both sides (Stencil.h has the words).
///   Fails   as JsonReader.
#pragma once

#include "toolkit/json/JsonReader.h"

#include <filament_core/Engine.h>

#include <optional>

namespace filament_core::tools {

/// None: as the material says.
struct CopyRaster {
    std::optional<bool> colorWrite, depthWrite, depthCulling;
    std::optional<StencilState> stencil;
    bool isUsed() const { return colorWrite || depthWrite || depthCulling || stencil; }
};

void readRaster(JsonReader& reader, CopyRaster& raster);
void applyRaster(Engine& engine, MaterialInstance instance, CopyRaster const& raster);

} // namespace filament_core::tools
