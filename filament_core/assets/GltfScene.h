// SPDX-License-Identifier: Apache-2.0
/// GltfScene: what the default scene of a file shows, before any vertex is touched.
///   In      a document whose buffers are loaded.
///   Out     nodes with world transforms, parents before children, and the meshes that they ask for: a mesh appears
///           once per combination of morph weights and skin that the scene uses, with the rest pose of its joints.
///           NodeData::mesh counts in those. A skinned mesh stands in world space: its node has no transform (section
///           3.7.3.3).
///   Thread  one. Cost: linear in the nodes.
///   Limits  2^20 instances of EXT_mesh_gpu_instancing a node.
///   Fails   Corrupt: a transform that is not finite, a skin without joints, instance attributes of different length.
#pragma once

#include "filament_core/assets/GltfDiagnostics.h"
#include "filament_core/assets/GltfDocument.h"

#include <vector>

namespace filament::assets {

struct GltfMeshRequest {
    uint32_t mesh = kNone;
    uint32_t skin = kNone;
    std::vector<float> weights;
    std::vector<float4x4> worldFromBind; ///< per joint; empty without a skin
};

struct GltfScene {
    std::vector<NodeData> nodes;
    std::vector<GltfMeshRequest> meshes;
};

GltfScene planScene(GltfDocument const& document, GltfDiagnostics& diagnostics);

} // namespace filament::assets
