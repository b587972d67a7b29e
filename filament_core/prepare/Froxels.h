// SPDX-License-Identifier: Apache-2.0
/// Froxels: which of a view's punctual lights may reach which froxel. A fragment shades with the list of its froxel, in
/// the order of all lights; the lights that it does not find there are those whose attenuation is zero. So the image
/// has the bits of one in which every fragment tries every light.
///   In      the selected lights as the shaders read them, and the view.
///   Out     the words of shader::FroxelBuffer, and FrameUniforms::froxelGrid and froxelPlaces.x; counts.
///   Exact   a list has every light that reaches a point of its froxel, and maybe others: spheres are tested a row of
///           tiles at a time, cones by the box of each froxel. FroxelMargins says how much wider the tests are than the
///           light. Lights of unlimited range are in every list.
///   Grid    none, so one list for the view, if there are few lights, all of them are unlimited, or the projection is
///           neither perspective nor parallel.
///   Limits  kMaxLightsOfFroxel; if more may reach a froxel, those brightest at the camera stay (ties by order).
///   Thread  the thread that owns the arena; a job for each slice. The same words for any number of workers.
///   Memory  the arena: up to 512 B a froxel while it works, 4 B a froxel and entry as result.
///   Fails   std::bad_alloc. Cost: bench/filament_core/prepare/FroxelsBench.cpp
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/prepare/FroxelGrid.h"
#include "filament_core/prepare/LightBounds.h"
#include "jobsystem/JobSystem.h"

#include <span>

namespace filament_core::prepare {

/// With fewer lights, finding a fragment's froxel takes longer than trying all of them.
inline constexpr size_t kLightsWorthAGrid = 4;

struct FroxelOptions {
    size_t fewest = kLightsWorthAGrid; ///< with fewer lights there is no grid
    FroxelMargins margins{};
};

FroxelLists assignLights(jobs::JobSystem& jobs, Arena& arena, ViewSpace const& space, uint2 size,
                         std::span<const shader::PunctualLight> lights, shader::FrameUniforms& frame,
                         ViewCounts& counts, FroxelOptions const& options = {});

} // namespace filament_core::prepare
