// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/IrradianceBake.h"

#include "base/math/IrradianceSh.h"
#include "filament_core/scene/SampleGrid.h"
#include "tools/bake/GridTrace.h"

#include <algorithm>
#include <cmath>

namespace filament_core::bake {
namespace {

using reference::TracedScene;

constexpr double kFarthestCenter = 1e12; // metres

double luminanceOf(float3 color) { return double{ glm::dot(color, float3(0.2126f, 0.7152f, 0.0722f)) }; }

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

/// A grid of the traced records.
class GridJudge {
public:
    GridJudge(TracedScene const& scene, GridSettings const& settings, GridTrace const& trace,
              std::span<const std::byte> records)
            : mScene(scene), mSettings(settings), mTrace(trace), mRecords(records), mHeldOut(trace.heldOut(records)) {}

    BakedGrid grid(size_t index) {
        const auto probes = std::make_shared<IrradianceProbes>();
        probes->count = mTrace.countOf(index);
        probes->depthSize = mSettings.probes.depthSize;
        BakedGrid baked;
        for (TracedProbe const& probe : mTrace.probesOf(index, mRecords)) {
            probes->probes.push_back(probe.probe);
            probes->depths.insert(probes->depths.end(), probe.depths.begin(), probe.depths.end());
            mRays += probe.rays;
        }
        baked.grid = mSettings.box;
        baked.grid.probes = probes;
        // What is compared is what the file holds.
        baked.grid = *readIrradianceGrid(writeIrradianceGrid(baked.grid));
        judge(baked);
        return baked;
    }

    /// The rest of the report, of the last one.
    void finish(BakedGrid& baked, size_t index) {
        baked.report.rounds = static_cast<uint32_t>(index + 1);
        const std::vector<HeldOutProbe> judging = mTrace.judging(mRecords);
        judgeLast(baked, judging);
        baked.report.rays = mRays;
        for (HeldOutProbe const& point : mHeldOut) baked.report.rays += point.rays;
        for (HeldOutProbe const& point : judging) baked.report.rays += point.rays;
        if (mSettings.leakPointsPerSide > 0)
            baked.report.leaks = findLeaks(scene::gridRecord(baked.grid), mSettings.leakPointsPerSide,
                                           [&](double3 from, double3 to) { return isBlocked(mScene, from, to); });
    }

private:
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
        for (HeldOutProbe const& point : mHeldOut) {
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
    static Lights lightsAt(scene::GridRecord const& grid, HeldOutProbe const& point) {
        // the grid's light is along the axes of the world
        return { facingAxes(rotateIrradianceSh(point.traced.irradianceSh, grid.worldFromBox)),
                 facingAxes(scene::sampleGrid(grid, point.local).light) };
    }

    static void judgeLast(BakedGrid& baked, std::vector<HeldOutProbe> const& points) {
        const scene::GridRecord grid = scene::gridRecord(baked.grid);
        const double noise = 2 * baked.report.standardError * baked.report.mean;
        GridJudgement& judgement = baked.report.judgement;
        std::vector<double> beyond;
        double squares = 0;
        for (HeldOutProbe const& point : points) {
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
    GridTrace const& mTrace;
    std::span<const std::byte> mRecords;
    std::vector<HeldOutProbe> mHeldOut;
    uint64_t mRays = 0;
};

} // namespace

Result<void> checkGridSettings(GridSettings const& settings) {
    const auto isIn = [](double value, double least, double most) { return value >= least && value <= most; };
    const auto invalid = [](std::string_view what) -> Result<void> {
        return fail(ErrorCode::InvalidArgument, "irradiance grid: {}", what);
    };
    float3 const& half = settings.box.halfExtentMeters;
    for (int axis = 0; axis < 3; ++axis)
        if (!(half[axis] > 0 && half[axis] <= 1e9f)) return invalid("half a side of its box is not in (0, 1e9] metres");
    for (int axis = 0; axis < 3; ++axis) // Embree stops the program at rays that begin beyond 1.8e18
        if (!isIn(std::abs(settings.box.centerWorld[axis]), 0, kFarthestCenter))
            return invalid("the middle of its box is not within 1e12 metres");
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
    IrradianceGridDesc box = settings.box; // what the file could not hold is refused before it is traced
    auto probe = std::make_shared<IrradianceProbes>();
    probe->count = uint3(1);
    probe->probes.resize(1);
    box.probes = probe;
    if (const auto read = readIrradianceGrid(writeIrradianceGrid(box)); !read) return read.error();
    return {};
}

Result<BakedGrid> bakeIrradianceGrid(TracedScene const& scene, GridSettings const& settings, jobs::JobSystem& jobs) {
    if (const Result<void> valid = checkGridSettings(settings); !valid) return valid.error();
    const GridTrace trace(scene, settings);
    std::vector<std::byte> records;
    for (size_t grid = 0;; ++grid) {
        trace.trace(records.size() / trace.recordBytes(), trace.endOfGrid(grid), jobs,
                    [&](std::span<const std::byte> batch) {
                        records.insert(records.end(), batch.begin(), batch.end());
                        return true;
                    });
        if (std::optional<BakedGrid> baked = gridOfRecords(scene, settings, records)) return *std::move(baked);
    }
}

std::optional<BakedGrid> gridOfRecords(TracedScene const& scene, GridSettings const& settings,
                                       std::span<const std::byte> records) {
    const GridTrace trace(scene, settings);
    const size_t count = records.size() / trace.recordBytes();
    if (count < trace.endOfGrid(0)) return std::nullopt;
    GridJudge judge(scene, settings, trace, records);
    for (size_t grid = 0; grid < trace.grids() && count >= trace.endOfGrid(grid); ++grid) {
        BakedGrid baked = judge.grid(grid);
        if (!baked.report.isWithinBound && grid + 1 < trace.grids()) continue;
        judge.finish(baked, grid);
        return baked;
    }
    return std::nullopt;
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
