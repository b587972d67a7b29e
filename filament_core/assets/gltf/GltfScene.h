// SPDX-License-Identifier: Apache-2.0
/// GltfScene: what the default scene of a file shows, before any vertex is touched.
///   In      a document whose buffers are loaded.
///   Out     the nodes of the file, parents before children, and the meshes that they ask for: a mesh appears once per
///           combination of morph weights and skin that the scene uses, with the rest pose of its joints.
///           NodeData::mesh counts in those. Every mesh stands where its node stands; where that needs a node of its
///           own, one of the same name follows the file's: a child for each instance of EXT_mesh_gpu_instancing, a root
///           for a skinned mesh, whose place does not depend on its node (section 3.7.3.3).
///   Thread  one. Cost: linear in the nodes.
///           Joints outside of the default scene come with the nodes above and below them, without their meshes.
///   Limits  2^20 instances of EXT_mesh_gpu_instancing a node; skins of more than 256 joints are not kept.
///   Fails   Corrupt: a transform that is not finite, a skin without joints, instance attributes of different length.
#pragma once

#include "filament_core/assets/files/Diagnostics.h"
#include "filament_core/assets/gltf/GltfDocument.h"

#include <vector>

namespace filament::assets {

struct GltfMeshRequest {
    uint32_t mesh = kNone;
    uint32_t skin = kNone;
    std::vector<float> weights;
    std::vector<float4x4> worldFromBind;          ///< per joint, at rest; empty without a skin
    bool keepsSkin = false, keepsTargets = false; ///< else: the vertices are moved to where they are at rest
};

struct GltfScene {
    std::vector<NodeData> nodes;
    std::vector<GltfMeshRequest> meshes;
    std::vector<SkinData> skins; ///< those that requests keep

    std::vector<uint32_t> nodeOf;                 ///< by node of the file: into `nodes`, or kNone
    std::vector<std::vector<uint32_t>> meshNodes; ///< by node of the file: where its mesh stands
};

GltfScene planScene(GltfDocument const& document, GltfDeformation deformation, Diagnostics& diagnostics);

} // namespace filament::assets
