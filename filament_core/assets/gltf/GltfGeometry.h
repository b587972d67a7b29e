// SPDX-License-Identifier: Apache-2.0
/// GltfGeometry: one primitive on its way from the file to the GPU, with one array of floats per attribute.
///   The steps, in order: gather, make a list, repair directions, morph, drop unused vertices, skin, drop what is not
///   finite, flat normals, tangents, pack. Each is a function below and takes the primitive as the previous step left
///   it. Morphing and skinning are applied here for
///   the rest pose, or left to the device. Quantised attributes keep the format of the file: 8- and 16-bit integers
///   survive the conversion to floats exactly, and pack() writes them back.
///   Thread  one primitive on one thread; the document is only read.
///   Fails   through the diagnostics; later steps must not run after a failure.
#pragma once

#include "filament_core/assets/files/Diagnostics.h"
#include "filament_core/assets/gltf/GltfDocument.h"

#include <glm/gtc/type_precision.hpp>

#include <cmath>
#include <span>
#include <string>
#include <vector>

namespace filament_core::assets {

struct GltfGeometry {
    using JointIndices = glm::uvec4;

    std::vector<float3> positions;
    std::vector<float3> normals;  ///< empty, or one per vertex, as all below
    std::vector<float4> tangents; ///< w: handedness
    std::vector<float4> frames;   ///< TangentFrame.h; empty: normals and tangents give them
    std::vector<float4> colors;
    std::array<std::vector<float2>, GltfAttributes::kUvSets> uvs;
    std::array<std::vector<JointIndices>, GltfAttributes::kJointSets> joints;
    std::array<std::vector<float4>, GltfAttributes::kJointSets> weights;
    std::vector<MorphTargetData> targets; ///< left to the device: one displacement per vertex, or none
    std::vector<uint32_t> indices;
    backend::PrimitiveType topology = backend::PrimitiveType::Triangles;
    bool wasIndexed = false; ///< false: equal vertices are worth merging

    backend::VertexFormat positionFormat = backend::VertexFormat::Float3;
    backend::VertexFormat colorFormat = backend::VertexFormat::Float4;
    backend::VertexFormat frameFormat = backend::VertexFormat::Float4;
    std::array<backend::VertexFormat, GltfAttributes::kFirstUvSets> uvFormats{ backend::VertexFormat::Float2,
                                                                               backend::VertexFormat::Float2 };

    backend::VertexFormat weightFormat = backend::VertexFormat::Float4;
    bool isSkinned = false; ///< left to the device: joints and weights are packed too

    uint32_t vertexCount() const { return static_cast<uint32_t>(positions.size()); }
};

/// Reads attributes and indices from accessors or a Draco stream. `path`: "meshes[0].primitives[1]". A primitive
/// without positions or vertices is returned empty, with a warning, since there is nothing to draw.
GltfGeometry gatherGeometry(GltfDocument const& document, GltfPrimitive const& primitive, std::string const& path,
                            Diagnostics& diagnostics);

/// Of lists: a normal that is not finite becomes that of the triangles around its vertex. If a tangent is not finite,
/// all are dropped, so that they are computed like missing ones. With one warning each.
void repairDirections(std::string const& path, GltfGeometry& geometry, Diagnostics& diagnostics);

/// Frames of the file are unit quaternions beside normals; others are left out, with a warning.
void checkFrames(std::string const& path, GltfGeometry& geometry, Diagnostics& diagnostics);

/// Drops the triangles, lines or points with a corner whose position is not finite, with one warning: at any other
/// place it would be a spike. Their vertices move to a corner that is left, so that no bounds grow.
void dropNonFinite(std::string const& path, GltfGeometry& geometry, Diagnostics& diagnostics);

/// Adds the morph targets with non-zero weight to positions, normals and tangents (section 3.7.2.2).
void applyMorphTargets(GltfDocument const& document, GltfPrimitive const& primitive, std::span<const float> weights,
                       GltfGeometry& geometry, Diagnostics& diagnostics);

/// Moves the vertices to their positions under the joints (section 3.7.3.3). A mirroring skin reverses the triangles.
void applySkin(std::span<const float4x4> worldFromBind, std::string const& path, GltfGeometry& geometry,
               Diagnostics& diagnostics);

/// Whether the device can apply the morph targets; warns if not.
bool canKeepTargets(GltfPrimitive const& primitive, GltfGeometry const& geometry, std::string const& path,
                    Diagnostics& diagnostics);

/// Reads the morph targets for the device. Displacements of attributes that the geometry lacks are dropped.
void keepMorphTargets(GltfDocument const& document, GltfPrimitive const& primitive, GltfGeometry& geometry,
                      Diagnostics& diagnostics);

/// Prepares joints and weights for the device: every joint exists, and the weights of a vertex sum to 1.
void keepSkin(size_t jointCount, std::string const& path, GltfGeometry& geometry, Diagnostics& diagnostics);

/// By joint: bounds of the vertices that it moves.
std::vector<BoundsData> boundsOfBones(GltfGeometry const& geometry);

/// Positions in the rest pose, including morphing and skinning left to the device.
std::vector<float3> positionsAtRest(GltfGeometry const& geometry, std::span<const float> weights,
                                    std::span<const float4x4> worldFromBind);

/// Checks the indices and turns strips, fans and loops into lists (section 3.7.2.1). Where a
/// primitive restarts, the index kNone begins another one.
void makeList(GltfPrimitive const& primitive, std::string const& path, GltfGeometry& geometry,
              Diagnostics& diagnostics);

/// Exporters often share one vertex array between many primitives: drops unused vertices if there are many.
void dropUnusedVertices(GltfGeometry& geometry);

/// Gives triangles without normals flat ones: every corner becomes a vertex, and tangents of the file are dropped.
void addFlatNormals(GltfGeometry& geometry);

/// Gives triangles without tangents MikkTSpace tangents of a basis, splitting vertices where needed. Returns the basis
/// that the tangents have: those of the file follow texture coordinates without a transform.
TangentBasis addTangents(GltfGeometry& geometry, TangentBasis const& basis);

/// Interleaves everything into the form that goes to the GPU.
PrimitiveData packGeometry(GltfGeometry geometry, GeometryStorage const& storage = {});

inline bool allFinite(float3 v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Vertex i of the result is vertex sources[i]; indices do not change.
void reorderVertices(GltfGeometry& geometry, std::span<const uint32_t> sources);

} // namespace filament_core::assets
