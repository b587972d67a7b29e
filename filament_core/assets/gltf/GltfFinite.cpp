// SPDX-License-Identifier: Apache-2.0
// Numbers of vertices that are not finite.
#include "filament_core/assets/geometry/TangentFrame.h"
#include "filament_core/assets/gltf/GltfGeometry.h"

#include <algorithm>

namespace filament_core::assets {
namespace {

using backend::PrimitiveType;

struct Form {
    size_t corners;
    const char* plural;
};

Form formOf(PrimitiveType topology) {
    if (topology == PrimitiveType::Triangles) return { 3, "triangles" };
    return topology == PrimitiveType::Lines ? Form{ 2, "lines" } : Form{ 1, "points" };
}

/// The sum of the normals of the triangles around each vertex that `isWanted`, by their areas. In double, so that the
/// cross products neither overflow nor vanish.
std::vector<double3> normalsAround(GltfGeometry const& geometry, std::vector<bool> const& isWanted) {
    std::vector<double3> sums(geometry.positions.size(), double3(0.0));
    std::vector<uint32_t> const& indices = geometry.indices;
    for (size_t i = 0; i + 2 < indices.size(); i += 3) {
        if (!isWanted[indices[i]] && !isWanted[indices[i + 1]] && !isWanted[indices[i + 2]]) continue;
        const double3 p(geometry.positions[indices[i]]);
        const double3 q(geometry.positions[indices[i + 1]]), r(geometry.positions[indices[i + 2]]);
        const double3 normal = glm::cross(q - p, r - p);
        if (!std::isfinite(normal.x + normal.y + normal.z)) continue;
        for (size_t corner = 0; corner < 3; ++corner) sums[indices[i + corner]] += normal;
    }
    return sums;
}

void repairNormals(std::string const& path, GltfGeometry& geometry, Diagnostics& diagnostics) {
    std::vector<bool> isBroken;
    for (float3 const& normal : geometry.normals) isBroken.push_back(!allFinite(normal));
    const auto broken = std::ranges::count(isBroken, true);
    if (broken == 0) return;
    const bool hasFaces = geometry.topology == PrimitiveType::Triangles;
    const std::vector<double3> around = hasFaces ? normalsAround(geometry, isBroken) : std::vector<double3>();
    for (size_t i = 0; i < isBroken.size(); ++i) {
        if (!isBroken[i]) continue;
        const double length = hasFaces ? std::sqrt(glm::dot(around[i], around[i])) : 0;
        geometry.normals[i] = length > 0 && std::isfinite(length) ? float3(around[i] / length) : float3(0, 0, 1);
    }
    diagnostics.warn("{}: {} of {} normals are not finite; they became those of the triangles around them", path,
                     broken, isBroken.size());
}

void repairTangents(std::string const& path, GltfGeometry& geometry, Diagnostics& diagnostics) {
    const auto broken = std::ranges::count_if(
            geometry.tangents, [](float4 const& t) { return !allFinite(float3(t)) || !std::isfinite(t.w); });
    if (broken == 0) return;
    diagnostics.warn("{}: {} of {} tangents are not finite; all of this primitive were left out", path, broken,
                     geometry.tangents.size());
    geometry.tangents.clear();
}

} // namespace

void repairDirections(std::string const& path, GltfGeometry& geometry, Diagnostics& diagnostics) {
    repairNormals(path, geometry, diagnostics);
    repairTangents(path, geometry, diagnostics);
}

void checkFrames(std::string const& path, GltfGeometry& geometry, Diagnostics& diagnostics) {
    const auto isUnit = [](float4 const& q) { return std::abs(glm::dot(q, q) - 1) < 0.05f; }; // 8 bits reach 0.02
    if (std::ranges::all_of(geometry.frames, isUnit) && !geometry.normals.empty()) return;
    if (!geometry.frames.empty())
        diagnostics.warn("{}: _FILAMENT_TANGENTS needs unit quaternions and a NORMAL, and is left out", path);
    geometry.frames.clear();
}

void dropNonFinite(std::string const& path, GltfGeometry& geometry, Diagnostics& diagnostics) {
    std::vector<bool> isBroken;
    for (float3 const& position : geometry.positions) isBroken.push_back(!allFinite(position));
    const auto broken = std::ranges::count(isBroken, true);
    if (broken == 0) return;
    const Form form = formOf(geometry.topology);
    std::vector<uint32_t> kept;
    for (size_t i = 0; i + form.corners <= geometry.indices.size(); i += form.corners) {
        const std::span<const uint32_t> corners(&geometry.indices[i], form.corners);
        if (std::ranges::none_of(corners, [&](uint32_t vertex) { return isBroken[vertex]; }))
            kept.insert(kept.end(), corners.begin(), corners.end());
    }
    const size_t before = geometry.indices.size() / form.corners, after = kept.size() / form.corners;
    diagnostics.warn("{}: {} of {} {} are not drawn: {} of {} positions are not finite, in the file or after morphing "
                     "and skinning",
                     path, before - after, before, form.plural, broken, isBroken.size());
    geometry.indices = std::move(kept);
    const float3 place = geometry.indices.empty() ? float3(0.0f) : geometry.positions[geometry.indices[0]];
    for (size_t i = 0; i < isBroken.size(); ++i) {
        if (isBroken[i]) geometry.positions[i] = place;
    }
}

} // namespace filament_core::assets
