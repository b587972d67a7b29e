// SPDX-License-Identifier: Apache-2.0
/// OccluderMesh: the triangles of a mesh that hide what is behind them, kept for the CPU (<filament_core/Occluder.h>).
///   In      positions and triangles of a mesh.   Out: its largest triangles, with the neighbour across each edge.
///   Thread  immutable once made.   Memory: 24 bytes a triangle, about 12 a vertex.
#pragma once

#include "backend/api/Descriptions.h"

#include <filament_core/Occluder.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace filament_core {

class OccluderMesh : public std::enable_shared_from_this<OccluderMesh> {
public:
    static constexpr uint16_t kNone = 0xFFFF;
    struct Triangle {
        std::array<uint16_t, 3> corners;   ///< of `positions`, in the order of the mesh
        std::array<uint16_t, 3> neighbors; ///< the triangle across the edge from corner i to the next; kNone: none
    };

    std::vector<float3> positions; ///< each once
    std::vector<Triangle> triangles;
};

namespace scene {

/// Of an interleaved stream; null also for more than 65 536 triangles, whose largest hardly have half of the area.
Occluder occluderOf(backend::VertexLayout const& layout, std::span<const std::byte> vertices,
                    backend::IndexFormat format, std::span<const std::byte> indices);

} // namespace scene

} // namespace filament_core
