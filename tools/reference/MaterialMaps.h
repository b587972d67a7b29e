// SPDX-License-Identifier: Apache-2.0
/// MaterialPoint: a point of a glTF material as its shader sees it: maps, and the frame of normal maps.
///   Space   world. Seen from behind, the whole frame is reversed.
///   Memory  refers to its part and varyings, which must outlive it. Thread: pure functions.
#pragma once

#include "tools/reference/Geometry.h"

#include <array>

namespace filament_core::reference {

inline bool has(assets::TextureRef const& texture) { return texture.image != assets::kNone; }

struct MaterialPoint {
    Part const& part;
    Varyings const& varyings;
    double side = 1; ///< -1: seen from behind

    assets::MaterialData const& material() const { return *part.material; }
    /// For a map that exists.
    double4 fetch(assets::TextureRef const& texture) const;
    /// Red and green are one map each; missing ones are 1.
    double2 fetchScalars(assets::TexturePair const& pair) const;
    /// RGB is one map, alpha the other.
    double4 fetchColorAndScalar(assets::TexturePair const& pair) const;

    /// From the tangent frame, any length.
    double3 toWorld(double3 local) const;
    /// A vector of a map, as its x and y are in the tangent frame: shaders/material/gltf/vectors.glsl, with the
    /// triangle's edges in place of derivatives.
    double2 vectorOfVertex(assets::TextureRef const& map, double2 vector) const;
    /// The geometry's normal, unit.
    double3 smoothNormal() const;
    /// Unit; smoothNormal() if there is no map.
    double3 mappedNormal(assets::TextureRef const& map, double scale) const;
    /// EXT_materials_bump: mappedNormal() of the normal map, tilted by the surface gradient of the heights. The
    /// formulas are those of shaders/material/gltf/bump.glsl, with the triangle's edges in place of derivatives, and
    /// texels as the width that heights are averaged over.
    double3 bumpedNormal() const;

private:
    double2 uvOf(assets::TextureRef const& texture) const;
    double4 fetchAt(assets::TextureRef const& texture, double2 uv) const;
    /// How the map's coordinates change along the edges of the triangle.
    std::array<double2, 2> uvEdgesOf(assets::TextureRef const& map) const;
    double2 derivedVector(assets::TextureRef const& map, double2 vector) const;
    /// Metres that the height grows along the edges of the triangle.
    double2 riseAlongEdges() const;
};

} // namespace filament_core::reference
