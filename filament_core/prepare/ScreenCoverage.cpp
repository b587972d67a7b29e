// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/ScreenCoverage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace filament_core::prepare {

CoverageLens coverageLens(double3 const& cameraWorld, float4x4 const& clipFromView) {
    // The screen is 2 / scale wide and high: at distance 1, or anywhere if w is 1.
    const double scales = std::abs(static_cast<double>(clipFromView[0][0]) * static_cast<double>(clipFromView[1][1]));
    return { cameraWorld, std::numbers::pi * scales / 4, clipFromView[2][3] == 0 };
}

double screenCoverage(CoverageLens const& lens, double3 const& center, double radius) {
    constexpr double kAll = std::numeric_limits<double>::infinity();
    if (radius == 0) return 0;
    const double3 away = center - lens.position;
    const double distance2 = away.x * away.x + away.y * away.y + away.z * away.z;
    const bool isOutside = lens.isParallel || distance2 > radius * radius; // not if any is NaN
    const double coverage = lens.perArea * radius * radius / (lens.isParallel ? 1 : distance2);
    return isOutside && coverage >= 0 ? coverage : kAll;
}

uint32_t levelFor(std::span<const double> least, double coverage) {
    const auto reached = std::ranges::find_if(least, [coverage](double at) { return coverage >= at; });
    return static_cast<uint32_t>(reached - least.begin());
}

} // namespace filament_core::prepare
