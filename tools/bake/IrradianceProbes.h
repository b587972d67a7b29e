// SPDX-License-Identifier: Apache-2.0
/// Traces what irradiance probes see.
///   Method  paths from the probe in directions that cover the sphere evenly (Owen-scrambled Sobol' points); their mean
///           times each basis function is a coefficient of irradiance / pi (Ramamoorthi and Hanrahan 2001). The spread
///           of the means of passes is the standard error. Distances are averaged by texel of an octahedral map.
///   Inside  a probe is in geometry if more than a quarter of its rays meet the back of a single-sided surface first.
///   Bits    a function of the place and the settings: the same for any number of workers.
///   Thread  any, several at once.   Fails: never.
#pragma once

#include "tools/reference/TracedScene.h"

#include <filament_core/IrradianceGrid.h>

#include <cstdint>
#include <vector>

namespace filament_core::bake {

struct ProbeSettings {
    uint32_t rays = 1024;      ///< paths, rounded up to whole passes
    uint32_t depthSize = 16;   ///< IrradianceProbes::depthSize; 0: none
    uint32_t depthRays = 8;    ///< for each of its texels
    double farthestMeters = 1; ///< longer distances count as this
    double exposure = 1; ///< Exposure::factor() of the camera for which glowing surfaces are authored, > 0: they are
                         ///< as bright as it makes them
    uint32_t maxBounces = 64;
    uint32_t seed = 1;
};

inline constexpr uint32_t kProbePasses = 16;

struct TracedProbe {
    IrradianceProbe probe{};
    std::vector<float2> depths{};
    uint64_t rays = 0;
};

/// `place`: metres in the world. `stream` tells probes apart. Coefficients and depths are along the axes of the box.
TracedProbe traceProbe(reference::TracedScene const& scene, double3 place, uint64_t stream,
                       float3x3 const& worldFromBox, ProbeSettings const& settings);

/// Whether something lies between two places of the world; their own surfaces, within a thousandth of the way, do not.
bool isBlocked(reference::TracedScene const& scene, double3 from, double3 to);

} // namespace filament_core::bake
