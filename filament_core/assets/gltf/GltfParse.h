// SPDX-License-Identifier: Apache-2.0
/// GltfParse: JSON text -> GltfDocument.
///   In       the text of a .gltf file, or the JSON chunk of a .glb.
///   Out      every element, with all indices between elements checked and the node links verified to form a forest.
///   Warns    once about each unknown extension that the file names, about clamped factors, and about elements that are
///            broken and not used.
///   Fails    by use (GltfUse.h): Corrupt, naming the element ("meshes[2].primitives[0].mode: ..."); Unsupported for
///            another major version. After a failure the document is incomplete and must not be used.
///   Limits   2^28 elements per accessor, 4096 B strides; recursion-free, so depth is limited by memory only.
#pragma once

#include "filament_core/assets/files/Diagnostics.h"
#include "filament_core/assets/gltf/GltfDocument.h"

#include <span>

namespace filament_core::assets {

class JsonNode;

GltfDocument parseGltf(std::span<const std::byte> json, Diagnostics& diagnostics);

// ---- steps, in their own files
GltfMaterial parseGltfMaterial(JsonNode const& node, size_t textureCount);
/// KHR_materials_variants of a primitive. A second mapping of the same variant is dropped, with a warning.
std::vector<VariantMaterial> parseVariantMaterials(JsonNode const& primitive, size_t materialCount,
                                                   size_t variantCount);
/// EXT_mesh_primitive_restart: each group of primitives becomes one, at the place of its first; all stay if a group
/// breaks a rule, with a warning.
void mergeRestartGroups(JsonNode const& extension, std::vector<GltfAccessor> const& accessors, GltfMesh& mesh);
/// KHR_gaussian_splatting of a primitive of such a mode. Nothing where its splats can only be drawn as points, with a
/// warning.
std::optional<GltfSplats> parseGltfSplats(JsonNode const& primitive, GltfMode mode, size_t accessorCount);
Sampler parseGltfSampler(JsonNode const& node);
/// Nothing for a light of a type that is unknown, with a warning.
std::optional<LightData> parseGltfLight(JsonNode const& node);
/// Cameras outside of the specification are repaired, with a warning.
CameraData parseGltfCamera(JsonNode const& node);
GltfProfile parseGltfProfile(JsonNode const& node, size_t viewCount);
std::optional<GltfProfiledLight> parseGltfProfiledLight(JsonNode const& node, size_t profileCount); ///< of a node
/// MSFT_lod of a node: its levels of lower detail. Those that the file does not have are dropped, with a warning.
std::vector<uint32_t> parseGltfLevels(JsonNode const& node, size_t nodeCount);
std::vector<double> parseGltfCoverage(JsonNode const& node);
/// Sets isCoarserLevel of every node that another one lists as a level. An entry that would leave nothing to draw, or
/// that contradicts the list of a node before it, is dropped, with a warning; one below its node, which is only shown
/// with it, is dropped without. The children must form a forest. Cost: linear in the nodes and levels; nothing without
/// levels.
void markCoarserLevels(std::vector<GltfNode>& nodes, Diagnostics& diagnostics);
GltfImageBasedLight parseGltfImageBasedLight(JsonNode const& node, size_t imageCount);
/// The light that a scene names, or kNone.
uint32_t parseGltfSceneLight(JsonNode const& scene, size_t lightCount);
void checkExtensions(JsonNode const& root, Diagnostics& diagnostics);

} // namespace filament_core::assets
