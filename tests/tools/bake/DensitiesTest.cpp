// SPDX-License-Identifier: Apache-2.0
// A budget of texels, spent where the light changes.
#include "tools/bake/Densities.h"
#include "tests/tools/reference/TestScenes.h"
#include "tools/bake/LightmapImage.h"
#include "tools/reference/TracedScene.h"

#include <gtest/gtest.h>

#include <cmath>

namespace filament_core::bake {
namespace {

using reference::ReferenceScene;

ChartDetail detail(double side, double meanSquareError) {
    return { .size = double2(side), .texels = uint64_t((side + 2) * (side + 2)), .meanSquareError = meanSquareError };
}

double texelsOf(std::span<const ChartDetail> charts, std::span<const double> scales) {
    double sum = 0;
    for (size_t i = 0; i < charts.size(); ++i)
        sum += (charts[i].size.x * scales[i] + 2) * (charts[i].size.y * scales[i] + 2);
    return sum;
}

// The least of sum(a v / s^2) with sum(a s^2) given has s proportional to v^(1/4) (Lagrange).
TEST(Densities, AreThoseOfLagrangeForLargeCharts) {
    const std::vector<ChartDetail> charts{ detail(1000, 1), detail(1000, 16), detail(500, 81) };
    const std::vector<double> scales = chooseScales(charts, 1, 1.5e6);
    EXPECT_LE(texelsOf(charts, scales), 1.5e6);
    EXPECT_GT(texelsOf(charts, scales), 1.1e6);             // a step of the largest chart is left at most
    EXPECT_NEAR(std::log2(scales[1] / scales[0]), 1, 0.26); // a step is a quarter
    EXPECT_NEAR(std::log2(scales[2] / scales[0]), std::log2(3), 0.26);
}

TEST(Densities, StayWithinTheirRangeAndTheBudget) {
    const std::vector<ChartDetail> charts{ detail(20, 0), detail(20, 5), detail(3, 1e9) };
    for (const double budget : { 1.0, 100.0, 1000.0, 1e9 }) {
        const std::vector<double> scales = chooseScales(charts, 2, budget);
        for (const double scale : scales) {
            EXPECT_GE(scale, 2 * kLeastScale);
            EXPECT_LE(scale, 2 * kMostScale * (1 + 1e-6));
        }
        const std::vector<double> least(charts.size(), 2 * kLeastScale);
        EXPECT_LE(texelsOf(charts, scales), std::max(budget, texelsOf(charts, least)));
    }
    EXPECT_EQ(chooseScales(charts, 1, 100)[0], kLeastScale) << "even light needs no texels";
}

/// Four floors: one at the foot of a dark wall, the others under open sky.
class BudgetedFloors : public testing::Test {
protected:
    BudgetedFloors() {
        mScene.models.push_back({ reference::makeModel(wall(), black()) });
        mScene.environment = reference::uniformSky(1);
        for (const double x : { 0.0, 60.0, 120.0, 180.0 }) {
            BakeSurface surface;
            for (const double2 at : { double2(-1, 1), double2(1, 1), double2(1, -1), double2(-1, -1) })
                surface.positions.push_back({ x + at.x, 0, at.y });
            surface.indices = { 0, 1, 2, 0, 2, 3 };
            mSurfaces.push_back(surface);
        }
        mTraced = reference::prepare(mScene, mJobs).value();
    }
    static assets::MaterialData black() {
        assets::MaterialData material = reference::lambert(0);
        material.specular.factor = 0;
        return material;
    }
    /// Just beyond the first floor.
    static assets::PrimitiveData wall() {
        const float3 normal(-1, 0, 0), tangent(0, 0, 1);
        const reference::TestVertex vertices[4] = { { { 1.01f, 0, -3 }, normal, tangent, {} },
                                                    { { 1.01f, 0, 3 }, normal, tangent, {} },
                                                    { { 1.01f, 0.5f, 3 }, normal, tangent, {} },
                                                    { { 1.01f, 0.5f, -3 }, normal, tangent, {} } };
        const uint32_t indices[6] = { 0, 1, 2, 0, 2, 3 };
        return reference::makePrimitive(vertices, indices);
    }
    struct Baked {
        Atlas atlas;
        std::vector<AtlasTexel> texels;
        LightmapImage image;
    };
    Baked bake(Atlas atlas, uint32_t samples) {
        Baked baked{ .atlas = std::move(atlas), .texels = {}, .image = {} };
        baked.texels = findTexels(baked.atlas);
        std::vector<TexelLight> lights;
        bakeTexels(*mTraced, mSurfaces, baked.atlas, baked.texels, settings(samples), mJobs,
                   [&](size_t, std::span<const TexelLight> finished) {
                       lights.insert(lights.end(), finished.begin(), finished.end());
                       return true;
                   });
        baked.image = makeImage(baked.atlas, baked.texels, lights);
        return baked;
    }
    static LightSettings settings(uint32_t samples) {
        return { .samplesPerTexel = samples, .exposure = reference::plainExposure() };
    }
    /// As the engine samples it.
    static double lookUp(Baked const& baked, uint32_t surface, AtlasTexel const& point) {
        AtlasSurface const& charted = baked.atlas.surfaces[surface];
        const uint32_t* const corners = &charted.indices[size_t(point.triangle) * 3];
        const double2 uv = double2(charted.uvs[corners[0]]) * (1 - point.u - point.v) +
                           double2(charted.uvs[corners[1]]) * point.u + double2(charted.uvs[corners[2]]) * point.v;
        const double2 at = uv * double(baked.image.side) - 0.5, low = glm::floor(at), share = at - low;
        const auto texel = [&](double x, double y) {
            return baked.image.texels[size_t(low.y + y) * baked.image.side + size_t(low.x + x)].x;
        };
        return (texel(0, 0) * (1 - share.x) + texel(1, 0) * share.x) * (1 - share.y) +
               (texel(0, 1) * (1 - share.x) + texel(1, 1) * share.x) * share.y;
    }
    /// Howell, "A Catalog of Radiation Heat Transfer Configuration Factors", C-3: of the part of the wall to one side.
    static double factorOfWall(double width, double distance) {
        constexpr double kHeight = 0.5;
        const double y = std::sqrt(kHeight * kHeight + distance * distance);
        return (std::atan(width / distance) - distance / y * std::atan(width / y)) / (2 * reference::kPiExact);
    }
    /// pi L of the sky, without what the wall hides of it.
    double truthAt(uint32_t surface, double3 at) const {
        const double hidden =
                surface == 0 ? factorOfWall(3 - at.z, kWall - at.x) + factorOfWall(3 + at.z, kWall - at.x) : 0;
        return reference::kPiExact * (1 - hidden);
    }
    /// At the places of a dense lightmap.
    double rmsOf(Baked const& baked) {
        const Atlas dense = makeAtlas(mSurfaces, { .texelsPerMeter = 32 }, mJobs).value();
        double squares = 0;
        size_t count = 0;
        for (AtlasTexel const& point : findTexels(dense)) {
            if (point.distance > 0) continue;
            const uint32_t surface = dense.charts[point.chart].surface;
            const double off =
                    lookUp(baked, surface, point) - truthAt(surface, pointOf(mSurfaces[surface], point).position);
            squares += off * off, ++count;
        }
        return std::sqrt(squares / double(count));
    }

    static constexpr double kWall = 1.01;
    ReferenceScene mScene;
    std::vector<BakeSurface> mSurfaces;
    jobs::JobSystem mJobs{ { .workers = 1 } };
    reference::TracedScenePtr mTraced;
};

TEST_F(BudgetedFloors, AreNearerToTheClosedFormThanThoseOfOneDensity) {
    constexpr uint32_t kSamples = 4096;
    const Baked even = bake(makeAtlas(mSurfaces, { .texelsPerMeter = 4 }, mJobs).value(), kSamples);
    const uint64_t budget = even.texels.size();
    const Baked chosen =
            bake(makeBudgetAtlas(*mTraced, mSurfaces, {}, settings(kSamples), budget, mJobs).value(), kSamples);
    EXPECT_LE(double(chosen.texels.size()), 1.03 * double(budget));
    EXPECT_GT(chosen.atlas.charts[0].scale, 1.5 * chosen.atlas.charts[1].scale);
    const double before = rmsOf(even), after = rmsOf(chosen);
    EXPECT_LT(after, 0.8 * before) << chosen.texels.size() << " of " << budget << " texels";
}

TEST_F(BudgetedFloors, AreTheSameForAnyNumberOfWorkers) {
    std::vector<double> scales;
    for (const int workers : { 0, 1, 3 }) {
        jobs::JobSystem jobs({ .workers = workers });
        const Atlas atlas = makeBudgetAtlas(*mTraced, mSurfaces, {}, settings(64), 400, jobs).value();
        std::vector<double> now;
        for (AtlasChart const& chart : atlas.charts) now.push_back(chart.scale);
        if (!scales.empty()) EXPECT_EQ(now, scales) << workers;
        scales = now;
    }
}

} // namespace
} // namespace filament_core::bake
