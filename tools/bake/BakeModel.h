// SPDX-License-Identifier: Apache-2.0
/// BakeModel: a glTF file whose surfaces get lightmaps: read, and written as a .glb with them.
///   In      a .gltf or .glb.
///   Baked   triangles of nodes that neither move nor change their shape: no skins, no morph targets, no animation of
///           the node or of one above it, no instances (EXT_mesh_gpu_instancing). Unlit materials get no light. What is
///           not baked is drawn as before; one warning for each reason names the first such node.
///   Out     the file with all its buffers and images inside. Each baked node has a mesh of its own, because places in
///           the lightmap are not shared, with attributes as floats; materials name the lightmap (docs/baking.md), or
///           the occlusion. A primitive that lies on several pages becomes one for each of them.
///   Thread  one.  Memory: the file, and about 200 bytes a vertex.
///   Fails   as loadGltf(); InvalidArgument if nothing can be baked.
#pragma once

#include "filament_core/assets/gltf/GltfDocument.h"
#include "filament_core/assets/gltf/GltfGeometry.h"
#include "tools/bake/Atlas.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace filament_core::bake {

/// The extension of materials and textures that lightmaps are written as (assets/gltf/GltfParse.cpp reads it).
inline constexpr const char* kLightmapExtension = "FILAMENT_lightmap";
/// That of materials whose occlusion texture holds bent normals.
inline constexpr const char* kBentNormalExtension = "FILAMENT_bent_normal";

struct BakeModel {
    /// The primitive of a file's node that a surface is.
    struct Source {
        uint32_t node = 0, mesh = 0, primitive = 0; ///< of the file
        uint32_t surface = 0;                       ///< into `surfaces`
        std::string name;                           ///< of the node, for reports
        assets::GltfGeometry geometry;              ///< in the space of the mesh
        double3x3 meshFromWorld{ 1.0 };             ///< of directions; not of unit length
        std::vector<uint32_t> uvSets;               ///< of geometry.uvs: TEXCOORD_n of the file
    };
    std::vector<BakeSurface> surfaces;
    std::vector<Source> sources; ///< as many
    uint32_t uvSet = 1;          ///< the first set of texture coordinates that no surface has
    std::vector<std::string> warnings;

    std::vector<std::byte> file; ///< as read
    std::filesystem::path folder;
    std::shared_ptr<assets::GltfDocument> document;
};

Result<BakeModel> readBakeModel(std::filesystem::path const& path, jobs::JobSystem& jobs);

/// What materials say of the lightmap.
struct LightmapEntry {
    std::vector<std::vector<std::byte>> pages;    ///< KTX 2.0 files
    std::vector<std::vector<std::byte>> openness; ///< as many, or none: images whose red replaces alpha
    double intensity = 1;                         ///< lux that a texel of 1 stands for
    bool hasDirectLight = false;                  ///< of lamps
};

/// Or of baked occlusion, with bent normals (OcclusionImage.h).
struct OcclusionEntry {
    std::vector<std::vector<std::byte>> pages{}; ///< PNG files; of vertices one
    bool hasBentNormals = true;
    /// By surface and vertex, the visible part and the mean open direction in the world: the attributes _OCCLUSION and
    /// _BENT_NORMAL, for other programs (VertexFit.h); none: no such attributes.
    std::vector<std::vector<double4>> vertices{};
};

Result<std::vector<std::byte>> writeBakedModel(BakeModel const& model, Atlas const& atlas, LightmapEntry const& light);
/// In place of the occlusion textures that the model has.
Result<std::vector<std::byte>> writeBakedModel(BakeModel const& model, Atlas const& atlas,
                                               OcclusionEntry const& occlusion);

} // namespace filament_core::bake
