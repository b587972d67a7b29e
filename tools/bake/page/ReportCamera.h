// SPDX-License-Identifier: Apache-2.0
/// reportCamera: where the images of a report are taken from.
///   In      what the command line says; points of surfaces, and how much each of them should be seen.
///   Out     the camera of the command line; without one, of places inside of the box of the points and around it the
///           one that sees the largest sum of weights, looking at the middle.
///   Thread  any; pure.
///   Cost    a ray for each point in each of 24 images.
#pragma once

#include "tools/bake/Options.h"
#include "tools/bake/Texels.h"
#include "tools/reference/Reference.h"

#include <filament_core/Camera.h>

namespace filament_core::bake {

struct WeightedPoint {
    double3 position{ 0.0 }, normal{ 0, 0, 1 }; ///< world; of the side that is to be seen
    double weight = 1;                          ///< >= 0
};

Camera reportCamera(ReportOptions const& options, Exposure const& exposure, reference::TracedScene const& scene,
                    std::span<const WeightedPoint> points);

/// Points that are seen from places in the world, such as probes; each of weight 1.
std::vector<WeightedPoint> pointsAround(reference::TracedScene const& scene, std::span<const double3> places);

} // namespace filament_core::bake
