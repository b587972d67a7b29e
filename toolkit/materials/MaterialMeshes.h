// SPDX-License-Identifier: Apache-2.0
/// MaterialMeshes: meshes for showing materials. Every vertex has every attribute that a material may require.
///   Meshes  sphere, plane (facing +z), box, torus (around +z), scroll (a sheet rolled up around y), lines (corners
///           of segments, <filament_core/Lines.h>), points (corners of points, <filament_core/Points.h>), all within
///           [-1, 1]^3; screen (clip space, the centre of the image, for vertexDomain device), billboard (view space,
///           3 m in front of the camera, for vertexDomain view).
///   Uv      v points up, as materials with flipUV expect; uv1 is uv0 rotated by a right angle and doubled.
///   Colour  hues by uv. custom0: (uv, distance from the centre of the mesh, 1); custom1 to custom7: the number of the
///           attribute in every component. Lines: custom0 is that of LineVertex.
///   Thread  any; pure.
#pragma once

#include "base/math/Math.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace filament_core::tools {

struct MaterialVertex {
    float3 position;
    float4 tangents; ///< quaternion, as in Attribute::Tangents
    float4 color;
    float2 uv0, uv1;
    std::array<float4, 8> custom;
};

struct MaterialMesh {
    std::vector<MaterialVertex> vertices;
    std::vector<uint16_t> indices;
};

/// Nothing for an unknown name.
std::optional<MaterialMesh> makeMaterialMesh(std::string_view name);

} // namespace filament_core::tools
