// SPDX-License-Identifier: Apache-2.0
/// GltfMergeShift: the indices of a glTF file, moved to where its parts lie in another file. Used by GltfMerge.cpp.
///   In      elements of the arrays of a file, in JSON. Indices of other types, and extensions that are not listed in
///           GltfExtensions.h, are left as they are.
///   Thread  any.   Fails: never.
#pragma once

#include "filament_core/assets/gltf/GltfWriterJson.h"

#include <cstddef>
#include <vector>

namespace filament_core::assets {

/// Where the arrays of a source begin.
struct GltfOffsets {
    size_t accessors = 0, views = 0, images = 0, samplers = 0, textures = 0, materials = 0, meshes = 0, cameras = 0;
    size_t lights = 0, profiles = 0, environments = 0;
    std::vector<size_t> variants; ///< of each of the source, the new one
};

/// Of a copy.
struct GltfCopyOffsets {
    size_t nodes = 0, skins = 0;
};

void shiftAccessor(Json& accessor, GltfOffsets const& by);
void shiftTexture(Json& texture, GltfOffsets const& by);
void shiftMaterial(Json& material, GltfOffsets const& by);
void shiftMesh(Json& mesh, GltfOffsets const& by);
void shiftEnvironment(Json& light, GltfOffsets const& by);
void shiftNode(Json& node, GltfOffsets const& by, GltfCopyOffsets const& copy);
void shiftSkin(Json& skin, GltfOffsets const& by, GltfCopyOffsets const& copy);
void shiftSampler(Json& sampler, GltfOffsets const& by); ///< of an animation
/// Whether the target of a channel is an element of its file. Loaders leave other channels out; moved, they would name
/// an element of another file.
bool isChannelInside(Json const& channel, Json const& file);
/// Of a channel of an animation. `isFirst`: of the first copy; channels that move what copies share belong to it.
/// False: the copy has no such channel.
bool shiftChannel(Json& channel, GltfOffsets const& by, GltfCopyOffsets const& copy, bool isFirst);

/// The member, if the value is an object that has it; else null.
Json* memberOf(Json& value, const char* key);
Json const* memberOf(Json const& value, const char* key);
/// extensions[name]
Json* extensionOf(Json& value, const char* name);
Json const* extensionOf(Json const& value, const char* name);

} // namespace filament_core::assets
