// SPDX-License-Identifier: Apache-2.0
/// GltfWriterJson: the parts of a glTF file that need no buffer, as JSON. Used by GltfWriter.cpp and GltfMerge.cpp.
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
/// An element of "materials"; adds the textures, samplers and extensions that it uses.
Json materialJson(MaterialData const& material, Json& root);
/// An info of a texture, as members of materials have it; adds the texture and its sampler.
Json textureInfoJson(TextureRef const& reference, Json& root);
/// An element of "extensions.KHR_lights_punctual.lights"; with "extensions", if FILAMENT_light has to say something.
Json punctualLightJson(LightData const& light);
/// "extensions.KHR_lights_punctual", "extensions.EXT_lights_image_based"
void addLights(GlbScene const& scene, Json& root);

} // namespace filament_core::assets
