// SPDX-License-Identifier: Apache-2.0
/// VertexPositions: positions of vertices as stored, the box around them, and the indices of their triangles.
///   Thread  any; pure.
///   Cost    3 ns a vertex.
#pragma once

#include "backend/api/Descriptions.h"
#include "filament_core/scene/Deformations.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace filament_core::scene {

/// Components that the format lacks are 0. None: shaders cannot read it as a position.
std::optional<double3> positionAt(const std::byte* source, backend::VertexFormat format);

/// As stored, those that are not finite as well; none if the layout has none.
std::vector<float3> positionsOf(backend::VertexLayout const& layout, std::span<const std::byte> vertices);

/// As stored; of a last one that is cut off nothing.
std::vector<uint32_t> indicesOf(backend::IndexFormat format, std::span<const std::byte> indices);

/// Around the finite positions of an interleaved stream; empty if there are none, or the layout has none.
/// `vertices`: of this stream; empty if the positions are in another one.
MinMax boundsOf(backend::VertexLayout const& layout, std::span<const std::byte> vertices, uint8_t stream = 0);
bool hasPositions(backend::VertexLayout const& layout, uint8_t stream);

} // namespace filament_core::scene
