// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/SheenAlbedo.h"

#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/AlbedoTable.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace filament_core::reference {
namespace {

namespace lib = shader::lib64;

constexpr int kSheenCosines = 40, kSheenRoughnesses = 24, kSteps = 64;

// The density of importanceSampleCharlie(): ndfCharlie() noh without the lower limit of its sine.
double densityOf(double sine, double cosine, double alpha) {
    return (2 + 1 / alpha) * std::pow(sine, 1 / alpha) * cosine / lib::kTwoPi;
}

/// Integral over lights of D V nol times factor(nol).
template <class Factor>
double integrate(double nov, double alpha, int steps, Factor const& factor) {
    const double3 view(std::sqrt(1 - nov * nov), 0, nov);
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double share = (i + 0.5) / steps, u = 1 - share * share; // dense at grazing half vectors
        for (int j = 0; j < steps; ++j) {
            const double3 h = lib::importanceSampleCharlie({ 0.5 * (j + 0.5) / steps, u }, alpha);
            const double voh = glm::dot(view, h), nol = 2 * voh * h.z - nov;
            if (voh <= 0 || nol <= 0) continue;
            const double sine = std::sqrt(std::max(1 - h.z * h.z, 0.0));
            const double ratio = lib::ndfCharlie(h.z, alpha) / densityOf(sine, h.z, alpha);
            sum += ratio * lib::visibilityNeubelt(nov, nol) * nol * 4 * voh * factor(nol) * 2 * share;
        }
    }
    return sum / (double(steps) * steps);
}

AlbedoTable<double> const& table() {
    static const AlbedoTable<double> sTable(kSheenCosines, kSheenRoughnesses, [](double nov, double roughness) {
        return integrate(nov, lib::alphaFromPerceptual(roughness), kSteps, [](double) { return 1.0; });
    });
    return sTable;
}

AlbedoTable<double> const& limitedTable() {
    static const AlbedoTable<double> sTable(kSheenCosines, kSheenRoughnesses, [](double nov, double roughness) {
        const double ofView = lib::sheenLimit(sheenAlbedo(nov, roughness));
        return integrate(nov, lib::alphaFromPerceptual(roughness), kSteps,
                         [&](double nol) { return std::min(ofView, lib::sheenLimit(sheenAlbedo(nol, roughness))); });
    });
    return sTable;
}

} // namespace

double integrateSheenAlbedo(double nov, double alpha, int steps) {
    return integrate(nov, alpha, steps, [](double) { return 1.0; });
}

double sheenAlbedo(double nov, double perceptualRoughness) {
    return std::max(table().lookUp(nov, perceptualRoughness), 0.0);
}

double limitedSheenAlbedo(double nov, double perceptualRoughness) {
    return std::clamp(limitedTable().lookUp(nov, perceptualRoughness), 0.0, 1.0);
}

double averageLimitedSheenAlbedo(double perceptualRoughness) { return limitedTable().average(perceptualRoughness); }

} // namespace filament_core::reference
