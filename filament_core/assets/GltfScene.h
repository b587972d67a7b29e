// SPDX-License-Identifier: Apache-2.0
/// GltfScene: what the default scene of a file shows, before any vertex is touched.
///   In      a document whose buffers are loaded.
///   Out     the nodes of the file, parents before children, and the meshes that they ask for: a mesh appears once per
///           combination of morph weights and skin that the scene uses, with the rest pose of its joints.
///           NodeData::mesh counts in those. Every mesh stands where its node stands; where that needs a node of its
///           own, one of the same name follows the file's: a child for each instance of EXT_mesh_gpu_instancing, a root
///           for a skinned mesh, whose place does not depend on its node (section 3.7.3.3).
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
