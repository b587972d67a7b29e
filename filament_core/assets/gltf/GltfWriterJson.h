// SPDX-License-Identifier: Apache-2.0
/// GltfWriterJson: the parts of a glTF file that need no buffer, as JSON. Used by GltfWriter.cpp only.
///   In      a checked scene.  Out  members added to the file's root object, in the order of writing.
///   Thread  any.
#pragma once

#include "filament_core/assets/gltf/GltfWriter.h"

#include <nlohmann/json_fwd.hpp>

namespace filament_core::assets {

using Json = nlohmann::ordered_json;

/// "scene", "scenes", "nodes"
void addNodes(GlbScene const& scene, Json& root);
/// "materials", "textures", "samplers", and the extensions they use
void addMaterials(GlbScene const& scene, Json& root);
/// "extensions.KHR_lights_punctual", "extensions.EXT_lights_image_based"
void addLights(GlbScene const& scene, Json& root);

} // namespace filament_core::assets
