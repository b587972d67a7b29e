// SPDX-License-Identifier: Apache-2.0
/// fitVertices: baked occlusion as values of vertices, whose interpolation over the triangles comes nearest to what was
/// traced at the texels of charts.
///   Method  least squares over the texels: Kavan, Bargteil and Sloan 2011, "Least Squares Vertex Baking" (Computer
///           Graphics Forum 30(4)). A value at a vertex alone would darken all of a triangle that ends in a corner.
///           Vertices of one place and one normal have one value. A term of a thousandth of the others pulls the ends
///           of edges together, so that vertices that no texel knows have one, too.
///   Out     for each surface and each of its vertices the visible part, [0, 1], and the mean open direction, world,
///           not normalised. Without texels: everything is visible.
///   Thread  any; pure: the same values for the same texels.
///   Cost    conjugate gradients: in seconds for a million vertices.
#pragma once

#include "tools/bake/BakeModel.h"
#include "tools/bake/LightmapImage.h"

namespace filament_core::bake {

using VertexOcclusion = std::vector<std::vector<double4>>; ///< visible part, direction; by surface and vertex

VertexOcclusion fitVertices(std::span<const BakeSurface> surfaces, Atlas const& atlas,
                            std::span<const AtlasTexel> texels, std::span<const TexelLight> lights);

/// The visible part that the vertices give to the texels, as OcclusionImage::visible, for reports.
LightmapImage visibleOf(VertexOcclusion const& values, std::span<const BakeSurface> surfaces, Atlas const& atlas,
                        std::span<const AtlasTexel> texels, std::span<const TexelLight> lights);

/// Surfaces whose texture coordinates say the visible part of their vertices: places in a row of 256 texels, black to
/// white. Any loader shows it with such a texture as occlusion texture.
Atlas rampAtlas(VertexOcclusion const& values, std::span<const BakeSurface> surfaces);
std::vector<std::byte> rampTexels(); ///< RGBA8, 256 x 1

} // namespace filament_core::bake
