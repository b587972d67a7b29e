// SPDX-License-Identifier: Apache-2.0
/// Exact: what a flat wall under a sun must look like, pixel by pixel, in double precision: the engine's own formulas
/// (LibCppDouble.h), a ray for each pixel centre, the DFG integral instead of its table.
///   Thread  pure functions. Fails: never.
#pragma once

#include "tests/numerics/scenes/Stage.h"

namespace filament_core::hard {

/// Unit vector from the camera through the centre of a pixel, in world space.
double3 directionThroughPixel(View const& view, uint32_t x, uint32_t y);

/// Radiance towards `toViewer` under one sun, exposed by the view's camera; the normal is +z.
double3 sunOnWall(View const& view, Look const& look, SunLight const& sun, double3 toViewer);

/// Every covered pixel of a wall in the plane z = 0 is what sunOnWall() says, cut at what the engine stores at most:
/// within `relative` of it or 2^-24, the smallest half float. Pixels farther than `radius` from the wall's origin are
/// not tested.
void expectSunOnWall(Picture const& picture, View const& view, Look const& look, SunLight const& sun, double relative,
                     double radius = 1e9);

} // namespace filament_core::hard
