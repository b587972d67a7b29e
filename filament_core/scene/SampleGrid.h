// SPDX-License-Identifier: Apache-2.0
/// sampleGrid: what an irradiance grid says of a point. Trilinear interpolation between the probes of its cell that see
/// the point: by the one-sided Chebyshev inequality on the mean and the mean square of the distance to what each sees
/// (Majercik et al. 2019, "Dynamic Diffuse Global Illumination with Ray-Traced Irradiance Fields", section 5.2).
///   In      points in the frame of the grid's box, metres from its centre; outside they count as on its faces.
///   Thread  pure functions.   Memory: none.   Fails: never.
#pragma once

#include "filament_core/scene/Grids.h"

#include <array>

namespace filament_core::scene {

using IrradianceSh = std::array<float3, 9>; ///< irradiance / pi, as IrradianceProbe's, along the axes of the world

struct GridSample {
    IrradianceSh light{}; ///< the mean over the probes that see the point
    float weight = 0; ///< their share among those outside of geometry, [0, 1]; 0: none sees it, and there is no light
};

/// `seesThroughWalls`: every probe that is not inside of geometry counts.
GridSample sampleGrid(GridRecord const& grid, float3 local, bool seesThroughWalls = false);

/// Metres between neighbours; the side of the box where there is one.
float3 spacingOf(GridRecord const& grid);
/// Of a probe, metres from the centre.
float3 placeOf(GridRecord const& grid, uint3 probe);
/// [0, 1]: how surely the probe sees the point at `toPoint` from it; 1 without depths. `biasMeters` is subtracted from
/// the distance, because surfaces are as far away as what the probe sees.
float visibilityOf(IrradianceProbes const& probes, size_t probe, float3 toPoint, float biasMeters);
/// Of a grid: a twentieth of the least distance of two probes.
float biasOf(GridRecord const& grid);

/// The texel of an octahedral map of this size (Cigolle et al. 2014, "A Survey of Efficient Representations for
/// Independent Unit Vectors") around a direction, and the middle of one. Not normalised: any length.
float2 octahedralPlace(float3 direction, uint32_t size); ///< in texels, [0, size]
float3 octahedralDirection(float2 place, uint32_t size); ///< unit

} // namespace filament_core::scene
