// SPDX-License-Identifier: Apache-2.0
#include "base/math/ColorSpaces.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace filament_core {
namespace {

double3 xyzOf(double2 xy) { return { xy.x / xy.y, 1, (1 - xy.x - xy.y) / xy.y }; }

double3x3 diagonal(double3 d) { return { double3(d.x, 0, 0), double3(0, d.y, 0), double3(0, 0, d.z) }; }

} // namespace

double3x3 xyzFromRgb(Chromaticities const& space) {
    const auto unscaled = [](double2 xy) { return double3(xy.x, xy.y, 1 - xy.x - xy.y); };
    const double3x3 primaries(unscaled(space.red), unscaled(space.green), unscaled(space.blue));
    return primaries * diagonal(glm::inverse(primaries) * xyzOf(space.white));
}

double3x3 whiteAdaptation(double2 from, double2 to) {
    const double3x3 cones = glm::transpose(double3x3(double3(0.8951, 0.2664, -0.1614), double3(-0.7502, 1.7135, 0.0367),
                                                     double3(0.0389, -0.0685, 1.0296)));
    return glm::inverse(cones) * diagonal(cones * xyzOf(to) / (cones * xyzOf(from))) * cones;
}

std::optional<double3x3> rec709FromRgb(Chromaticities const& space) {
    const double3x3 result = glm::inverse(xyzFromRgb(kRec709Chromaticities)) *
                             whiteAdaptation(space.white, kRec709Chromaticities.white) * xyzFromRgb(space);
    constexpr double kMost = 1000; // ACES 2065-1, the widest space in use, has 2.6
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row) {
            if (!(std::abs(result[column][row]) <= kMost)) return std::nullopt; // NaN too
        }
    }
    const double3 white = result * double3(1);
    const bool isWhite = std::max({ std::abs(white.x - 1), std::abs(white.y - 1), std::abs(white.z - 1) }) < 1e-6;
    return isWhite ? std::optional(result) : std::nullopt;
}

bool isRec709(Chromaticities const& space, double tolerance) {
    Chromaticities const& own = kRec709Chromaticities;
    const std::array<double2, 4> differences{ space.red - own.red, space.green - own.green, space.blue - own.blue,
                                              space.white - own.white };
    return std::ranges::all_of(differences,
                               [=](double2 d) { return std::abs(d.x) <= tolerance && std::abs(d.y) <= tolerance; });
}

} // namespace filament_core
