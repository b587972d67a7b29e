// SPDX-License-Identifier: Apache-2.0
/// GltfScene: determines what the default scene of a file shows, before any vertex is read.
///   In      a document whose buffers are loaded.
///   Out     the nodes of the file, parents before children, and the meshes that they need: one per mesh and
///           combination of morph weights and skin that the scene uses, with the rest pose of its joints.
///           NodeData::mesh is an index into those. A mesh is placed at its node. If it needs a node of its own, one
///           with the same name follows the file's nodes: a child for each instance of EXT_mesh_gpu_instancing, or a
///           root for a skinned mesh, whose place does not depend on its node (section 3.7.3.3). Joints outside the
///           default scene come with their ancestors and descendants, but without their meshes.
///           Of nodes with levels of detail (MSFT_lod), GltfLevels::Finest leaves the coarser ones without meshes and
///           lights, like hidden nodes; GltfLevels::All lists the levels of each.
///   Thread  one. Cost: linear in the nodes.
///   Limits  2^20 instances of EXT_mesh_gpu_instancing per node.
///   Fails   Corrupt: a transform that is not finite, a skin without joints, instance attributes of different length.
#pragma once

#include "filament_core/assets/files/Diagnostics.h"
#include "filament_core/assets/gltf/GltfDocument.h"

#include <vector>

namespace filament_core::assets {

struct GltfMeshRequest {
    uint32_t mesh = kNone;
    uint32_t skin = kNone;
    std::vector<float> weights;
    std::vector<float4x4> worldFromBind;          ///< per joint, in the rest pose; empty without a skin
    bool keepsSkin = false, keepsTargets = false; ///< false: vertices are moved to the rest pose
};

struct GltfScene {
    std::vector<NodeData> nodes;
    std::vector<GltfMeshRequest> meshes;
    std::vector<SkinData> skins; ///< those that requests keep
    std::vector<LevelsData> levels;
    /// NodeData::profiledLight is an index into these: a profile of the document, and its multiplier as intensity.
    std::vector<LightData> profiledLights;

    std::vector<uint32_t> nodeOf;                 ///< by node of the file: into `nodes`, or kNone
    std::vector<std::vector<uint32_t>> meshNodes; ///< by node of the file: the nodes that carry its mesh
};

/// For GltfLevels::All, before planScene(): coarser levels that are in no scene take part in the one of their finest
/// level, with the same parent.
void adoptLevels(GltfDocument& document);
GltfScene planScene(GltfDocument const& document, GltfDeformation deformation, GltfLevels levels,
                    Diagnostics& diagnostics);

} // namespace filament_core::assets
