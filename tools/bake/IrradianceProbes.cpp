// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/IrradianceProbes.h"

#include "filament_core/scene/SampleGrid.h"
#include "tools/reference/PathTracer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace filament_core::bake {
namespace {

using namespace reference;

constexpr uint32_t kFirstDirection = 1000, kSkyDirection = 1001; // dimensions that paths do not use
constexpr double kInsideShare = 0.25;
constexpr uint64_t kDepthStream = 0x6465707468; // other numbers than those of the paths

double3 onSphere(double2 u) {
    const double z = 1 - 2 * u.x, side = std::sqrt(std::max(0.0, 1 - z * z)), turn = 2 * std::numbers::pi * u.y;
    return { side * std::cos(turn), side * std::sin(turn), z };
}

/// The basis of IrradianceProbe::irradianceSh, times what makes the mean over the sphere a coefficient: 4 K^2 A,
/// K the normalisation of the function and A that of the cosine's band (pi, 2 pi / 3, pi / 4).
std::array<double, 9> projection(double3 n) {
    return { 1,
             2 * n.y,
             2 * n.z,
             2 * n.x,
             15.0 / 4 * n.x * n.y,
             15.0 / 4 * n.y * n.z,
             5.0 / 16 * (3 * n.z * n.z - 1),
             15.0 / 4 * n.z * n.x,
             15.0 / 16 * (n.x * n.x - n.y * n.y) };
}

bool showsBack(TracedScene const& scene, Hit const& hit, double3 direction) {
    Part const& part = scene.part(hit);
    return !part.material->doubleSided && glm::dot(faceNormal(part, hit.point.triangle), direction) > 0;
}

class ProbeTrace {
public:
    ProbeTrace(TracedScene const& scene, double3 place, uint64_t stream, float3x3 const& worldFromBox,
               ProbeSettings const& settings)
            : mScene(scene), mOrigin(place - scene.origin()), mStream(hashOf(settings.seed, stream)),
              mWorldFromBox(worldFromBox), mSettings(settings) {}

    TracedProbe run() {
        traceLight();
        if (mSettings.depthSize > 0) traceDepths();
        return std::move(mResult);
    }

private:
    void traceLight() {
        ReferenceSettings paths;
        paths.maxBounces = mSettings.maxBounces;
        const PathTracer tracer(mScene, paths, mSettings.exposure, double3(0.0));
        const uint32_t each = (mSettings.rays + kProbePasses - 1) / kProbePasses;
        std::array<double3, 9> sum{};
        std::array<double3, 9> sky{};
        std::array<double, 9> bases{};
        double3 surfaces(0.0);
        double luminances = 0, squares = 0;
        uint32_t backs = 0;
        for (uint32_t pass = 0; pass < kProbePasses; ++pass) {
            double3 light(0.0);
            for (uint32_t i = 0; i < each; ++i) {
                const SampleStream numbers(hashOf(mStream, pass), i);
                const double3 local = onSphere(numbers.pair(kFirstDirection));
                const Ray ray{ .origin = mOrigin, .direction = mWorldFromBox * local };
                const double3 radiance = radianceAlong(tracer, ray, numbers, backs);
                const std::array<double, 9> factors = projection(local);
                for (size_t k = 0; k < sum.size(); ++k) {
                    sum[k] += radiance * factors[k];
                    bases[k] += factors[k];
                }
                surfaces += radiance;
                light += radiance + addSky(numbers, sky);
            }
            const double mean = glm::dot(light, double3(0.2126, 0.7152, 0.0722)) / each;
            luminances += mean;
            squares += mean * mean;
        }
        const double all = double{ kProbePasses } * each;
        // The mean is a control variate of the other coefficients: their basis functions have none over the sphere, but
        // have one over these directions.
        const double3 mean = surfaces / all;
        for (size_t k = 0; k < sum.size(); ++k) {
            const double3 rest = k == 0 ? sum[k] : sum[k] - mean * bases[k];
            mResult.probe.irradianceSh[k] = float3((rest + sky[k]) / all);
        }
        const double variance = std::max(0.0, squares - luminances * luminances / kProbePasses) / (kProbePasses - 1);
        mResult.probe.standardError = static_cast<float>(std::sqrt(variance / kProbePasses));
        mResult.probe.isInside = backs > kInsideShare * all;
    }

    /// Of surfaces. Lamps and the discs of suns are not seen: the engine lights surfaces by them itself.
    double3 radianceAlong(PathTracer const& tracer, Ray const& ray, SampleStream const& numbers, uint32_t& backs) {
        ++mResult.rays;
        const std::optional<Hit> hit = mScene.nearest(ray);
        if (!hit) return double3(0.0);
        backs += showsBack(mScene, *hit, ray.direction) ? 1 : 0;
        const double3 radiance = tracer.radiance(ray, numbers, mResult.rays) / mSettings.exposure;
        const bool isFinite = std::isfinite(radiance.x) && std::isfinite(radiance.y) && std::isfinite(radiance.z);
        return isFinite ? radiance : double3(0.0);
    }

    /// The environment where nothing hides it, sampled by its radiance: a sun in it has a few texels. Returns what it
    /// adds to the mean over the sphere.
    double3 addSky(SampleStream const& numbers, std::array<double3, 9>& sky) {
        EnvironmentLight const& environment = mScene.environment();
        if (environment.isBlack()) return double3(0.0);
        const EnvironmentSample sample = environment.sample(numbers.pair(kSkyDirection));
        if (!(sample.pdf > 0)) return double3(0.0);
        ++mResult.rays;
        if (mScene.nearest({ .origin = mOrigin, .direction = sample.direction })) return double3(0.0);
        const double3 light = sample.radiance / (sample.pdf * 4 * std::numbers::pi);
        const std::array<double, 9> factors = projection(glm::transpose(mWorldFromBox) * sample.direction);
        for (size_t k = 0; k < sky.size(); ++k) sky[k] += light * factors[k];
        return light;
    }

    void traceDepths() {
        const uint32_t size = mSettings.depthSize;
        mResult.depths.reserve(size_t{ size } * size);
        for (uint32_t y = 0; y < size; ++y) {
            for (uint32_t x = 0; x < size; ++x) {
                double mean = 0, squares = 0;
                for (uint32_t i = 0; i < mSettings.depthRays; ++i) {
                    const SampleStream numbers(hashOf(mStream ^ kDepthStream, y * size + x), i);
                    const float2 place = float2(double2(x, y) + numbers.pair(0));
                    const double3 local(scene::octahedralDirection(place, size));
                    const Ray ray{ .origin = mOrigin,
                                   .direction = glm::normalize(mWorldFromBox * local),
                                   .farthest = mSettings.farthestMeters };
                    ++mResult.rays;
                    const std::optional<Hit> hit = mScene.nearest(ray);
                    const double distance = hit ? hit->distance : mSettings.farthestMeters;
                    mean += distance;
                    squares += distance * distance;
                }
                mResult.depths.emplace_back(double2(mean, squares) / static_cast<double>(mSettings.depthRays));
            }
        }
    }

    TracedScene const& mScene;
    double3 mOrigin;
    uint64_t mStream;
    double3x3 mWorldFromBox;
    ProbeSettings const& mSettings;
    TracedProbe mResult{};
};

} // namespace

TracedProbe traceProbe(TracedScene const& scene, double3 place, uint64_t stream, float3x3 const& worldFromBox,
                       ProbeSettings const& settings) {
    return ProbeTrace(scene, place, stream, worldFromBox, settings).run();
}

bool isBlocked(TracedScene const& scene, double3 from, double3 to) {
    const double3 way = to - from;
    const double length = glm::length(way);
    if (length <= 0) return false;
    return scene
            .nearest({ .origin = from - scene.origin(),
                       .direction = way / length,
                       .nearest = length * 0.001,
                       .farthest = length * 0.999 })
            .has_value();
}

} // namespace filament_core::bake
