// SPDX-License-Identifier: Apache-2.0
/// fitField: the diffuse light over the box of a renderable, a field that changes linearly along the axes of the box.
///   In      irradiance grids, the smallest first; what lights where none does; a box in the world.
///   Method  least squares over a lattice of 2 to 8 points along each side, its corners included; errors count in
///           shares of the light of each point. Points count by how many of their cell's probes see them; points that
///           none sees, behind a wall or in one, do not count.
///   Bits    a function of its arguments: whether it was fitted in this frame or an earlier one changes none.
///   Thread  pure functions.   Memory: none.   Fails: never.   Cost: 2 us (8 points) to 200 us (512 points).
#pragma once

#include "filament_core/scene/SampleGrid.h"

#include <array>
#include <span>

namespace filament_core::prepare {

using scene::IrradianceSh;

/// u: in the box, [-1, 1] along each axis of the world.
struct LightField {
    std::array<float3, 4> middle{};                ///< of the first four coefficients of irradiance / pi
    std::array<std::array<float3, 3>, 4> change{}; ///< of these, with u.x, u.y and u.z
    std::array<float3, 5> constant{};              ///< the other five
    float error = 0; ///< root mean square of what it lacks in luminance at the points, in shares of their mean
};

struct FieldBox {
    double3 centerWorld{ 0.0 };
    float3 halfExtent{ 0.0f };
    friend bool operator==(FieldBox const&, FieldBox const&) = default;
};

/// Whether the light of the grid, or what it blends out in, reaches the box.
bool reaches(scene::GridRecord const& grid, FieldBox const& box);

/// `grids`: those that reach the box, one at least.
LightField fitField(std::span<scene::GridRecord const* const> grids, IrradianceSh const& environment,
                    FieldBox const& box);

} // namespace filament_core::prepare
