// SPDX-License-Identifier: Apache-2.0
/// GltfGeometry: one primitive on its way from the file to the GPU, one array per attribute, everything as floats.
///   The steps, in order: gather, make a list, morph, drop unused vertices, skin, flat normals, tangents, pack.
///   Morphing and skinning are done here, for the rest pose, or kept for the device. Each is a function below; each
///   takes the primitive as the step before left it. Quantised attributes keep the format of the file: 8- and 16-bit
///   integers survive the trip through floats exactly, and pack() writes them back.
///   Thread  one primitive on one thread; the document is only read.
///   Fails   through the diagnostics; later steps must not run then.
#pragma once

#include "filament_core/assets/files/Diagnostics.h"
#include "filament_core/assets/gltf/GltfDocument.h"

#include <glm/gtc/type_precision.hpp>

#include <span>
#include <string>
#include <vector>

namespace filament::assets {

struct GltfGeometry {
    using JointIndices = glm::uvec4;

    std::vector<float3> positions;
    std::vector<float3> normals;  ///< empty, or one per vertex, as all below
    std::vector<float4> tangents; ///< w: handedness
    std::vector<float4> colors;
    std::array<std::vector<float2>, GltfAttributes::kUvSets> uvs;
    std::array<std::vector<JointIndices>, GltfAttributes::kJointSets> joints;
    std::array<std::vector<float4>, GltfAttributes::kJointSets> weights;
    std::vector<MorphTargetData> targets; ///< left to the device: one difference a vertex, or none
    std::vector<uint32_t> indices;
    backend::Topology topology = backend::Topology::Triangles;
    bool wasIndexed = false; ///< false: equal vertices are worth looking for

    backend::VertexFormat positionFormat = backend::VertexFormat::Float3;
    backend::VertexFormat colorFormat = backend::VertexFormat::Float4;
    std::array<backend::VertexFormat, GltfAttributes::kUvSets> uvFormats{ backend::VertexFormat::Float2,
                                                                          backend::VertexFormat::Float2 };

    backend::VertexFormat weightFormat = backend::VertexFormat::Float4;
    bool isSkinned = false; ///< left to the device: joints and weights are packed, too

    uint32_t vertexCount() const { return static_cast<uint32_t>(positions.size()); }
};

/// Attributes and indices out of accessors or a Draco stream. `path`: "meshes[0].primitives[1]". A primitive without
/// positions or without vertices comes back empty, with a warning: there is nothing to draw.
GltfGeometry gatherGeometry(GltfDocument const& document, GltfPrimitive const& primitive, std::string const& path,
                            Diagnostics& diagnostics);

/// Adds the morph targets with non-zero weight to positions, normals and tangents (section 3.7.2.2).
void applyMorphTargets(GltfDocument const& document, GltfPrimitive const& primitive, std::span<const float> weights,
                       GltfGeometry& geometry, Diagnostics& diagnostics);

/// Moves the vertices to where the joints hold them (section 3.7.3.3). A skin that mirrors turns the triangles around.
void applySkin(std::span<const float4x4> worldFromBind, std::string const& path, GltfGeometry& geometry,
               Diagnostics& diagnostics);

/// Whether the device can take the morph targets; a warning if not.
bool canKeepTargets(GltfPrimitive const& primitive, GltfGeometry const& geometry, std::string const& path,
                    Diagnostics& diagnostics);

/// Reads the morph targets, for the device to apply. Differences of what the geometry lacks are left out.
void keepMorphTargets(GltfDocument const& document, GltfPrimitive const& primitive, GltfGeometry& geometry,
                      Diagnostics& diagnostics);

/// Makes joints and weights ready for the device: every joint exists, the weights of a vertex sum to 1.
void keepSkin(size_t jointCount, std::string const& path, GltfGeometry& geometry, Diagnostics& diagnostics);

/// By joint: where the vertices are that it moves.
std::vector<BoundsData> boundsOfBones(GltfGeometry const& geometry);

/// Where the vertices are in the rest pose, with what the geometry leaves to the device.
BoundsData boundsAtRest(GltfGeometry const& geometry, std::span<const float> weights,
                        std::span<const float4x4> worldFromBind);

/// Checks the indices and turns strips, fans and loops into lists (section 3.7.2.1).
void makeList(GltfMode mode, std::string const& path, GltfGeometry& geometry, Diagnostics& diagnostics);

/// Exporters let many primitives share one vertex array: vertices that no index names are dropped when they are many.
void dropUnusedVertices(GltfGeometry& geometry);

/// Gives triangles without normals flat ones: every corner becomes a vertex, tangents of the file are dropped.
void addFlatNormals(GltfGeometry& geometry);

/// Gives triangles without tangents MikkTSpace tangents from `uvSet`, splitting vertices where needed.
void addTangents(GltfGeometry& geometry, uint32_t uvSet);

/// Interleaves everything into the form that goes to the GPU.
PrimitiveData packGeometry(GltfGeometry geometry, GeometryStorage const& storage = {});

/// Vertex i of the result is vertex sources[i]; indices stay as they are.
void reorderVertices(GltfGeometry& geometry, std::span<const uint32_t> sources);

} // namespace filament::assets
