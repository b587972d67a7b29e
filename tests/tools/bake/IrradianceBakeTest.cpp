// SPDX-License-Identifier: Apache-2.0
// Irradiance grids that the path tracer bakes: closed forms, the same bytes for any number of workers, refinement, and
// leaks of light through thin walls against a search through all triangles.
#include "tools/bake/IrradianceBake.h"

#include "filament_core/scene/SampleGrid.h"
#include "tests/tools/bake/GridRooms.h"

#include <cmath>
#include <limits>

namespace filament_core::bake {
namespace {

using namespace reference;
using test::boxesPrimitive;
using test::GridRoom;
using test::makeRoom;
using test::RoomBox;

constexpr float kLux = 1000;

ReferenceEnvironment skyOf(std::function<float3(double3)> const& sky) {
    return { .image = makeSky(64, sky), .illuminance = Lux{ kLux } };
}

TracedScenePtr traced(ReferenceScene const& scene, jobs::JobSystem& jobs) {
    Result<TracedScenePtr> made = prepare(scene, jobs);
    EXPECT_TRUE(made) << made.error().message;
    return std::move(*made);
}

struct IrradianceBake : testing::Test {
    jobs::JobSystem jobs{ { .workers = 1 } };

    BakedGrid bake(ReferenceScene const& scene, GridSettings const& settings) {
        Result<BakedGrid> baked = bakeIrradianceGrid(*traced(scene, jobs), settings, jobs);
        EXPECT_TRUE(baked) << baked.error().message;
        return std::move(*baked);
    }
};

GridSettings cheap(float3 half, float spacing) {
    GridSettings settings;
    settings.box.halfExtentMeters = half;
    settings.spacingMeters = spacing;
    settings.probes.rays = 256;
    settings.heldOutPoints = 16;
    settings.judgedPoints = 0;
    settings.maxProbes = 64;
    return settings;
}

TEST_F(IrradianceBake, AUniformSkyIsUniformLight) {
    GridSettings settings = cheap(float3(1), 2);
    settings.probes.rays = 8192;
    const BakedGrid baked = bake({ .environment = skyOf([](double3) { return float3(1, 2, 3); }) }, settings);
    EXPECT_EQ(baked.grid.probes->count, uint3(2));
    for (IrradianceProbe const& probe : baked.grid.probes->probes) {
        for (int c = 0; c < 3; ++c) {
            const float expected = kLux * static_cast<float>(c + 1);
            EXPECT_NEAR(probe.irradianceSh[0][c], expected, 0.01f * expected);
            for (size_t k = 1; k < 9; ++k) EXPECT_NEAR(probe.irradianceSh[k][c], 0, 0.04f * expected) << k;
        }
        EXPECT_FALSE(probe.isInside);
        EXPECT_LT(probe.standardError, 0.01f * kLux);
    }
    EXPECT_LT(baked.report.heldOutError, 0.02);
    EXPECT_TRUE(baked.report.isWithinBound);
    EXPECT_EQ(baked.report.rounds, 1u);
    EXPECT_TRUE(baked.report.leaks.found.empty());
}

// E / pi of radiance a + b.d is a + 2/3 b.n; that of c (3 d.z^2 - 1) is c/4 (3 n.z^2 - 1).
TEST_F(IrradianceBake, ASkyOfTwoBandsHasTheCoefficientsOfItsClosedForm) {
    GridSettings settings = cheap(float3(1), 2);
    settings.probes.rays = 8192;
    const BakedGrid baked = bake(
            { .environment = skyOf([](double3 d) {
                  return float3(static_cast<float>(2 + 0.6 * d.x - 0.9 * d.y + 0.3 * d.z + 0.4 * (3 * d.z * d.z - 1)));
              }) },
            settings);
    IrradianceProbe const& probe = baked.grid.probes->probes[3];
    const std::array<float, 9> expected{ 2, -0.6f, 0.2f, 0.4f, 0, 0, 0.1f, 0, 0 };
    for (size_t k = 0; k < 9; ++k) EXPECT_NEAR(probe.irradianceSh[k].x, kLux * expected[k], 0.03f * kLux) << k;
}

TEST_F(IrradianceBake, AFurnaceOfGlowingWallsIsAsBrightAsItsGeometricSeries) {
    assets::MaterialData walls = lambert(0.5f);
    walls.emissiveFactor = float3(3);
    walls.specular.factor = 0;
    ReferenceScene scene{ .models = { { .data = makeModel(roomPrimitive(), walls) } } };
    const BakedGrid baked = bake(scene, cheap(float3(0.8f), 2));
    for (IrradianceProbe const& probe : baked.grid.probes->probes) {
        EXPECT_NEAR(probe.irradianceSh[0].x, 6, 6 * 0.06f);
        EXPECT_FALSE(probe.isInside);
    }
}

TEST_F(IrradianceBake, ProbesInsideOfGeometryAreFound) {
    ReferenceScene scene{
        .models = { { .data = makeModel(boxesPrimitive({ { { 1, 0, 0 }, float3(0.5f) } }), lambert(0.5f)) } },
        .environment = skyOf([](double3) { return float3(1); })
    };
    GridSettings settings = cheap({ 1, 0.01f, 0.01f }, 2);
    settings.maxProbes = 8;
    const BakedGrid baked = bake(scene, settings);
    for (size_t i = 0; i < 8; ++i) EXPECT_EQ(baked.grid.probes->probes[i].isInside, i % 2 == 1) << i;
    EXPECT_EQ(baked.report.inside, 4u);
}

TEST_F(IrradianceBake, TheBytesAreTheSameForAnyNumberOfWorkers) {
    const GridRoom room = makeRoom(3);
    ReferenceScene scene{ .models = { { .data = makeModel(boxesPrimitive(room.boxes), lambert(0.7f)) } },
                          .points = { { .positionWorld = { 0, 0.5, 0 }, .intensity = Candela{ 100 } } } };
    GridSettings settings = cheap(room.half, 1.5f);
    settings.probes.rays = 64;
    std::vector<std::vector<std::byte>> files;
    for (const int workers : { 0, 1, 3 }) {
        jobs::JobSystem own{ { .workers = workers } };
        Result<BakedGrid> baked = bakeIrradianceGrid(*traced(scene, own), settings, own);
        ASSERT_TRUE(baked);
        files.push_back(writeIrradianceGrid(baked->grid));
    }
    EXPECT_EQ(files[0], files[1]);
    EXPECT_EQ(files[0], files[2]);
    const Result<IrradianceGridDesc> read = readIrradianceGrid(files[0]);
    ASSERT_TRUE(read);
    EXPECT_EQ(writeIrradianceGrid(*read), files[0]); // what is read is what was written
}

/// Light from a gap under the ceiling: it falls off quickly.
ReferenceScene litThroughAGap() {
    assets::MaterialData glow = lambert(0);
    glow.emissiveFactor = float3(500);
    ReferenceScene scene;
    scene.models.push_back({ .data = makeModel(boxesPrimitive({ { { 1.5f, 0, 0 }, { 0.05f, 0.2f, 0.2f } } }), glow) });
    scene.models.push_back(
            { .data = makeModel(boxesPrimitive({ { { 0, -1.1f, 0 }, { 3, 0.1f, 3 } } }), lambert(0.6f)) });
    return scene;
}

TEST_F(IrradianceBake, GridsAreRefinedUntilTheBoundIsMetOrTheBudgetIsSpent) {
    GridSettings settings = cheap({ 1.2f, 0.8f, 1 }, 2.4f);
    settings.probes.rays = 1024;
    settings.heldOutPoints = 32;
    settings.maxError = 0;
    settings.maxProbes = 200;
    const BakedGrid spent = bake(litThroughAGap(), settings);
    EXPECT_FALSE(spent.report.isWithinBound);
    EXPECT_GE(spent.report.rounds, 3u);
    EXPECT_LE(spent.grid.probes->probes.size(), 200u);
    settings.maxProbes = 8;
    const BakedGrid coarse = bake(litThroughAGap(), settings);
    EXPECT_EQ(coarse.report.rounds, 1u);
    EXPECT_GT(coarse.report.heldOutError, 1.5 * spent.report.heldOutError);
    settings.maxProbes = 4096;
    settings.maxError = static_cast<float>(0.5 * (coarse.report.heldOutError + spent.report.heldOutError));
    const BakedGrid bounded = bake(litThroughAGap(), settings);
    EXPECT_TRUE(bounded.report.isWithinBound);
    EXPECT_GT(bounded.report.rounds, 1u);
    EXPECT_LE(bounded.grid.probes->probes.size(), spent.grid.probes->probes.size());
}

// ------------------------------------------------------------------------------------------------ leaks

/// Möller and Trumbore 1997, for all triangles of the boxes.
class AllTriangles {
public:
    explicit AllTriangles(assets::PrimitiveData const& primitive) {
        for (float4 const& position : decodeAttribute(primitive, shader::kAttributePosition))
            mCorners.emplace_back(double3(position));
        mIndices = decodeIndices(primitive);
    }
    bool block(double3 from, double3 to) const {
        for (size_t i = 0; i < mIndices.size(); i += 3) {
            const double3 a = mCorners[mIndices[i]], ab = mCorners[mIndices[i + 1]] - a,
                          ac = mCorners[mIndices[i + 2]] - a;
            const double3 way = to - from, p = glm::cross(way, ac);
            const double determinant = glm::dot(ab, p);
            if (determinant == 0) continue;
            const double3 s = from - a, q = glm::cross(s, ab);
            const double u = glm::dot(s, p) / determinant, v = glm::dot(way, q) / determinant;
            const double t = glm::dot(ac, q) / determinant;
            if (u >= 0 && v >= 0 && u + v <= 1 && t > 0.001 && t < 0.999) return true;
        }
        return false;
    }

private:
    std::vector<double3> mCorners;
    std::vector<uint32_t> mIndices;
};

/// Every point against every probe of the grid, by the definition in IrradianceLeaks.h alone.
std::vector<Leak> leaksOfAllPairs(scene::GridRecord const& grid, uint32_t side, AllTriangles const& triangles) {
    std::vector<Leak> leaks;
    IrradianceProbes const& probes = *grid.probes;
    const float3 cell = scene::spacingOf(grid);
    const uint3 points = (probes.count - 1u) * side;
    for (uint32_t i = 0; i < points.x * points.y * points.z; ++i) {
        const uint3 at(i % points.x, i / points.x % points.y, i / points.x / points.y);
        const float3 point = -grid.halfExtent + cell * (float3(at) + 0.5f) / static_cast<float>(side);
        float sum = 0;
        bool isSeen = false;
        std::vector<Leak> hidden;
        for (uint32_t probe = 0; probe < probes.probes.size(); ++probe) {
            const uint3 number(probe % probes.count.x, probe / probes.count.x % probes.count.y,
                               probe / probes.count.x / probes.count.y);
            const float3 place = scene::placeOf(grid, number);
            const float3 tent = glm::max(1.0f - glm::abs(point - place) / cell, float3(0));
            const float weight = tent.x * tent.y * tent.z;
            if (weight <= 1e-5f || probes.probes[probe].isInside) continue;
            const float share = weight * scene::visibilityOf(probes, probe, point - place, scene::biasOf(grid));
            sum += share;
            const bool isHidden = triangles.block(grid.centerWorld + double3(place), grid.centerWorld + double3(point));
            isSeen = isSeen || !isHidden;
            if (isHidden) hidden.push_back({ point, probe, share });
        }
        for (Leak const& leak : hidden)
            if (isSeen && leak.share > kLeakShare * sum) leaks.push_back({ leak.point, leak.probe, leak.share / sum });
    }
    return leaks;
}

TEST_F(IrradianceBake, LeaksOfFiftyRoomsAreThoseOfASearchThroughAllTriangles) {
    size_t leaks = 0, withoutDepths = 0, points = 0;
    for (uint32_t seed = 1; seed <= 50; ++seed) {
        const GridRoom room = makeRoom(seed);
        const assets::PrimitiveData primitive = boxesPrimitive(room.boxes);
        const TracedScenePtr scene = traced({ .models = { { .data = makeModel(primitive, lambert(0.5f)) } } }, jobs);
        GridSettings settings = cheap(room.half - 0.17f, 0.8f); // not in the planes of the walls
        settings.probes.rays = 16;
        settings.maxProbes = 400;
        settings.maxError = 1e6f;
        settings.heldOutPoints = 1;
        Result<BakedGrid> baked = bakeIrradianceGrid(*scene, settings, jobs);
        ASSERT_TRUE(baked);
        std::vector<Leak> expected =
                leaksOfAllPairs(scene::gridRecord(baked->grid), settings.leakPointsPerSide, AllTriangles(primitive));
        const auto key = [](Leak const& leak) {
            return std::tuple(leak.probe, std::lround(1e4f * leak.point.x), std::lround(1e4f * leak.point.y),
                              std::lround(1e4f * leak.point.z));
        };
        std::vector<Leak> found = baked->report.leaks.found;
        std::ranges::sort(found, {}, key);
        std::ranges::sort(expected, {}, key);
        ASSERT_EQ(found.size(), expected.size()) << "room " << seed;
        for (size_t i = 0; i < found.size(); ++i) {
            EXPECT_EQ(key(found[i]), key(expected[i])) << "room " << seed;
            EXPECT_NEAR(found[i].share, expected[i].share, 1e-3f);
        }
        leaks += found.size();
        points += baked->report.leaks.points;
        auto blind = std::make_shared<IrradianceProbes>(*baked->grid.probes);
        blind->depthSize = 0;
        blind->depths.clear();
        IrradianceGridDesc desc = baked->grid;
        desc.probes = blind;
        withoutDepths += findLeaks(scene::gridRecord(desc), settings.leakPointsPerSide, [&](double3 from, double3 to) {
                             return isBlocked(*scene, from, to);
                         }).found.size();
    }
    EXPECT_GT(withoutDepths, 4 * leaks) << leaks << " leaks with depths at " << points << " points";
    RecordProperty("leaks", static_cast<int>(leaks));
    RecordProperty("leaksWithoutDepths", static_cast<int>(withoutDepths));
    RecordProperty("points", static_cast<int>(points));
    EXPECT_GT(withoutDepths, 100u);
}

TEST_F(IrradianceBake, AGridOfOneProbeHoldsItsLightEverywhere) {
    GridSettings settings = cheap(float3(1), 2);
    settings.maxProbes = 1;
    const BakedGrid baked = bake({ .environment = skyOf([](double3) { return float3(1); }) }, settings);
    EXPECT_EQ(baked.grid.probes->count, uint3(1));
    EXPECT_NEAR(scene::sampleGrid(scene::gridRecord(baked.grid), float3(0.9f)).light[0].x, kLux, 0.05f * kLux);
}

TEST_F(IrradianceBake, BoxesOfAnySizeAreTraced) {
    for (const float half : { 1e-9f, 1e-3f, 1e6f, 1e9f }) {
        GridSettings settings = cheap(float3(half), 1e6f);
        settings.maxProbes = 8;
        settings.probes.rays = 16;
        const BakedGrid baked = bake({ .environment = skyOf([](double3) { return float3(1); }) }, settings);
        EXPECT_TRUE(baked.report.isWithinBound || baked.report.heldOutError > 0) << half;
        EXPECT_NEAR(baked.grid.probes->probes[0].irradianceSh[0].x, kLux, 0.05f * kLux) << half;
    }
}

TEST_F(IrradianceBake, WithoutLightOrOutsideOfWallsThereIsNothingToJudge) {
    GridSettings settings = cheap(float3(0.3f), 0.3f);
    settings.judgedPoints = 64;
    settings.probes.rays = 16;
    const ReferenceScene box{ .models = {
                                      { .data = makeModel(boxesPrimitive({ { {}, float3(1) } }), lambert(0.5f)) } } };
    const BakedGrid inside = bake(box, settings);
    EXPECT_EQ(inside.report.inside, inside.grid.probes->probes.size());
    EXPECT_EQ(inside.report.judgement.inside, 64u);
    EXPECT_EQ(inside.report.heldOutPoints, 0u);
    settings.box.centerWorld = { 5, 0, 0 };
    const BakedGrid dark = bake(box, settings);
    EXPECT_EQ(dark.report.judgement.dark, 64u);
    EXPECT_EQ(dark.report.mean, 0);
    for (BakedGrid const* baked : { &inside, &dark }) {
        EXPECT_FALSE(baked->report.judgement.interpolation);
        EXPECT_TRUE(std::isfinite(baked->report.standardError) && std::isfinite(baked->report.heldOutError));
    }
}

TEST_F(IrradianceBake, SettingsOutsideOfTheirRangesAreAnErrorOfOneLine) {
    const TracedScenePtr scene = traced({ .environment = skyOf([](double3) { return float3(1); }) }, jobs);
    for (const auto& change : std::initializer_list<std::function<void(GridSettings&)>>{
                 [](GridSettings& s) { s.spacingMeters = 0; }, [](GridSettings& s) { s.maxProbes = 0; },
                 [](GridSettings& s) { s.box.halfExtentMeters.y = -1; }, [](GridSettings& s) { s.maxError = -1; },
                 [](GridSettings& s) { s.heldOutPoints = 0; }, [](GridSettings& s) { s.judgedPoints = 65537; },
                 [](GridSettings& s) { s.box.centerWorld.z = 1e13; },
                 [](GridSettings& s) { s.box.centerWorld.x = std::numeric_limits<double>::infinity(); },
                 [](GridSettings& s) { s.box.halfExtentMeters.x = 0; },
                 [](GridSettings& s) { s.probes.depthSize = 33; } }) {
        GridSettings settings = cheap(float3(1), 1);
        change(settings);
        const Result<BakedGrid> baked = bakeIrradianceGrid(*scene, settings, jobs);
        ASSERT_FALSE(baked);
        EXPECT_EQ(baked.error().message.find('\n'), std::string::npos);
    }
}

} // namespace
} // namespace filament_core::bake
