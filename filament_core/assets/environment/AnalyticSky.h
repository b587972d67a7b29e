// SPDX-License-Identifier: Apache-2.0
/// AnalyticSky: a clear daylight sky with its sun, as a panorama that lights scenes without any file.
///   Model   luminance and chromaticity of Preetham, Shirley and Smits 1999, "A Practical Analytic Model for Daylight";
///           the sun's disc as in its appendix (Rayleigh and aerosol extinction); below the horizon a Lambert ground
///           lit by that sky.
///   Out     equirectangular, twice as wide as high, in kcd/m^2: with an illuminance of 1000 lux per unit it is
///           physical. The disc (about 10^6) exceeds the range of half floats (65504), as a real sun does. Its energy
///           is exact even if it covers less than a pixel.
///   Thread  runs on the job system; the same bits for any number of workers.
///   Fails   InvalidArgument with the option's name and range.  Cost: 1024 x 512 in about 60 ms on two cores.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/image/HdrImage.h"
#include "jobsystem/JobSystem.h"

namespace filament_core::assets {

struct AnalyticSkyOptions {
    uint32_t height = 512;                      ///< [8, 4096]; the width is twice that
    float3 sunDirection{ 0.45f, 0.55f, 0.70f }; ///< towards the sun, any length, at or above the horizon
    float turbidity = 3;                        ///< haze, [1.7, 10]: 2 arctic, 3 clear, 6 warm and moist, 10 hazy
    float3 groundAlbedo{ 0.18f, 0.17f, 0.15f }; ///< linear, [0, 1]
    bool sunDisc = true;
};

Result<HdrImage> makeAnalyticSky(AnalyticSkyOptions const& options, jobs::JobSystem& jobs);

/// Illuminance of the sun alone on a plane facing it, in klx per linear Rec. 709 component: the value for a directional
/// light that replaces the disc.
float3 analyticSunIlluminance(AnalyticSkyOptions const& options);

} // namespace filament_core::assets
