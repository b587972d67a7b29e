// SPDX-License-Identifier: Apache-2.0
// takeRegions(): bright pixels -> regions of little variance -> the brightest of them as lights.
#include "filament_core/assets/environment/SkyLights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace filament_core::assets {
namespace {

constexpr double kMostSpread =
        10 * std::numbers::pi / 180; // root mean square distance of a region's light from its centre
constexpr size_t kMostRegions = 64, kBins = 256;

/// Bright pixels from `begin` to `end` of a list.
struct Region {
    size_t begin = 0, end = 0;
    double light = 0;
    double3 moment{ 0.0 };
    bool isWhole = false; ///< it cannot be cut

    double squaredSpread() const { return light > 0 ? 2 * std::max(0.0, 1 - glm::length(moment) / light) : 0; }
};

class Regions {
public:
    Regions(SkyGrid const& sky, double bright) : mSky(sky), mBright(bright) {
        for (uint32_t row = 0; row < sky.rows(); ++row) {
            for (uint32_t column = 0; column < sky.columns(); ++column) {
                const size_t index = sky.indexOf(column, row);
                if (skyLuminance(sky.pixel(index)) > bright) mPixels.push_back(static_cast<uint32_t>(index));
            }
        }
        if (!mPixels.empty()) mRegions.push_back(measured(0, mPixels.size()));
        while (mRegions.size() < kMostRegions && cutOne()) {
        }
        std::stable_sort(mRegions.begin(), mRegions.end(),
                         [](Region const& a, Region const& b) { return a.light > b.light; });
    }

    std::vector<Region> const& all() const { return mRegions; }

    /// All of its pixels become as bright as the limit, with their colours.
    TakenLight cutOut(Region const& region) const {
        TakenLight taken;
        for (size_t i = region.begin; i < region.end; ++i) {
            float3& pixel = mSky.pixel(mPixels[i]);
            const auto left = float3(double3(pixel) * (mBright / skyLuminance(pixel)));
            taken.add((double3(pixel) - double3(left)) * mSky.solidAngle(mPixels[i]), mSky.direction(mPixels[i]));
            pixel = left;
        }
        return taken;
    }

private:
    double lightOfPixel(size_t index) const {
        return (skyLuminance(mSky.pixel(index)) - mBright) * mSky.solidAngle(index);
    }

    Region measured(size_t begin, size_t end) const {
        Region region{ .begin = begin, .end = end };
        for (size_t i = begin; i < end; ++i) {
            const double light = lightOfPixel(mPixels[i]);
            region.light += light;
            region.moment += mSky.direction(mPixels[i]) * light;
        }
        return region;
    }

    /// The one whose light varies most; false if all are narrow.
    bool cutOne() {
        Region* widest = nullptr;
        for (Region& region : mRegions) {
            const double squared = region.squaredSpread();
            if (region.isWhole || squared <= kMostSpread * kMostSpread) continue;
            if (!widest || squared * region.light > widest->squaredSpread() * widest->light) widest = &region;
        }
        if (!widest) return false;
        const Region whole = *widest;
        const size_t middle = partition(whole);
        if (middle == whole.begin || middle == whole.end) {
            widest->isWhole = true;
            return true;
        }
        *widest = measured(whole.begin, middle);
        mRegions.push_back(measured(middle, whole.end));
        return true;
    }

    /// The direction in which the light varies most: the largest eigenvector, by powers of the covariance.
    double3 principalAxis(Region const& region) const {
        const double3 centre = region.moment / region.light;
        double3 xRow(0.0), yRow(0.0), zRow(0.0);
        for (size_t i = region.begin; i < region.end; ++i) {
            const double3 away = mSky.direction(mPixels[i]) - centre, weighted = away * lightOfPixel(mPixels[i]);
            xRow += away * weighted.x, yRow += away * weighted.y, zRow += away * weighted.z;
        }
        double3 axis = xRow.x >= yRow.y && xRow.x >= zRow.z ? xRow : yRow.y >= zRow.z ? yRow : zRow;
        for (int step = 0; step < 32; ++step) {
            const double length = glm::length(axis);
            if (length <= 0) return { 0, 1, 0 };
            axis /= length;
            axis = double3(glm::dot(xRow, axis), glm::dot(yRow, axis), glm::dot(zRow, axis));
        }
        const double length = glm::length(axis);
        return length > 0 ? axis / length : double3(0, 1, 0);
    }

    struct Bin {
        double light = 0, sum = 0; ///< sum of light times place
    };

    /// After which bin the variances of both sides add up to the least: where the squares of their sums, over their
    /// lights, add up to the most.
    static size_t bestCut(std::array<Bin, kBins> const& bins) {
        Bin all;
        for (Bin const& bin : bins) all.light += bin.light, all.sum += bin.sum;
        Bin left;
        size_t best = 0;
        double most = -1;
        for (size_t i = 0; i + 1 < kBins; ++i) {
            left.light += bins[i].light, left.sum += bins[i].sum;
            const Bin right{ all.light - left.light, all.sum - left.sum };
            if (left.light <= 0 || right.light <= 0) continue;
            const double value = left.sum * left.sum / left.light + right.sum * right.sum / right.light;
            if (value > most) most = value, best = i;
        }
        return best;
    }

    /// Orders the pixels of a region so that those of one side come first, and returns where the others begin.
    size_t partition(Region const& region) {
        const double3 axis = principalAxis(region), centre = region.moment / region.light;
        double least = 2, most = -2;
        for (size_t i = region.begin; i < region.end; ++i) {
            const double place = glm::dot(mSky.direction(mPixels[i]) - centre, axis);
            least = std::min(least, place), most = std::max(most, place);
        }
        if (most <= least) return region.begin;
        const auto binOf = [&](uint32_t pixel) {
            const double place = glm::dot(mSky.direction(pixel) - centre, axis);
            return std::min(static_cast<size_t>((place - least) / (most - least) * kBins), kBins - 1);
        };
        std::array<Bin, kBins> bins{};
        for (size_t i = region.begin; i < region.end; ++i) {
            const double light = lightOfPixel(mPixels[i]);
            Bin& bin = bins[binOf(mPixels[i])];
            bin.light += light;
            bin.sum += light * glm::dot(mSky.direction(mPixels[i]) - centre, axis);
        }
        const size_t cut = bestCut(bins);
        const auto begin = mPixels.begin() + static_cast<std::ptrdiff_t>(region.begin);
        const auto end = mPixels.begin() + static_cast<std::ptrdiff_t>(region.end);
        const auto middle = std::stable_partition(begin, end, [&](uint32_t pixel) { return binOf(pixel) <= cut; });
        return static_cast<size_t>(middle - mPixels.begin());
    }

    SkyGrid const& mSky;
    double mBright;
    std::vector<uint32_t> mPixels;
    std::vector<Region> mRegions;
};

} // namespace

void takeRegions(SkyGrid const& sky, EnvironmentLights& lights, uint32_t most, jobs::JobSystem& jobs) {
    const double bright = kBrightOfMean * meanLuminance(sky, jobs);
    if (!(bright > 0)) return;
    const Regions regions(sky, bright);
    for (Region const& region : regions.all()) {
        if (lights.count >= most || glm::length(region.moment) <= 0) break;
        const double3 direction = glm::normalize(region.moment);
        const double facing = facingIlluminance(sky, lights.found(), direction, jobs);
        if (region.light < double{ EnvironmentLights::kLeastShare } * facing) break; // the others are dimmer
        lights.lights[lights.count++] = lightOf(regions.cutOut(region), sky.pixelSize(direction), facing);
    }
}

} // namespace filament_core::assets
