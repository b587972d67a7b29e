// SPDX-License-Identifier: Apache-2.0
/// bakeTexels: the irradiance at texels of an atlas, by tracing paths, or their ambient occlusion, by tracing rays;
/// each with a standard error.
///   In      a traced scene, the points of the texels in the world, settings.
///   Out     for each texel its mean and the standard error of that mean: samples are taken in passes, each of which is
///           an independent scramble of evenly spread points, and the spread of the passes' means gives the error.
///   Thread  any; works on the job system. A texel depends on its place and the settings alone: the same bits for any
///           number of workers, in any order, and in any number of parts.
///   Occlusion  the cosine-weighted part of the hemisphere in which nothing is nearer than a distance, and the mean of
///           these directions (Landis 2002, "Production-Ready Global Illumination"). Blended surfaces hide a part.
///   Memory  104 bytes a texel.
///   Cost    a few rays for each sample; README.md
#pragma once

#include "jobsystem/JobSystem.h"
#include "tools/bake/Texels.h"
#include "tools/reference/PathTracer.h"
#include "tools/reference/Reference.h"

#include <functional>
#include <optional>
#include <span>

namespace filament_core::bake {

inline constexpr uint32_t kLeastPasses = 32; ///< before an error is believed

inline double luminanceOf(double3 color) { return glm::dot(color, double3(0.2126, 0.7152, 0.0722)); }

struct LightSettings {
    /// Ambient occlusion in place of light: what is further away than so many metres hides nothing, (0, inf].
    std::optional<double> occlusionMeters{};
    uint32_t samplesPerTexel = 1024; ///< [32, 2^20], rounded up to whole passes; with `relativeError` the most
    /// > 0: a texel is done when the standard error of its luminance is below this part of it.
    double relativeError = 0;
    bool directLight = false; ///< whether light that arrives straight from lamps counts, too
    uint32_t maxBounces = 64;
    uint32_t seed = 1;
    Exposure exposure{}; ///< for which the scene's glowing surfaces are authored (docs/baking.md)
};

struct TexelLight {
    double3 irradiance{ 0.0 };    ///< lux; with LightSettings::occlusionMeters the visible part, [0, 1], three times
    double3 standardError{ 0.0 }; ///< of the mean; widened so that two of them hold for 95.4 % of texels
    double3 open{ 0.0 };          ///< mean of the open directions, world, up to 1 long; of occlusion alone
    double openness = 0;          ///< cosine-weighted part of the hemisphere in which the sky is seen, [0, 1]
    double backs = 0; ///< part of the directions in which backs of surfaces are seen, or what covers it: [0, 1]
    uint32_t samples = 0;
    uint32_t rays = 0;
};

/// The passes of a texel: how many, and of how many samples each.
struct TexelPasses {
    uint32_t count = kLeastPasses, samples = 1;
};
TexelPasses passesOf(LightSettings const& settings);

/// Bakes `texels` in batches. `finished(first, lights)` receives each batch in order, on the calling thread.
void bakeTexels(reference::TracedScene const& scene, std::span<const BakeSurface> surfaces, Atlas const& atlas,
                std::span<const AtlasTexel> texels, LightSettings const& settings, jobs::JobSystem& jobs,
                std::function<bool(size_t first, std::span<const TexelLight> lights)> const& finished);

/// One texel: of light, and of occlusion. `stream`: of its random numbers.
TexelLight lightOf(reference::PathTracer const& tracer, double3 origin, SurfacePoint const& point, uint64_t stream,
                   LightSettings const& settings);
TexelLight occlusionOf(reference::TracedScene const& scene, SurfacePoint const& point, uint64_t stream,
                       LightSettings const& settings);

} // namespace filament_core::bake
