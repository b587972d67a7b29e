// SPDX-License-Identifier: Apache-2.0
/// GltfPointer: the JSON pointers of KHR_animation_pointer (RFC 6901, glTF 2.0 Asset Object Model).
///   In      the root of a file, and a pointer of one of its channels.
///   Out     what the channel moves: a pose or weights, as a channel without the extension does, or a property.
///   Fails   nullopt, and no more than that: the pointer names nothing that the file has and that can change.
///   Thread  one. Cost: the arrays of the file are listed once, at the first pointer.
#pragma once

#include "filament_core/assets/files/JsonTree.h"
#include "filament_core/assets/gltf/GltfDocument.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::assets {

class GltfPointers {
public:
    explicit GltfPointers(JsonNode const& root) : mRoot(root) {}

    /// A channel without its sampler.
    std::optional<GltfAnimationChannel> resolve(std::string_view pointer);

private:
    using Elements = std::vector<JsonNode>;
    using Tokens = std::vector<std::string>;
    Elements const& elementsOf(PropertyOwner owner);
    Elements const& meshes();
    std::optional<GltfAnimationChannel> poseOf(Tokens const& tokens);
    std::optional<GltfAnimationChannel> weightsOf(Tokens const& tokens);
    std::optional<GltfAnimationChannel> propertyOf(PropertyRow const& row, Tokens const& tokens);

    JsonNode mRoot;
    std::optional<Elements> mNodes, mMeshes, mMaterials, mLights, mCameras;
};

/// Keeps what the properties of the document's channels are part of, though it may have no effect in the file.
void keepAnimated(GltfDocument& document);

/// The map of a material as the file has it; null: none.
GltfTextureInfo* textureInfoOf(GltfMaterial& material, MapName map);

} // namespace filament_core::assets
