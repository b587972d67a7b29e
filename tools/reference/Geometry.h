// SPDX-License-Identifier: Apache-2.0
/// Part: one primitive of a model, placed in the world: triangles for Embree, and the results of the vertex stage
/// (shaders/material/surface/vertex_main.glsl) in double precision.
///   In      a primitive of triangles and the transform of its node; attributes in any format that the loader writes.
///   Out     positions relative to `origin`, as floats: the same positions are intersected and interpolated.
///   Memory  96 bytes per vertex, 12 per triangle. Thread: one part on one thread; read-only afterwards.
#pragma once

#include "base/math/Math.h"
#include "filament_core/assets/gltf/ModelData.h"

#include <functional>
#include <vector>

namespace filament_core::reference {

struct SurfaceSample;

struct Part {
    assets::MaterialData const* material = nullptr;
    std::vector<assets::Image> const* images = nullptr;
    std::function<void(SurfaceSample&)> finish{}; ///< ReferenceModel::finish
    std::vector<float3> positions;                ///< world - origin
    std::vector<double3> normals;                 ///< world, unit or zero
    std::vector<double4> tangents;                ///< world; w: sign of the bitangent
    std::vector<float4> colors;                   ///< empty: white
    std::vector<float2> uvs[4];                   ///< empty: (0, 0)
    std::vector<uint32_t> indices;                ///< three per triangle
    double sceneFromMesh = 1;                     ///< metres of the file's scene per metre of the mesh
    double worldFromScene = 1;                    ///< metres of the world per metre of the scene
    assets::TangentBasis tangentBasis{};
    bool isMirrored = false; ///< the transform reverses the winding
};

/// The attribute at `location` of every vertex; missing components are 0, 0, 0, 1. Empty if there is none.
std::vector<float4> decodeAttribute(assets::PrimitiveData const& primitive, uint8_t location);
std::vector<uint32_t> decodeIndices(assets::PrimitiveData const& primitive);

Part makePart(assets::PrimitiveData const& primitive, double4x4 const& worldFromObject, double3 origin);

/// The point where a ray hit a triangle: barycentric weights of its second and third corner.
struct TrianglePoint {
    uint32_t triangle = 0;
    double u = 0, v = 0;
};

/// Interpolated attributes at a point, and the triangle's plane. Not normalised, like varyings.
struct Varyings {
    double3 position{ 0.0 };
    double3 faceNormal{ 0, 0, 1 }; ///< unit, on the front side
    double longestEdge = 0;
    double3 normal{ 0, 0, 1 };
    double4 tangent{ 0, 0, 0, 1 };
    double4 color{ 1.0 };
    double2 uvs[4]{ double2(0.0), double2(0.0), double2(0.0), double2(0.0) };
    double3 edges[2]{ double3(0.0), double3(0.0) }; ///< from the first corner to the second and to the third
    double2 uvEdges[4][2]{};                        ///< of each set, along those edges
};

Varyings varyingsAt(Part const& part, TrianglePoint const& point);
/// Only the attributes that the base colour needs: alpha tests run for many triangles that a ray then discards.
Varyings colorVaryingsAt(Part const& part, TrianglePoint const& point);
/// Pointing to the front side, any length.
double3 faceNormal(Part const& part, uint32_t triangle);

} // namespace filament_core::reference
