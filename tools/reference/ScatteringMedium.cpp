// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/ScatteringMedium.h"

#include "tools/reference/Microfacets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace filament_core::reference {
namespace {

constexpr double kPartOfDark = 0.1; // colours that hardly scatter are chosen, too: they reach the surface

double3 exponential(double3 x) { return { std::exp(x.x), std::exp(x.y), std::exp(x.z) }; }

} // namespace

Flight sampleFlight(MediumSample const& medium, double3 carried, double farthest, double2 u) {
    double3 chances = carried * (medium.albedo + kPartOfDark);
    chances /= chances.x + chances.y + chances.z;
    const int color = u.x < chances.x ? 0 : u.x < chances.x + chances.y ? 1 : 2;
    const double extinction = medium.extinction[color];
    const double distance = extinction > 0 ? -std::log1p(-u.y) / extinction : std::numeric_limits<double>::infinity();
    Flight flight{ .distance = distance, .scatters = distance < farthest };
    const double3 left = exponential(-medium.extinction * std::min(distance, farthest));
    if (!flight.scatters) {
        flight.weight = left / glm::dot(chances, left);
        return flight;
    }
    const double3 density = medium.extinction * left;
    flight.weight = medium.albedo * density / glm::dot(chances, density);
    return flight;
}

double phaseHenyeyGreenstein(double cosine, double anisotropy) {
    const double g = anisotropy, root = 1 + g * g - 2 * g * cosine;
    return (1 - g * g) / (4 * std::numbers::pi * root * std::sqrt(root));
}

double3 turned(double3 direction, double anisotropy, double2 u) {
    const double g = anisotropy;
    double cosine = 1 - 2 * u.x;
    // The inverse of the cumulative distribution divides by g.
    if (std::abs(g) > 1e-3) {
        const double part = (1 - g * g) / (1 - g + 2 * g * (1 - u.x));
        cosine = std::clamp((1 + g * g - part * part) / (2 * g), -1.0, 1.0);
    }
    const double sine = std::sqrt(1 - cosine * cosine), azimuth = 2 * std::numbers::pi * u.y;
    return glm::normalize(Frame(direction).toWorld({ sine * std::cos(azimuth), sine * std::sin(azimuth), cosine }));
}

} // namespace filament_core::reference
