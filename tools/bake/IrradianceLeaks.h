// SPDX-License-Identifier: Apache-2.0
/// findLeaks: where an irradiance grid lights points through walls.
///   Method  a lattice of points in each cell. A probe leaks into a point if it gives more than a twentieth of the
///           point's light although something lies between them. Points that no probe of their cell sees are in or
///           behind walls on all sides and do not count.
///   Thread  any.   Memory: a leak is 24 bytes.   Fails: never.
#pragma once

#include "filament_core/scene/Grids.h"

#include <functional>
#include <vector>

namespace filament_core::bake {

inline constexpr float kLeakShare = 0.05f;

struct Leak {
    float3 point{ 0.0f }; ///< metres from the centre, in the frame of the box
    uint32_t probe = 0;
    float share = 0; ///< of the point's light, (kLeakShare, 1]
    friend bool operator==(Leak const&, Leak const&) = default;
};

struct Leaks {
    std::vector<Leak> found{};
    uint64_t points = 0; ///< that some probe of their cell sees
};

using Blocked = std::function<bool(double3 from, double3 to)>; ///< places in the world

/// `pointsPerSide`: of a cell.
Leaks findLeaks(scene::GridRecord const& grid, uint32_t pointsPerSide, Blocked const& isBlocked);

} // namespace filament_core::bake
