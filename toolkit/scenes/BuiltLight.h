// SPDX-License-Identifier: Apache-2.0
/// BuiltLight: an image-based light (EXT_lights_image_based) for a built model: a room whose six walls have colours of
/// their own, each with a lamp off its middle, so that no two directions look alike.
///   In      { "size": 64, "levels": 1, "intensity": 1.5, "degrees": [0, 30, 0] }. `levels`: 1 leaves it to the engine
///           to filter for rough surfaces; else all that the size has. `degrees`: turned as objects are.
///   Out     images and coefficients in the scene, pre-filtered by the engine's own baker.
///   Fails   through the reader.  Cost: 0.1 s for 64 texels.
///   Thread  any; pure.
#pragma once

#include "filament_core/assets/gltf/GltfWriter.h"
#include "toolkit/json/JsonReader.h"

namespace filament_core::tools {

void addBuiltLight(JsonReader& reader, assets::GlbScene& scene);

} // namespace filament_core::tools
