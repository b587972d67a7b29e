// SPDX-License-Identifier: Apache-2.0
// takeSun(): cells of the sphere with much light -> peaks -> where the light of a peak ends -> the sky without it.
#include "filament_core/assets/environment/IblDirections.h"
#include "filament_core/assets/environment/SkyLights.h"

#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

namespace filament_core::assets {
namespace {

using std::numbers::pi;

constexpr double kRadiansOfDegree = pi / 180;
constexpr uint32_t kCellsPerSide = 16, kCells = 6 * kCellsPerSide * kCellsPerSide; // 5.6 degrees
constexpr size_t kChunks = 64;                                                     // of rows
constexpr size_t kCandidates = 12;
constexpr double kEndOfLight = 0.007;                      // of the light: what the ring around it may add
constexpr double kContrast = 0.25;                         // of the ring's radiance to that inside
constexpr double kRingPixels = 1.25, kRingOfRadius = 0.25; // width
constexpr size_t kSectors = 32;

/// Light above the bright part, and where it is brightest.
struct Cell {
    double light = 0, peak = 0;
    size_t index = 0;
};

size_t cellOf(double3 direction) {
    const CubePoint point = cubeFromDirection(float3(direction));
    const auto place = [](float c) {
        return std::min(static_cast<uint32_t>(std::max((c * 0.5f + 0.5f) * kCellsPerSide, 0.0f)), kCellsPerSide - 1);
    };
    return (size_t{ point.face } * kCellsPerSide + place(point.t)) * kCellsPerSide + place(point.s);
}

std::vector<Cell> cellsOf(SkyGrid const& sky, double bright, jobs::JobSystem& jobs) {
    std::vector<std::vector<Cell>> chunks(kChunks);
    jobs::parallelFor<"sky cells">(jobs, kChunks, 1, [&](size_t begin, size_t end) {
        for (size_t chunk = begin; chunk < end; ++chunk) {
            std::vector<Cell>& cells = chunks[chunk];
            cells.resize(kCells);
            const size_t first = chunk * sky.rows() / kChunks, last = (chunk + 1) * sky.rows() / kChunks;
            for (size_t i = first * sky.columns(); i < last * sky.columns(); ++i) {
                const double luminance = skyLuminance(sky.pixel(i));
                if (luminance <= bright) continue;
                Cell& cell = cells[cellOf(sky.direction(i))];
                cell.light += (luminance - bright) * sky.solidAngle(i);
                if (luminance > cell.peak) cell.peak = luminance, cell.index = i;
            }
        }
    });
    std::vector<Cell> sum(kCells);
    for (std::vector<Cell> const& cells : chunks) {
        for (size_t i = 0; i < kCells; ++i) {
            sum[i].light += cells[i].light;
            if (cells[i].peak > sum[i].peak) sum[i].peak = cells[i].peak, sum[i].index = cells[i].index;
        }
    }
    std::stable_sort(sum.begin(), sum.end(), [](Cell const& a, Cell const& b) { return a.light > b.light; });
    sum.resize(std::min(kCandidates, sum.size()));
    std::erase_if(sum, [](Cell const& cell) { return cell.light <= 0; });
    return sum;
}

/// From the brightest pixel of a cell to the centre of the light around it.
double3 centreOf(SkyGrid const& sky, Cell const& cell) {
    double3 centre = sky.direction(cell.index);
    const double radius = std::max(1.5 * kRadiansOfDegree, 2 * sky.pixelSize(centre)), least = 0.05 * cell.peak;
    for (int step = 0; step < 8; ++step) {
        double3 moment(0.0);
        sky.forCap(centre, radius, [&](size_t index, double3 direction, double solidAngle) {
            moment += direction * (std::max(skyLuminance(sky.pixel(index)) - least, 0.0) * solidAngle);
        });
        const double length = glm::length(moment);
        if (length <= 0) break;
        const double3 next = moment / length, move = next - centre;
        centre = next;
        if (glm::dot(move, move) < 1e-12) break;
    }
    return centre;
}

/// Sums over caps of growing radius around a centre.
class RadialProfile {
public:
    RadialProfile(SkyGrid const& sky, double3 centre, double radius, double step)
            : mStep(step), mSums(static_cast<size_t>(radius / step) + 2) {
        sky.forCap(centre, radius, [&](size_t index, double3 direction, double solidAngle) {
            const double3 away = direction - centre;
            const double squared = glm::dot(away, away);
            const double light = skyLuminance(sky.pixel(index)) * solidAngle;
            // A pixel counts from the first radius beyond its centre.
            const auto bin = static_cast<size_t>(2 * elementary::asin(std::sqrt(squared) / 2) / mStep) + 1;
            mSums[std::min(bin, mSums.size() - 1)] += double3(light, solidAngle, light * squared);
        });
        for (size_t i = 1; i < mSums.size(); ++i) mSums[i] += mSums[i - 1];
    }

    /// Light, solid angle, light times squared distance within the radius.
    double3 within(double radius) const {
        return mSums[std::min(static_cast<size_t>(radius / mStep + 0.5), mSums.size() - 1)];
    }
    /// Mean radiance between two radii.
    double mean(double inner, double outer) const {
        const double3 ring = within(outer) - within(inner);
        return ring.y > 0 ? ring.x / ring.y : 0;
    }

private:
    double mStep;
    std::vector<double3> mSums;
};

double outerRadius(double radius, double pixel) {
    return radius + std::max(kRingPixels * pixel, kRingOfRadius * radius);
}

struct Peak {
    double3 centre{ 0, 1, 0 };
    double radius = 0;        ///< where its light ends
    double light = 0;         ///< luminous illuminance above the sky around it
    double squaredSpread = 0; ///< mean squared distance of its light from the centre
    bool isCompact = false;   ///< no wider than a sun
};

Peak peakOf(SkyGrid const& sky, Cell const& cell) {
    Peak peak{ .centre = centreOf(sky, cell) };
    const double pixel = sky.pixelSize(peak.centre), widest = std::max(6 * kRadiansOfDegree, 4 * pixel);
    const double farthest = outerRadius(outerRadius(widest, pixel), pixel);
    const RadialProfile profile(sky, peak.centre, std::min(farthest, pi), std::max(pixel / 8, 0.02 * kRadiansOfDegree));
    for (peak.radius = pixel; peak.radius < widest; peak.radius += pixel / 4) {
        const double ringEnd = outerRadius(peak.radius, pixel), nextEnd = outerRadius(ringEnd, pixel);
        const double ring = profile.mean(peak.radius, ringEnd), next = profile.mean(ringEnd, nextEnd);
        const double3 inside = profile.within(peak.radius);
        peak.light = inside.x - ring * inside.y;
        const double ringLight = (ring - next) * (profile.within(ringEnd).y - inside.y);
        if (ring * inside.y < kContrast * inside.x && ringLight <= kEndOfLight * peak.light) break;
    }
    if (peak.radius < widest) peak.radius += pixel / 2; // pixels at the edge
    const double3 inside = profile.within(peak.radius);
    const double around = profile.mean(peak.radius, outerRadius(peak.radius, pixel));
    peak.light = std::max(inside.x - around * inside.y, 0.0);
    const double flat = around * inside.y * peak.radius * peak.radius / 2; // of the sky around it, within the radius
    peak.squaredSpread = peak.light > 0 ? std::max(inside.z - flat, 0.0) / peak.light : 0;
    const double size = std::sqrt(2 * std::max(0.0, peak.squaredSpread - pixel * pixel / 2));
    peak.isCompact = peak.radius < widest && size <= double{ EnvironmentLights::kWidestSunDegrees } * kRadiansOfDegree;
    return peak;
}

/// The sky behind a cap, from the ring around it: mean radiances of sectors, between which Poisson's integral for the
/// disc (Evans 2010, "Partial Differential Equations", section 2.2.4, eq. 45) is the smoothest surface, the harmonic
/// one.
class SkyBehind {
public:
    SkyBehind(SkyGrid const& sky, Peak const& peak) : mCentre(peak.centre), mRadius(peak.radius) {
        const double3 side = std::abs(mCentre.y) < 0.9 ? double3(0, 1, 0) : double3(1, 0, 0);
        mX = glm::normalize(glm::cross(side, mCentre));
        mY = glm::cross(mCentre, mX);
        std::array<double, kSectors> weights{};
        const double outer = outerRadius(mRadius, sky.pixelSize(mCentre));
        sky.forCap(mCentre, std::min(outer, pi), [&](size_t index, double3 direction, double solidAngle) {
            if (distance(direction) < mRadius) return;
            const size_t sector = std::min(static_cast<size_t>(angle(direction) / (2 * pi) * kSectors), kSectors - 1);
            mSectors[sector] += double3(sky.pixel(index)) * solidAngle;
            weights[sector] += solidAngle;
        });
        fill(weights);
    }

    double distance(double3 direction) const {
        const double3 away = direction - mCentre;
        return 2 * elementary::asin(std::min(std::sqrt(glm::dot(away, away)) / 2, 1.0));
    }

    double3 radiance(double3 direction) const {
        // At the edge itself only one sector would count, with all the noise of its pixels.
        const double r = std::min(distance(direction) / mRadius, 0.9), at = angle(direction);
        double3 sum(0.0);
        double weights = 0;
        for (size_t i = 0; i < kSectors; ++i) {
            const double turn = at - (static_cast<double>(i) + 0.5) * (2 * pi / kSectors);
            const double weight = 1 / (1 - 2 * r * elementary::cos(turn) + r * r);
            sum += mSectors[i] * weight;
            weights += weight;
        }
        return sum / weights;
    }

private:
    double angle(double3 direction) const {
        return elementary::atan2(glm::dot(direction, mY), glm::dot(direction, mX)) + pi;
    }

    /// Means; sectors without a pixel get those of the nearest ones on both sides.
    void fill(std::array<double, kSectors> const& weights) {
        for (size_t i = 0; i < kSectors; ++i)
            if (weights[i] > 0) mSectors[i] /= weights[i];
        for (size_t i = 0; i < kSectors; ++i) {
            if (weights[i] > 0) continue;
            size_t before = 1, after = 1;
            while (before < kSectors && weights[(i + kSectors - before) % kSectors] <= 0) ++before;
            while (after < kSectors && weights[(i + after) % kSectors] <= 0) ++after;
            if (before == kSectors) return; // no pixel at all: black
            const double3 left = mSectors[(i + kSectors - before) % kSectors], right = mSectors[(i + after) % kSectors];
            const auto b = static_cast<double>(before), a = static_cast<double>(after);
            mFilled[i] = (left * a + right * b) / (a + b);
        }
        for (size_t i = 0; i < kSectors; ++i)
            if (weights[i] <= 0) mSectors[i] = mFilled[i];
    }

    double3 mCentre, mX, mY;
    double mRadius;
    std::array<double3, kSectors> mSectors{}, mFilled{};
};

/// No pixel becomes brighter: what is dark before the sun stays.
TakenLight cutOut(SkyGrid const& sky, Peak const& peak) {
    const SkyBehind behind(sky, peak);
    TakenLight taken;
    sky.forCap(peak.centre, peak.radius, [&](size_t index, double3 direction, double solidAngle) {
        float3& pixel = sky.pixel(index);
        const float3 left = glm::min(pixel, float3(behind.radiance(direction)));
        taken.add((double3(pixel) - double3(left)) * solidAngle, direction);
        pixel = left;
    });
    return taken;
}

/// What explains why there is no sun.
ExtractedLight lightOfPeak(Peak const& peak, double pixel, double facing) {
    TakenLight taken{ .illuminance = double3(peak.light) };
    taken.moment = peak.centre * (peak.light * std::max(0.0, 1 - peak.squaredSpread / 2));
    return lightOf(taken, pixel, facing);
}

} // namespace

EnvironmentLights takeSun(SkyGrid const& sky, jobs::JobSystem& jobs) {
    EnvironmentLights lights{ .search = SunSearch::Even };
    std::optional<Peak> sun, brightest;
    for (Cell const& cell : cellsOf(sky, kBrightOfMean * meanLuminance(sky, jobs), jobs)) {
        const Peak peak = peakOf(sky, cell);
        if (peak.light > 0 && (!brightest || peak.light > brightest->light)) brightest = peak;
        if (peak.isCompact && peak.light > 0 && (!sun || peak.light > sun->light)) sun = peak;
    }
    if (!brightest) return lights;
    Peak const& chosen = sun ? *sun : *brightest;
    const double pixel = sky.pixelSize(chosen.centre), facing = facingIlluminance(sky, {}, chosen.centre, jobs);
    const ExtractedLight seen = lightOfPeak(chosen, pixel, facing);
    if (sun && seen.share >= EnvironmentLights::kLeastSunShare) {
        lights.lights[0] = lightOf(cutOut(sky, *sun), pixel, facing);
        lights.count = 1;
        lights.search = SunSearch::Found;
        return lights;
    }
    const bool isDim = sun && sun->light == brightest->light;
    lights.search = isDim ? SunSearch::Dim : SunSearch::Wide;
    const double facingBrightest = isDim ? facing : facingIlluminance(sky, {}, brightest->centre, jobs);
    lights.brightest = lightOfPeak(*brightest, sky.pixelSize(brightest->centre), facingBrightest);
    return lights;
}

} // namespace filament_core::assets
