// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/BakeLight.h"

#include "tools/reference/SampleStream.h"
#include "tools/reference/TracedScene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace filament_core::bake {
namespace {

constexpr uint32_t kMostPerPass = 64; // samples; more would leave few passes to judge the error by
constexpr size_t kBatch = 2048;       // texels between two reports
constexpr double kCover = 0.125;      // texels: a board so near hides the wall behind it from every camera

reference::ReferenceSettings tracerSettings(LightSettings const& settings) {
    return { .maxBounces = settings.maxBounces, .seed = settings.seed };
}

/// Sums of the passes of a texel.
struct Sums {
    double3 sum{ 0.0 }, squares{ 0.0 };
    uint32_t passes = 0;

    void add(double3 mean) { sum += mean, squares += mean * mean, ++passes; }
    double3 mean() const { return sum / double(passes); }
    double3 standardError() const {
        const double n = passes;
        const double3 variance = glm::max(squares - sum * sum / n, double3(0.0)) / (n - 1);
        // Student's t of n - 1 degrees of freedom is wider than the normal distribution: by 1.35 / (n - 1) at 95.4 %.
        return glm::sqrt(variance / n) * (1 + 1.35 / (n - 1));
    }
};

/// With whole doublings of the passes: to stop at whichever pass happens to look good would favour those that do.
bool isDone(Sums const& sums, LightSettings const& settings) {
    const bool isDoubling = sums.passes >= kLeastPasses && (sums.passes & (sums.passes - 1)) == 0;
    if (!(settings.relativeError > 0) || !isDoubling) return false;
    return luminanceOf(sums.standardError()) <= settings.relativeError * luminanceOf(sums.mean());
}

/// As a point of a surface that a ray hits: `selfAvoidance` is the precision of Embree's floats.
reference::ReceivingPoint receiverAt(SurfacePoint const& point, double3 origin) {
    const double3 position = point.position - origin, size = glm::abs(position);
    return { .position = position,
             .normal = point.normal,
             .geometricNormal = point.faceNormal,
             .selfAvoidance = 0x1p-20 * (std::max({ size.x, size.y, size.z }) + point.longestEdge) };
}

/// Within which distances something counts, metres.
struct Reach {
    double occlusion = 0, cover = 0;
};

struct OpenRay {
    double3 direction{ 0.0 };
    double share = 0;  ///< that passes
    double hidden = 0; ///< of the point, by the back of a surface or by what covers it: [0, 1]
};

/// Along one of directions that are weighted by their cosine to the normal (Malley's method).
OpenRay openRay(reference::TracedScene const& scene, reference::ReceivingPoint const& point, Reach const& reach,
                double2 numbers, uint64_t& rays) {
    const double radius = std::sqrt(numbers.x), angle = 2 * std::numbers::pi * numbers.y;
    const double3 right = glm::normalize(std::abs(point.normal.x) > 0.5 ? glm::cross(point.normal, double3(0, 1, 0))
                                                                        : glm::cross(point.normal, double3(1, 0, 0)));
    OpenRay open;
    open.direction = right * (radius * std::cos(angle)) + glm::cross(point.normal, right) * (radius * std::sin(angle)) +
                     point.normal * std::sqrt(1 - numbers.x);
    if (glm::dot(open.direction, point.geometricNormal) <= 0) return open; // below the surface itself
    reference::Ray ray{ .origin = point.position + point.geometricNormal * point.selfAvoidance,
                        .direction = open.direction,
                        .farthest = reach.occlusion };
    const auto passed = [&] { return ++rays, luminanceOf(scene.transmittance(ray, false)); };
    ++rays;
    const std::optional<reference::Hit> hit = scene.nearest(ray);
    if (!hit) {
        open.share = 1;
        return open;
    }
    open.share = passed();
    reference::Part const& part = scene.part(*hit);
    if (!part.material->doubleSided && glm::dot(faceNormal(part, hit->point.triangle), open.direction) > 0) {
        open.hidden = 1;
    } else if (hit->distance < reach.cover) {
        ray.farthest = std::min(reach.occlusion, reach.cover);
        open.hidden = 1 - passed();
    }
    return open;
}

} // namespace

TexelPasses passesOf(LightSettings const& settings) {
    const uint32_t perPass = settings.relativeError > 0
                                     ? std::clamp(settings.samplesPerTexel / 256, 1u, kMostPerPass)
                                     : std::clamp(settings.samplesPerTexel / kLeastPasses, 1u, kMostPerPass);
    return { std::max((settings.samplesPerTexel + perPass - 1) / perPass, kLeastPasses), perPass };
}

TexelLight lightOf(reference::PathTracer const& tracer, double3 origin, SurfacePoint const& point, uint64_t stream,
                   LightSettings const& settings) {
    const reference::ReceivingPoint receiver = receiverAt(point, origin);
    const reference::LampLight lamps = settings.directLight ? reference::LampLight::Direct : reference::LampLight::None;
    const TexelPasses passes = passesOf(settings);
    TexelLight light;
    Sums sums;
    uint64_t rays = 0, open = 0, backs = 0;
    while (sums.passes < passes.count && !isDone(sums, settings)) {
        double3 sum(0.0);
        const uint64_t pass = reference::hashOf(stream, sums.passes);
        for (uint32_t i = 0; i < passes.samples; ++i) {
            const reference::Arriving arriving = tracer.arriving(receiver, lamps, { pass, i }, rays);
            sum += arriving.irradiance;
            open += arriving.fromSky;
            backs += arriving.fromBehind || arriving.meters < point.coverMeters;
        }
        sums.add(sum / double(passes.samples));
    }
    // What glows is not exposed: in lux it is what the exposure makes of it.
    const double exposure = double(settings.exposure.factor());
    light.samples = sums.passes * passes.samples;
    light.irradiance = sums.mean() / exposure;
    light.standardError = sums.standardError() / exposure;
    light.openness = double(open) / light.samples;
    light.backs = double(backs) / light.samples;
    light.rays = static_cast<uint32_t>(std::min<uint64_t>(rays, ~0u));
    return light;
}

TexelLight occlusionOf(reference::TracedScene const& scene, SurfacePoint const& point, uint64_t stream,
                       LightSettings const& settings) {
    const reference::ReceivingPoint receiver = receiverAt(point, scene.origin());
    const TexelPasses passes = passesOf(settings);
    const Reach reach{ *settings.occlusionMeters, point.coverMeters };
    TexelLight light;
    Sums sums;
    uint64_t rays = 0;
    while (sums.passes < passes.count && !isDone(sums, settings)) {
        double sum = 0;
        const uint64_t pass = reference::hashOf(stream, sums.passes);
        for (uint32_t i = 0; i < passes.samples; ++i) {
            const OpenRay open = openRay(scene, receiver, reach, reference::SampleStream(pass, i).pair(0), rays);
            sum += open.share;
            light.open += open.direction * open.share;
            light.backs += open.hidden;
        }
        sums.add(double3(sum / double(passes.samples)));
    }
    light.samples = sums.passes * passes.samples;
    light.irradiance = sums.mean();
    light.standardError = sums.standardError();
    light.open /= double(light.samples);
    light.openness = light.irradiance.x;
    light.backs /= double(light.samples);
    light.rays = static_cast<uint32_t>(std::min<uint64_t>(rays, ~0u));
    return light;
}

void bakeTexels(reference::TracedScene const& scene, std::span<const BakeSurface> surfaces, Atlas const& atlas,
                std::span<const AtlasTexel> texels, LightSettings const& settings, jobs::JobSystem& jobs,
                std::function<bool(size_t first, std::span<const TexelLight> lights)> const& finished) {
    const reference::ReferenceSettings tracing = tracerSettings(settings);
    const reference::PathTracer tracer(scene, tracing, double(settings.exposure.factor()), double3(0.0));
    std::vector<TexelLight> lights;
    for (size_t first = 0; first < texels.size(); first += kBatch) {
        lights.assign(std::min(kBatch, texels.size() - first), {});
        jobs::parallelFor<"bake">(jobs, lights.size(), 8, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                AtlasTexel const& texel = texels[first + i];
                const uint64_t place = (uint64_t(texel.y) << 32) | texel.x;
                const uint64_t stream = reference::hashOf(reference::mixBits(settings.seed), place);
                AtlasChart const& chart = atlas.charts[texel.chart];
                SurfacePoint point = pointOf(surfaces[chart.surface], texel);
                point.coverMeters = kCover / (atlas.texelsPerMeter * chart.scale);
                lights[i] = settings.occlusionMeters ? occlusionOf(scene, point, stream, settings)
                                                     : lightOf(tracer, scene.origin(), point, stream, settings);
            }
        });
        if (!finished(first, lights)) return;
    }
}

} // namespace filament_core::bake
