// SPDX-License-Identifier: Apache-2.0
/// GltfMergeSource: the parts of a glTF file, appended to those of another. Used by GltfMerge.cpp.
///   In      a whole file, and where it finds what it names.
///   Out     its elements at the ends of the arrays of the root, with moved indices, and its bytes at the end of the
///           buffer, on multiples of 8. Nodes, skins and animations stay in `json`, for its copies.
///   Thread  any.   Fails: as reading the file, with its name.
#pragma once

#include "filament_core/assets/gltf/GltfMerge.h"
#include "filament_core/assets/gltf/GltfMergeShift.h"

#include <nlohmann/json.hpp>

namespace filament_core::assets {

struct GltfMergeState {
    Json root;
    std::vector<std::byte> buffer;
    std::vector<std::string> warnings;
};

struct GltfMergedSource {
    Json json;
    GltfOffsets offsets;
};

/// Adds a buffer view with a copy of the bytes. `target`: 0: none.
size_t addGltfView(GltfMergeState& state, std::span<const std::byte> bytes, int target);
Result<GltfMergedSource> addGltfSource(GltfMergeSource const& source, GltfMergeState& state);
/// The default scene of the file, or null.
Json* defaultSceneOf(Json& json);
/// A list of the root, made where there is none.
Json& gltfList(Json& object, const char* key);
void useGltfExtension(const char* name, Json& root);

} // namespace filament_core::assets
