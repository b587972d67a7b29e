// SPDX-License-Identifier: Apache-2.0
/// Mesh: triangles in memory with all that the built-in materials read of a vertex, and tangent frames for any mesh.
///   Use      make one (<filament_core/Primitives.h>) or fill one, and give it to an engine:
///                const VertexBuffer vertices = engine.create(mesh.vertexBuffer());
///                const IndexBuffer indices = engine.create(mesh.indexBuffer());
///   Winding  counter-clockwise seen from the front, which is the side that the normals point to.
///   Uv       u to the right and v upwards: (0, 0) is the lower left corner of an image, as materials with `flipUV :
///            true` take it, the default of .mat files. glTF counts v downwards and needs `flipUV : false`.
///   Thread   any; plain values and pure functions.   Memory: 64 B a vertex, 4 B an index.
///   Fails    InvalidArgument names the function, the vertex or triangle, and the rule. std::bad_alloc.
#pragma once

#include <filament_core/Box.h>
#include <filament_core/Lines.h>
#include <filament_core/Math.h>
#include <filament_core/Objects.h>
#include <filament_core/Occluder.h>
#include <filament_core/Result.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace filament_core {

struct MeshVertex {
    float3 position{ 0 };          ///< object space
    float3 normal{ 0, 0, 1 };      ///< unit length; for the program: the device reads it from `tangents`
    float4 tangents{ 0, 0, 0, 1 }; ///< Attribute::Tangents; tangentsOf(), computeTangents()
    float2 uv{ 0 };                ///< Attribute::Uv0
    float4 color{ 1 };             ///< Attribute::Color, linear
};

struct Mesh {
    std::vector<MeshVertex> vertices;
    std::vector<uint32_t> indices; ///< three a triangle

    /// Refer to the vectors above; for Engine::create() while these live and do not change.
    VertexBufferDesc vertexBuffer() const;
    IndexBufferDesc indexBuffer() const;

    Box bounds() const;        ///< of the positions, for RenderableDesc; empty without vertices
    Occluder occluder() const; ///< for RenderableDesc; null if the mesh is too finely divided
};

/// Normals of a smooth surface: those of the triangles around a vertex, weighted by their angle there (Thürmer and
/// Wüthrich 1998, "Computing Vertex Normals from Polygonal Facets"). Vertices in the same place with different normals
/// stay apart: only triangles that share the vertex itself count. A vertex without a triangle that has an area keeps
/// its normal. InvalidArgument: an index beyond the vertices, indices that are not triangles, a position that is not
/// finite.
Result<void> computeNormals(Mesh& mesh);

/// `tangents` from positions, normals and uv, as MikkTSpace defines them (Mikkelsen 2008): normal maps baked by other
/// programs look right. The tangent points along u, the bitangent along v. Vertices where mirrored textures meet are
/// split; new ones follow the old ones. Where uv has no gradient the tangent is any. Normals of other lengths than 1
/// are normalised, those without a direction become +z.
/// InvalidArgument: as computeNormals(), and an uv that is not finite.
Result<void> computeTangents(Mesh& mesh);

// ---- Attribute::Tangents: the frame as a unit quaternion that rotates x to the tangent and z to the normal. q and -q
// are the same rotation, so the sign of w is free to say whether the bitangent is cross(normal, tangent) or its
// opposite (Frey and Herzeg 2011, "Spherical Skinning with Dual Quaternions and QTangents"). |w| is at least 1 / 32767,
// so that the sign survives in VertexFormat::Short4N, too.

struct TangentFrame {
    float3 tangent{ 1, 0, 0 }, bitangent{ 0, 1, 0 }, normal{ 0, 0, 1 }; ///< unit vectors at right angles
};

/// Vectors of any length and angle. What is zero, parallel or not finite is replaced: the result is always a frame.
/// `handedness` < 0: the bitangent is -cross(normal, tangent).
float4 tangentsOf(float3 normal, float3 tangent, float handedness = 1);
/// With any tangent (Duff et al. 2017, "Building an Orthonormal Basis, Revisited"): for materials without normal maps
/// and anisotropy.
float4 tangentsFromNormal(float3 normal);
std::vector<float4> tangentsFromNormals(std::span<const float3> normals);
/// As the shaders decode it. Any numbers; a frame only for results of the functions above.
TangentFrame frameOf(float4 tangents);
/// For VertexFormat::Short4N: 8 bytes instead of 16, within 0.006 degrees.
std::array<int16_t, 4> packTangents(float4 tangents);

/// The edges of a mesh as lines, each once, with the colours of its vertices: for the built-in material "wireframe".
/// InvalidArgument: as computeNormals().
Result<LineQuads> makeWireframe(Mesh const& mesh);

} // namespace filament_core
