// SPDX-License-Identifier: Apache-2.0
/// ScreenCoverage: the screen coverage of an object, and the level of detail for it.
///   Units   a fraction of the screen's area: 1 covers all of it. Babylon.js compares `MSFT_screencoverage` with the
///           same.
///   In      the sphere around the bounds that all levels share, and the lens without jitter and band, so that neither
///           temporal anti-aliasing nor the size that is drawn changes a level.
///   Out     pi R^2 / (A d^2) for a perspective lens, where A is the area of the screen at distance 1 and d the
///           distance of the sphere's centre from the camera; pi R^2 / A for a parallel one. Turning the camera changes
///           nothing, and neither does what is out of view. A camera in the sphere, and a sphere that is not a number:
///           infinity, so that nothing goes missing. Radius 0: 0.
///   Bits    products and quotients of doubles from the floats of the projection: the same on every CPU. There is no
///           hysteresis: the level depends on this frame alone.
///   Thread  any.   Memory: none.   Fails: never.
#pragma once

#include "base/math/Math.h"

#include <cstdint>
#include <span>

namespace filament_core::prepare {

struct CoverageLens {
    double3 position{ 0.0 };
    double perArea = 0; ///< pi / A
    bool isParallel = false;
};

CoverageLens coverageLens(double3 const& cameraWorld, float4x4 const& clipFromView);
/// >= 0; never NaN.
double screenCoverage(CoverageLens const& lens, double3 const& center, double radius);
/// The first level whose least coverage is reached: level i is drawn for coverages in [least[i], least[i - 1]). So any
/// coverage has one level, or none: least.size(). `least` does not increase.
uint32_t levelFor(std::span<const double> least, double coverage);

} // namespace filament_core::prepare
