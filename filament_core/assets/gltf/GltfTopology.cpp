// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/geometry/TangentFrame.h"
#include "filament_core/assets/geometry/Tangents.h"
#include "filament_core/assets/gltf/GltfGeometry.h"

#include <algorithm>
#include <numeric>

namespace filament_core::assets {
namespace {

using backend::PrimitiveType;
using Indices = std::vector<uint32_t>;

/// Section 3.7.2.1: every other triangle of a strip is reversed, so that all face the same way.
Indices listFromStrip(Indices const& strip) {
    Indices list;
    for (size_t i = 0; i + 2 < strip.size(); ++i) {
        list.insert(list.end(), { strip[i], strip[i + 1 + i % 2], strip[i + 2 - i % 2] });
    }
    return list;
}

Indices listFromFan(Indices const& fan) {
    Indices list;
    // Section 3.7.2.1 gives this order of the corners: the centre is the last one.
    for (size_t i = 1; i + 1 < fan.size(); ++i) list.insert(list.end(), { fan[i], fan[i + 1], fan[0] });
    return list;
}

Indices linesFromStrip(Indices const& strip, bool isClosed) {
    Indices list;
    for (size_t i = 0; i + 1 < strip.size(); ++i) list.insert(list.end(), { strip[i], strip[i + 1] });
    if (isClosed && strip.size() > 1) list.insert(list.end(), { strip.back(), strip.front() });
    return list;
}

Indices listFrom(GltfMode mode, Indices indices) {
    switch (mode) {
    case GltfMode::LineLoop:
        return linesFromStrip(indices, true);
    case GltfMode::LineStrip:
        return linesFromStrip(indices, false);
    case GltfMode::TriangleStrip:
        return listFromStrip(indices);
    case GltfMode::TriangleFan:
        return listFromFan(indices);
    default:
        return indices;
    }
}

/// EXT_mesh_primitive_restart: kNone lies between the runs.
Indices listOfRuns(GltfMode mode, Indices const& indices) {
    Indices list;
    for (auto begin = indices.begin(); begin != indices.end();) {
        const auto end = std::find(begin, indices.end(), kNone);
        const Indices run = listFrom(mode, { begin, end });
        list.insert(list.end(), run.begin(), run.end());
        begin = end == indices.end() ? end : end + 1;
    }
    return list;
}

PrimitiveType topologyOf(GltfMode mode) {
    if (mode == GltfMode::Points) return PrimitiveType::Points;
    return mode <= GltfMode::LineStrip ? PrimitiveType::Lines : PrimitiveType::Triangles;
}

float3 flatNormal(float3 p0, float3 p1, float3 p2) {
    // in double, so that the cross product neither overflows nor vanishes
    const double3 normal = glm::cross(double3(p1) - double3(p0), double3(p2) - double3(p0));
    const double length = std::sqrt(glm::dot(normal, normal));
    return length > 0 ? float3(normal / length) : float3(0, 0, 1);
}

/// For triangles with consecutive corners.
std::vector<float3> flatNormals(std::vector<float3> const& corners) {
    std::vector<float3> normals(corners.size());
    for (size_t i = 0; i + 2 < corners.size(); i += 3) {
        std::fill_n(&normals[i], 3, flatNormal(corners[i], corners[i + 1], corners[i + 2]));
    }
    return normals;
}

/// The normals of a morph target come from its own triangles (section 3.7.2.2).
void addFlatNormals(GltfGeometry const& geometry, MorphTargetData& target) {
    target.tangents.clear();
    target.normals.clear();
    if (target.positions.empty()) return;
    std::vector<float3> moved = geometry.positions;
    for (size_t i = 0; i < moved.size(); ++i) moved[i] += target.positions[i];
    target.normals = flatNormals(moved);
    for (size_t i = 0; i < moved.size(); ++i) target.normals[i] -= geometry.normals[i];
}

} // namespace

void makeList(GltfPrimitive const& primitive, std::string const& path, GltfGeometry& geometry,
              Diagnostics& diagnostics) {
    Indices& indices = geometry.indices;
    if (indices.empty()) return;
    for (const uint32_t index : indices) {
        // The only check of the indices: after it, no step tests them again.
        if (index < geometry.positions.size() || (primitive.restarts && index == kNone)) continue;
        diagnostics.refuse(ErrorCode::Corrupt, "{}.indices: {} is out of range, there are {} vertices", path, index,
                           geometry.positions.size());
        return;
    }
    const GltfMode mode = primitive.draco ? GltfMode::Triangles : primitive.mode;
    indices = primitive.restarts ? listOfRuns(mode, indices) : listFrom(mode, std::move(indices));
    geometry.topology = topologyOf(mode);
    const size_t corners = geometry.topology == PrimitiveType::Triangles ? 3
                           : geometry.topology == PrimitiveType::Lines   ? 2
                                                                         : 1;
    if (indices.size() % corners != 0) {
        diagnostics.warn("{}: {} indices are left over and are not drawn", path, indices.size() % corners);
        while (indices.size() % corners != 0) indices.pop_back();
    }
    if (indices.empty()) diagnostics.warn("{}: has too few vertices for anything to be drawn", path);
}

void dropUnusedVertices(GltfGeometry& geometry) {
    constexpr size_t kWorthIt = 2; // a copy pays off if half of the vertices or more are unused
    if (geometry.indices.size() * kWorthIt > geometry.positions.size()) return;
    Indices remap(geometry.positions.size(), kNone), used;
    for (uint32_t& index : geometry.indices) {
        if (remap[index] == kNone) {
            remap[index] = static_cast<uint32_t>(used.size());
            used.push_back(index);
        }
        index = remap[index];
    }
    reorderVertices(geometry, used);
}

void addFlatNormals(GltfGeometry& geometry) {
    if (geometry.topology != PrimitiveType::Triangles || !geometry.normals.empty()) return;
    // Section 3.7.2.1: without normals, flat ones are used and the tangents of the file are ignored.
    geometry.tangents.clear();
    // A vertex has one normal, so flat ones need a vertex for every corner.
    const Indices corners = std::move(geometry.indices);
    reorderVertices(geometry, corners);
    geometry.indices.resize(corners.size());
    std::iota(geometry.indices.begin(), geometry.indices.end(), 0u);
    geometry.normals = flatNormals(geometry.positions);
    for (MorphTargetData& target : geometry.targets) addFlatNormals(geometry, target);
    geometry.wasIndexed = false;
}

TangentBasis addTangents(GltfGeometry& geometry, TangentBasis const& basis) {
    const bool isPossible = geometry.topology == PrimitiveType::Triangles && !geometry.normals.empty() &&
                            !geometry.uvs[basis.uvSet].empty() && geometry.tangents.empty();
    if (!isPossible) return { .uvSet = basis.uvSet };
    geometry.frames.clear();
    for (float3& normal : geometry.normals) normal = normalizedOr(normal, float3(0, 0, 1));
    std::vector<float2> uvs = geometry.uvs[basis.uvSet];
    if (basis != TangentBasis{ .uvSet = basis.uvSet }) {
        const glm::mat2 turn(basis.turn[0], basis.turn[1], basis.turn[2], basis.turn[3]);
        for (float2& uv : uvs) uv = turn * uv;
    }
    TangentOutput output = generateTangents({ geometry.positions, geometry.normals, uvs, geometry.indices });
    reorderVertices(geometry, output.sources);
    geometry.tangents = std::move(output.tangents);
    geometry.indices = std::move(output.indices);
    return basis;
}

} // namespace filament_core::assets
