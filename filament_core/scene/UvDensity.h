// SPDX-License-Identifier: Apache-2.0
/// UvDensity: how far texture coordinates change across a mesh, at least: what bounds the mip levels that it can show.
///   In      triangles as they are uploaded; levels of detail count as well.
///   Out     by set of texture coordinates: the square root of the smallest area in texture space for a unit of area in
///           the space of the stored positions. Triangles without an area are not drawn and do not count. 0: nothing
///           is known (points, lines, no such set, coordinates that are not finite), or a triangle shows a single line
///           or point of the texture.
///   Thread  any; pure.   Cost: 20 ns a triangle.
#pragma once

#include "filament_core/scene/Drawables.h"

#include <array>
#include <cstddef>
#include <span>

namespace filament_core::scene {

using UvDensity = std::array<float, 4>;

UvDensity uvDensityOf(GeometryLayout const& layout, std::span<const std::byte> vertices, backend::IndexFormat format,
                      std::span<const std::byte> indices);

} // namespace filament_core::scene
