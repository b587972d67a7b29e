// SPDX-License-Identifier: Apache-2.0
/// SkyLights: finds the sun and the brightest regions of a sky, and takes them out of it as directional lights.
///   In      a sanitised sky.   Out: the lights, and the sky without them. Their sum is the sky: what a pixel loses,
///           times its solid angle, is what a light has, in every component.
///   Sun     the region around a peak whose light, over the sky around it, ends within a few degrees. Its pixels fall
///           to a surface that is smooth and continues the ring around it: the harmonic one, Poisson's integral.
///   Fit     what is more than twice as bright as the mean is cut into regions by planes, the widest and brightest
///           region first, where the variances of the parts are least: Viriyothai and Debevec 2009, "Variance
///           Minimization Light Probe Sampling", with planes through the sphere in place of rows and columns, so that
///           there is no seam. The brightest regions become lights, and fall to twice the mean.
///   Thread  runs on the job system; the same bits for any number of workers.
///   Memory  Fit: 4 B a bright pixel.   Fails: never.
///   Cost    6 to 9 ms for 1024 x 512 pixels on one core; Fit 14 to 21 ms.
#pragma once

#include "filament_core/assets/environment/SkyGrid.h"
#include "jobsystem/JobSystem.h"

#include <filament_core/EnvironmentLights.h>

#include <span>

namespace filament_core::assets {

/// `most`: at most so many lights of EnvironmentSun::Fit, [1, EnvironmentLights::kMost].
EnvironmentLights takeLights(HdrImage& sky, SkyLayout layout, EnvironmentSun sun, uint32_t most, jobs::JobSystem& jobs);

// ---- parts, for each other and for tests

/// What is more than so many times as bright as the mean may be a light.
inline constexpr double kBrightOfMean = 2;

/// Luminance times solid angle of the whole sky over 4 pi.
double meanLuminance(SkyGrid const& sky, jobs::JobSystem& jobs);
/// Luminous illuminance of a surface that faces a direction, by the sky and by lights that were taken out of it.
double facingIlluminance(SkyGrid const& sky, std::span<const ExtractedLight> lights, double3 direction,
                         jobs::JobSystem& jobs);

/// What leaves a sky on its way into a light.
struct TakenLight {
    double3 illuminance{ 0.0 }; ///< sum of what pixels lose times their solid angles
    double3 moment{ 0.0 };      ///< sum of its luminance times direction

    void add(double3 lost, double3 direction);
    double luminous() const;
};
/// `pixelSize` in radians: what it spreads is no size. `facing`: luminous illuminance of a surface that faces the light
/// in the sky as it was.
ExtractedLight lightOf(TakenLight const& taken, double pixelSize, double facing);

/// Takes the sun out if there is one, else says why there is none.
EnvironmentLights takeSun(SkyGrid const& sky, jobs::JobSystem& jobs);
/// Takes the brightest regions out, until there are `most` lights with those that were taken before.
void takeRegions(SkyGrid const& sky, EnvironmentLights& lights, uint32_t most, jobs::JobSystem& jobs);

} // namespace filament_core::assets
