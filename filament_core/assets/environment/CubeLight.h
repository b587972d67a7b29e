// SPDX-License-Identifier: Apache-2.0
/// CubeLight: an environment that its file holds pre-filtered, as cubes of radiance and harmonics of irradiance.
///   In      levels of half the size each; the first is the radiance itself.
///   Out     like bakeEnvironment() of a panorama, without an irradiance cube: the file has only coefficients.
///   Space   directions of the cube are those of IblDirections.h. The cube lies in the world as a matrix says, whose
///           columns are unit vectors at right angles; it may mirror.
///   Thread  runs on the job system; the same bits for any number of workers.
///   Memory  16 bytes per texel, and the result.  Fails: never.
///   Cost    of encoding several levels: milliseconds. A single level is pre-filtered first: see IblBaker.h.
#pragma once

#include "filament_core/assets/environment/Environment.h"

namespace filament_core::assets {

struct CubeLight {
    /// Level i of n is pre-filtered for the perceptual roughness i / (n - 1). A single level: pre-filtering is left to
    /// environmentFromCube(). Borders are filled; radiance is in [0, kMaxRadiance].
    std::vector<IblCubeLevel> levels;
    std::array<float4, 9> irradianceSh{}; ///< irradiance / pi in directions of the cube; see shaders/lib/ibl.glsl
    float3x3 worldFromCube{ 1.0f };
};

/// RGBA16F, with roughness mapped linearly to levels.
EnvironmentData environmentFromCube(CubeLight const& light, jobs::JobSystem& jobs);

/// The first level as an equirectangular panorama of the world, twice as wide as high, for tools that know only those;
/// a bilinear look-up per pixel. `width` is even.
HdrImage pictureFromCube(CubeLight const& light, uint32_t width, jobs::JobSystem& jobs);

} // namespace filament_core::assets
