// SPDX-License-Identifier: Apache-2.0
// What irradiance grids say of points, against closed forms.
#include "filament_core/scene/SampleGrid.h"
#include "tests/scenes/GridOf.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace filament_core::scene {
namespace {

using scenes::ambientOf;
using scenes::gridOf;

float3 randomUnit(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return glm::normalize(float3(normal(random), normal(random), normal(random)));
}

IrradianceSh randomLight(std::mt19937& random) {
    std::uniform_real_distribution<float> value(-1, 1);
    IrradianceSh light;
    for (float3& coefficient : light) coefficient = float3(value(random), value(random), value(random));
    return light;
}

TEST(Octahedral, PlacesAndDirectionsAreInverse) {
    std::mt19937 random(2);
    for (int i = 0; i < 1000; ++i) {
        const float3 n = randomUnit(random);
        EXPECT_LT(glm::length(octahedralDirection(octahedralPlace(7.0f * n, 8), 8) - n), 1e-5f);
    }
}

TEST(SampleGrid, UniformLightIsTheSameAtEveryPoint) {
    std::mt19937 random(3);
    const IrradianceSh light = randomLight(random);
    const GridRecord grid = gridRecord(gridOf({ 1, 2, 3 }, { 4, 3, 2 }, [&](float3) { return light; }));
    for (const float3 point : { float3(0), float3(0.9f, -1.7f, 2.2f), float3(-30, 1, 100) }) {
        const GridSample sample = sampleGrid(grid, point);
        EXPECT_NEAR(sample.weight, 1, 1e-6f);
        for (size_t k = 0; k < light.size(); ++k) EXPECT_LT(glm::length(sample.light[k] - light[k]), 1e-5f);
    }
}

TEST(SampleGrid, LinearLightIsExact) {
    const auto at = [](float3 p) { return 5.0f + glm::dot(p, float3(1, -2, 0.5f)); };
    const GridRecord grid =
            gridRecord(gridOf({ 1, 2, 3 }, { 3, 5, 2 }, [&](float3 p) { return ambientOf(float3(at(p))); }));
    std::mt19937 random(4);
    std::uniform_real_distribution<float> value(-1, 1);
    for (int i = 0; i < 100; ++i) {
        const float3 p = float3(value(random), value(random), value(random)) * grid.halfExtent;
        EXPECT_NEAR(sampleGrid(grid, p).light[0].x, at(p), 1e-4f);
    }
}

TEST(SampleGrid, OneProbeIsInTheMiddleAndLightsEverything) {
    const IrradianceGridDesc one = gridOf({ 1, 1, 1 }, { 1, 1, 1 }, [](float3 p) { return ambientOf(p + 2.0f); });
    EXPECT_EQ(sampleGrid(gridRecord(one), { 0.9f, -1, 0 }).light[0], float3(2));
}

TEST(SampleGrid, ProbesInsideOfGeometryDoNotCount) {
    IrradianceGridDesc desc =
            gridOf({ 1, 1, 1 }, { 2, 1, 1 }, [](float3 p) { return ambientOf(float3(p.x < 0 ? 9 : 1)); });
    auto probes = std::make_shared<IrradianceProbes>(*desc.probes);
    probes->probes[0].isInside = true;
    desc.probes = probes;
    const GridSample sample = sampleGrid(gridRecord(desc), { -0.5f, 0, 0 });
    EXPECT_FLOAT_EQ(sample.light[0].x, 1);
    EXPECT_NEAR(sample.weight, 1, 1e-6f); // all that are not inside see it
    probes->probes[1].isInside = true;
    EXPECT_EQ(sampleGrid(gridRecord(desc), { -0.5f, 0, 0 }).weight, 0);
}

/// Two probes at x = -1 and 1, with a wall between them; depths of a map of 16 x 16, 64 rays a texel.
IrradianceGridDesc besideWall(bool hasDepths, float halfWall = 0.1f) {
    IrradianceGridDesc desc =
            gridOf({ 1, 1, 1 }, { 2, 1, 1 }, [](float3 p) { return ambientOf(float3(p.x < 0 ? 9 : 1)); });
    if (!hasDepths) return desc;
    auto probes = std::make_shared<IrradianceProbes>(*desc.probes);
    probes->depthSize = 16;
    for (const float side : { 1.0f, -1.0f }) { // where the wall is
        for (uint32_t texel = 0; texel < 256; ++texel) {
            float2 sum(0);
            for (uint32_t i = 0; i < 64; ++i) {
                const float2 at = float2(uint2(i % 8, i / 8)) / 8.0f + 0.0625f + float2(uint2(texel % 16, texel / 16));
                const float x = octahedralDirection(at, 16).x * side;
                const float distance = x > 0.3f ? (1 - halfWall) / x : 3.0f;
                sum += float2(distance, distance * distance) / 64.0f;
            }
            probes->depths.push_back(sum);
        }
    }
    desc.probes = probes;
    return desc;
}

TEST(SampleGrid, AWallHidesTheProbeBehindIt) {
    const GridRecord open = gridRecord(besideWall(false)), walled = gridRecord(besideWall(true));
    for (const float x : { 0.12f, 0.2f, 0.4f }) {
        EXPECT_GT(sampleGrid(open, { x, 0.1f, 0 }).light[0].x, 2.5f);
        EXPECT_NEAR(sampleGrid(walled, { x, 0.1f, 0 }).light[0].x, 1, 0.15f) << x;
        EXPECT_NEAR(sampleGrid(walled, { -x, 0.1f, 0 }).light[0].x, 9, 0.15f) << x;
    }
}

TEST(SampleGrid, NothingIsSeenWhereAllProbesAreHidden) {
    const GridRecord walled = gridRecord(besideWall(true, 0.3f));
    EXPECT_LT(sampleGrid(walled, { 0, 0, 0 }).weight, 0.01f);
    EXPECT_NEAR(sampleGrid(walled, { 0, 0, 0 }, true).weight, 1, 1e-6f);
}

} // namespace
} // namespace filament_core::scene
