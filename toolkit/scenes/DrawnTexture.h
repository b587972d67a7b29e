// SPDX-License-Identifier: Apache-2.0
/// DrawnTexture: a texture of a scene that passes without a view and mesh passes draw, as a file describes it.
///   File    kind (2d, array, cube, cubeArray, 3d), format, size, layers, levels: of the texture, a square
///           colors, shown: more than one: attachments of the same format, and which of them is sampled
///           draws: in their order; {"material": "FILE.mat", "values": {"tint": "1,0,0"}, "level": 1, "layer": 2}, and
///           of mesh passes "meshes": true, "keeps", "keepsHoles", "clear": [0, 0, 0, 1], "layers": 1
///   Fails   errors of the reader, with the file.
#pragma once

#include <filament_core/MeshPass.h>
#include <filament_core/Objects.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace filament_core::tools {

struct DrawnPart {
    std::string material;
    std::vector<std::pair<std::string, std::string>> values;
    uint32_t level = 0, layer = 0;
    bool drawsMeshes = false, keeps = false, keepsHoles = false;
    float4 clear{ 0, 0, 0, 1 };
    uint32_t layers = kAllLayers; ///< View::visibleLayers
};

struct DrawnTexture {
    TextureKind kind = TextureKind::Texture2D;
    Format format = Format::RGBA16F;
    uint32_t size = 64, layers = 1, levels = 1;
    uint32_t colors = 1, shown = 0;
    std::vector<DrawnPart> draws;
};

Result<DrawnTexture> readDrawnTexture(std::filesystem::path const& file);

} // namespace filament_core::tools
