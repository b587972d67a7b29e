// SPDX-License-Identifier: Apache-2.0
/// prepareSplats: projects and sorts the splats of a view (<filament_core/Splats.h>).
///   How     Zwicker et al. 2001, "EWA volume splatting", as Kerbl et al. 2023, "3D Gaussian splatting for real-time
///           radiance field rendering", use it: the covariance by the Jacobian of the lens at the centre, widened by
///           0.3 square pixels; colours by spherical harmonics of the direction to the centre.
///   Order   by the distance of centres from the camera, the farthest first; splats of one distance keep the order of
///           the scene.
///   Skips   clouds that are hidden, out of view or in other layers; splats that are out of view, in front of the near
///           plane, or transparent.
///   Bits    the same for any number of workers: jobs over ranges, and a stable sort.
///   Memory  the arena.   Thread: as prepareView().   Fails: std::bad_alloc.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/SplatPacket.h"
#include "filament_core/prepare/ViewConstants.h"
#include "jobsystem/JobSystem.h"

namespace filament_core::prepare {

/// Beyond these, the farthest are left out.
inline constexpr size_t kMaxVisibleSplats = size_t{ 1 } << 24;

/// `size`: of the view in pixels.
SplatPacket prepareSplats(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewSpace const& space,
                          uint2 size);

/// A corner of a quad on the device.
struct SplatVertex {
    float3 position;               ///< normalised device coordinates
    std::array<uint16_t, 4> color; ///< SplatQuad::color
    std::array<uint16_t, 2> at;    ///< half floats: standard deviations from the centre
};
static_assert(sizeof(SplatVertex) == 24);

/// Four for each splat: corners 0, 1, 2 and 3 around it.
void writeSplatVertices(jobs::JobSystem& jobs, SplatList const& list, std::span<SplatVertex> vertices);

/// The colour of spherical harmonics in a direction of length 1, (degree + 1)^2 coefficients.
float3 splatColor(std::span<const float3> harmonics, uint32_t degree, float3 direction);

} // namespace filament_core::prepare
