// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/AmbientOcclusion.h"

#include "tools/reference/TracedScene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace filament_core::reference {
namespace {

/// Cosine-weighted around +Z: Malley's method.
double3 cosineWeighted(double2 u) {
    const double radius = std::sqrt(u.x), angle = 2 * std::numbers::pi * u.y;
    return { radius * std::cos(angle), radius * std::sin(angle), std::sqrt(std::max(0.0, 1 - u.x)) };
}

double2 onTorus(double2 x) { return x - glm::floor(x); }

} // namespace

void occludeAmbientLight(TracedScene const& scene, ReferenceSettings const& settings, SampleStream const& numbers,
                         uint32_t pair, SurfaceSample& surface, uint64_t& rays) {
    const double3 n = surface.geometricNormal;
    const double3 x = glm::normalize(glm::cross(std::abs(n.x) < 0.5 ? double3(1, 0, 0) : double3(0, 1, 0), n));
    const double3 y = glm::cross(n, x);
    const double2 turn = numbers.pair(pair);
    double open = 0;
    double3 mean(0.0);
    for (uint32_t i = 0; i < settings.occlusionRays; ++i) {
        // Hammersley's points, the same for each sample, shifted on the torus by random numbers: Cranley and Patterson
        // 1976, "Randomization of Number Theoretic Methods for Multiple Integration".
        const double2 even((i + 0.5) / settings.occlusionRays, sobol::unitFromBits(sobol::reversed(i)));
        const double3 local = cosineWeighted(onTorus(even + turn));
        const double3 direction = x * local.x + y * local.y + n * local.z;
        const double share = scene.transmittance({ .origin = surface.rayOrigin(direction),
                                                   .direction = direction,
                                                   .farthest = settings.occlusionRadius },
                                                 false)
                                     .x;
        open += share / settings.occlusionRays;
        mean += direction * share;
    }
    rays += settings.occlusionRays;
    surface.occlusion = settings.occlusionMap == Switch::Off ? open : std::min(surface.occlusion, open);
    if (!settings.occlusionBends) return;
    surface.bendsReflections = false; // as materials without maps of bent normals
    const double length = glm::length(mean);
    const double3 leaning =
            surface.bentNormal.value_or(surface.normal) + (length > 0 ? mean / length - n : double3(0.0));
    if (glm::length(leaning) > 1e-2) surface.bentNormal = glm::normalize(leaning);
}

} // namespace filament_core::reference
