// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/IrradianceBake.h"

#include "base/math/IrradianceSh.h"
#include "filament_core/scene/SampleGrid.h"
#include "tools/reference/SampleStream.h"

#include <algorithm>
#include <cmath>

namespace filament_core::bake {
namespace {

using reference::TracedScene;

constexpr uint64_t kHeldOutStream = uint64_t{ 1 } << 40; // beyond the numbers of probes
constexpr uint64_t kJudgeStream = uint64_t{ 1 } << 41;

double luminanceOf(float3 color) { return double{ glm::dot(color, float3(0.2126f, 0.7152f, 0.0722f)) }; }

std::optional<Error> faultOfSettings(GridSettings const& settings) {
    const auto isIn = [](double value, double least, double most) { return value >= least && value <= most; };
    const auto invalid = [](std::string_view what) {
        return fail(ErrorCode::InvalidArgument, "irradiance grid: {}", what);
    };
    float3 const& half = settings.box.halfExtentMeters;
    for (int axis = 0; axis < 3; ++axis)
        if (!(half[axis] > 0 && half[axis] <= 1e9f)) return invalid("half a side of its box is not in (0, 1e9] metres");
    if (!(settings.spacingMeters > 0 && settings.spacingMeters <= 1e6f))
        return invalid("its spacing is not in (0, 1e6]");
    if (!isIn(settings.maxProbes, 1, IrradianceProbes::kMaxProbes)) return invalid("maxProbes is not in [1, 2^20]");
    if (!isIn(settings.maxError, 0, 1e6)) return invalid("maxError is not in [0, 1e6]");
    if (!isIn(settings.heldOutPoints, 1, 65536)) return invalid("heldOutPoints is not in [1, 65536]");
    if (!isIn(settings.judgedPoints, 0, 65536)) return invalid("judgedPoints is not in [0, 65536]");
    if (!isIn(settings.probes.rays, 1, 1u << 24)) return invalid("the paths of a probe are not in [1, 2^24]");
    if (!isIn(settings.probes.depthSize, 0, IrradianceProbes::kMaxDepthSize)) return invalid("depthSize is above 32");
    if (!isIn(settings.probes.depthRays, 1, 65536)) return invalid("depthRays is not in [1, 65536]");
    if (!isIn(settings.leakPointsPerSide, 0, 16)) return invalid("leakPointsPerSide is not in [0, 16]");
    return std::nullopt;
}

uint64_t numberOf(uint3 count) { return uint64_t{ count.x } * count.y * count.z; }

/// As coarse as asked for, or as the budget allows.
uint3 firstCount(GridSettings const& settings) {
    uint3 count(2);
    for (int axis = 0; axis < 3; ++axis) {
        const float cells = std::ceil(2 * settings.box.halfExtentMeters[axis] / settings.spacingMeters);
        count[axis] = static_cast<uint32_t>(std::clamp(cells, 1.0f, 65535.0f)) + 1;
    }
    while (numberOf(count) > settings.maxProbes) {
        int longest = 0;
        for (int axis = 1; axis < 3; ++axis)
            if (count[axis] > count[longest]) longest = axis;
        count[longest] = count[longest] / 2;
    }
    return count;
}

/// Halves the longest spacing: the probes of before stay where they are.
uint3 finerCount(uint3 count, float3 half) {
    int longest = 0;
    const auto spacing = [&](int axis) { return half[axis] / static_cast<float>(std::max(count[axis], 2u) - 1); };
    for (int axis = 1; axis < 3; ++axis)
        if (spacing(axis) > spacing(longest)) longest = axis;
    count[longest] = count[longest] == 1 ? 2 : 2 * count[longest] - 1;
    return count;
}

struct HeldOut {
    float3 local{ 0.0f };
    IrradianceProbe traced{};
};

/// The luminance of irradiance / pi of surfaces that face along the six directions of the axes.
std::array<double, 6> facingAxes(scene::IrradianceSh const& light) {
    std::array<double, 6> values{};
    for (size_t i = 0; i < 2; ++i) {
        const float side = i == 0 ? -1.0f : 1.0f;
        values[i] = luminanceOf(light[0] + side * light[3] + light[8] - light[6]);
        values[2 + i] = luminanceOf(light[0] + side * light[1] - light[8] - light[6]);
        values[4 + i] = luminanceOf(light[0] + side * light[2] + 2.0f * light[6]);
    }
    return values;
}

class GridBaker {
public:
    GridBaker(TracedScene const& scene, GridSettings const& settings, jobs::JobSystem& jobs)
            : mScene(scene), mSettings(settings), mJobs(jobs) {}

    BakedGrid run() {
        mHeldOut = traceHeldOut(mSettings.heldOutPoints, kHeldOutStream);
        uint3 count = firstCount(mSettings);
        BakedGrid baked = bake(count);
        uint32_t rounds = 1;
        while (!baked.report.isWithinBound) {
            count = finerCount(count, mSettings.box.halfExtentMeters);
            if (numberOf(count) > mSettings.maxProbes) break;
            baked = bake(count);
            ++rounds;
        }
        baked.report.rounds = rounds;
        judgeLast(baked, traceHeldOut(mSettings.judgedPoints, kJudgeStream));
        baked.report.rays = mRays;
        if (mSettings.leakPointsPerSide > 0)
            baked.report.leaks = findLeaks(scene::gridRecord(baked.grid), mSettings.leakPointsPerSide,
                                           [&](double3 from, double3 to) { return isBlocked(mScene, from, to); });
        return baked;
    }

private:
    double3 inWorld(float3 local) const {
        return mSettings.box.centerWorld + double3(mSettings.box.worldFromBox * local);
    }

    std::vector<HeldOut> traceHeldOut(uint32_t count, uint64_t stream) {
        std::vector<HeldOut> points(count);
        ProbeSettings settings = mSettings.probes;
        settings.depthSize = 0;
        std::vector<uint64_t> rays(points.size());
        jobs::parallelFor<"held-out points">(mJobs, points.size(), 1, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                const reference::SampleStream numbers(reference::hashOf(settings.seed, stream),
                                                      static_cast<uint32_t>(i));
                const double3 u(numbers.pair(0), numbers.pair(1).x);
                points[i].local = float3(2.0 * u - 1.0) * mSettings.box.halfExtentMeters;
                TracedProbe traced = traceProbe(mScene, inWorld(points[i].local), stream + 1 + i,
                                                mSettings.box.worldFromBox, settings);
                points[i].traced = traced.probe;
                rays[i] = traced.rays;
            }
        });
        for (const uint64_t each : rays) mRays += each;
        return points;
    }

    BakedGrid bake(uint3 count) {
        const auto probes = std::make_shared<IrradianceProbes>();
        probes->count = count;
        probes->depthSize = mSettings.probes.depthSize;
        BakedGrid baked;
        baked.grid = mSettings.box;
        baked.grid.probes = probes;
        scene::GridRecord places;
        places.halfExtent = mSettings.box.halfExtentMeters;
        places.probes = probes;
        ProbeSettings settings = mSettings.probes;
        settings.farthestMeters = 1.5 * double{ glm::length(scene::spacingOf(places)) };
        const size_t all = numberOf(count);
        std::vector<TracedProbe> traced(all);
        jobs::parallelFor<"irradiance probes">(mJobs, all, 1, [&](size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) {
                const uint3 at(i % count.x, i / count.x % count.y, i / count.x / count.y);
                traced[i] = traceProbe(mScene, inWorld(scene::placeOf(places, at)), i, mSettings.box.worldFromBox,
                                       settings);
            }
        });
        for (TracedProbe const& probe : traced) {
            probes->probes.push_back(probe.probe);
            probes->depths.insert(probes->depths.end(), probe.depths.begin(), probe.depths.end());
            mRays += probe.rays;
        }
        // What is compared is what the file holds.
        baked.grid = *readIrradianceGrid(writeIrradianceGrid(baked.grid));
        judge(baked);
        return baked;
    }

    void judge(BakedGrid& baked) const {
        GridReport& report = baked.report;
        double squares = 0, mean = 0;
        for (IrradianceProbe const& probe : baked.grid.probes->probes) {
            report.inside += probe.isInside ? 1 : 0;
            if (probe.isInside) continue;
            squares += double{ probe.standardError } * double{ probe.standardError };
            mean += luminanceOf(probe.irradianceSh[0]);
        }
        const double lit = std::max<double>(1, static_cast<double>(baked.grid.probes->probes.size()) - report.inside);
        const double noise = squares / lit;
        report.mean = mean / lit;
        report.standardError = mean > 0 ? std::sqrt(noise) / (mean / lit) : 0;
        compareHeldOut(scene::gridRecord(baked.grid), noise, report);
        report.isWithinBound = report.heldOutPoints > 0 && report.heldOutError <= double{ mSettings.maxError };
    }

    /// Along the six directions of the axes: what surfaces that face them would have.
    void compareHeldOut(scene::GridRecord const& grid, double noiseOfProbes, GridReport& report) const {
        double differences = 0, values = 0, noise = 0;
        for (HeldOut const& point : mHeldOut) {
            if (point.traced.isInside) continue;
            ++report.heldOutPoints;
            const auto [traced, given] = lightsAt(grid, point);
            for (size_t i = 0; i < traced.size(); ++i) {
                differences += (given[i] - traced[i]) * (given[i] - traced[i]);
                values += traced[i] * traced[i];
            }
            noise += 6 * (double{ point.traced.standardError } * double{ point.traced.standardError } + noiseOfProbes);
        }
        if (values <= 0) return;
        report.heldOutError = std::sqrt(std::max(0.0, differences - noise) / values);
        report.heldOutNoise = std::sqrt(noise / values);
    }

    struct Lights {
        std::array<double, 6> traced{}, given{};
    };
    static Lights lightsAt(scene::GridRecord const& grid, HeldOut const& point) {
        // the grid's light is along the axes of the world
        return { facingAxes(rotateIrradianceSh(point.traced.irradianceSh, grid.worldFromBox)),
                 facingAxes(scene::sampleGrid(grid, point.local).light) };
    }

    static void judgeLast(BakedGrid& baked, std::vector<HeldOut> const& points) {
        const scene::GridRecord grid = scene::gridRecord(baked.grid);
        const double noise = 2 * baked.report.standardError * baked.report.mean;
        GridJudgement& judgement = baked.report.judgement;
        std::vector<double> beyond;
        double squares = 0;
        for (HeldOut const& point : points) {
            if (point.traced.isInside) {
                ++judgement.inside;
                continue;
            }
            const auto [traced, given] = lightsAt(grid, point);
            if (traced == Lights{}.traced && given == Lights{}.given) {
                ++judgement.dark;
                continue;
            }
            double error = 0;
            for (size_t i = 0; i < traced.size(); ++i) error = std::max(error, std::abs(given[i] - traced[i]));
            beyond.push_back(std::max(0.0, error - noise));
            squares += error * error;
            if (error > judgement.worst) judgement.worst = error, judgement.worstPlace = point.local;
        }
        judgement.points = static_cast<uint32_t>(beyond.size());
        if (judgement.points > 0) judgement.rms = std::sqrt(squares / judgement.points);
        judgement.interpolation = toleranceBound(std::move(beyond));
    }

    TracedScene const& mScene;
    GridSettings const& mSettings;
    jobs::JobSystem& mJobs;
    std::vector<HeldOut> mHeldOut;
    uint64_t mRays = 0;
};

} // namespace

Result<BakedGrid> bakeIrradianceGrid(TracedScene const& scene, GridSettings const& settings, jobs::JobSystem& jobs) {
    if (auto fault = faultOfSettings(settings)) return *std::move(fault);
    return GridBaker(scene, settings, jobs).run();
}

std::string describe(BakedGrid const& baked) {
    GridReport const& report = baked.report;
    const uint3 count = baked.grid.probes->count;
    float worst = 0;
    for (Leak const& leak : report.leaks.found) worst = std::max(worst, leak.share);
    GridJudgement const& judgement = report.judgement;
    const std::string bound =
            judgement.interpolation
                    ? fmt::format("at {:.0f} % of the lit places no further off than two standard errors and {:.3g} "
                                  "candela / m2, judged by {} others\n",
                                  kBoundShare * 100, *judgement.interpolation, judgement.points)
                    : std::string();
    return fmt::format("{} x {} x {} probes, {} of them inside of geometry; standard error {:.2f} % of {:.4g} candela "
                       "/ m2\n"
                       "{:.1f} % off at {} held-out points (noise {:.1f} %) after {} grids: {}\n"
                       "{}"
                       "{} leaks through walls at {} points; the largest is {:.0f} % of a point's light\n",
                       count.x, count.y, count.z, report.inside, 100 * report.standardError, report.mean,
                       100 * report.heldOutError, report.heldOutPoints, 100 * report.heldOutNoise, report.rounds,
                       report.isWithinBound ? "within the bound" : "the budget of probes is spent", bound,
                       report.leaks.found.size(), report.leaks.points, 100 * worst);
}

} // namespace filament_core::bake
