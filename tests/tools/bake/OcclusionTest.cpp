// SPDX-License-Identifier: Apache-2.0
// Baked ambient occlusion and bent normals beside closed forms, and as the model stores them.
#include "tests/tools/reference/TestScenes.h"
#include "tools/bake/BakeLight.h"
#include "tools/bake/OcclusionImage.h"
#include "tools/reference/TracedScene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace filament_core::bake {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();
constexpr double kPi = std::numbers::pi;

/// Faces -x, stands at x = 1, and reaches a kilometre in its plane.
assets::PrimitiveData hugeWall() {
    std::vector<reference::TestVertex> vertices;
    for (const float2 at : { float2(-1, -1), float2(-1, 1), float2(1, 1), float2(1, -1) })
        vertices.push_back({ { 1, 1000 * at.x, 1000 * at.y }, { -1, 0, 0 }, { 0, 0, 1 }, {} });
    const uint32_t indices[6] = { 0, 1, 2, 0, 2, 3 };
    return reference::makePrimitive(vertices, indices);
}

assets::MaterialData doubleSided() {
    assets::MaterialData material = reference::lambert(0.5f);
    material.doubleSided = true;
    return material;
}

class BakedOcclusion : public ::testing::Test {
protected:
    TexelLight at(SurfacePoint const& point, double meters, uint32_t samples = 4096, uint64_t stream = 1) {
        if (!mTraced) {
            Result<reference::TracedScenePtr> traced = reference::prepare(mScene, mJobs);
            EXPECT_TRUE(traced) << traced.error().message;
            mTraced = std::move(*traced);
        }
        return occlusionOf(*mTraced, point, stream, { .occlusionMeters = meters, .samplesPerTexel = samples });
    }
    static SurfacePoint onFloor(double3 position) {
        return { .position = position, .normal = { 0, 1, 0 }, .faceNormal = { 0, 1, 0 }, .longestEdge = 1 };
    }

    jobs::JobSystem mJobs{ { .workers = 0 } };
    reference::ReferenceScene mScene{ .models = { { reference::makeModel(hugeWall(), reference::lambert(0.5f)) } } };
    reference::TracedScenePtr mTraced;
};

// Half of the cosine-weighted hemisphere; the mean of that half is 2 / (3 pi) away from the wall, and 1 / 3 up.
TEST_F(BakedOcclusion, BesideAnEndlessWallIsAHalfAndBendsAway) {
    const TexelLight light = at(onFloor({ 0.5, 0, 0 }), kFar);
    EXPECT_NEAR(light.irradiance.x, 0.5, 4 * light.standardError.x + 1e-3);
    EXPECT_NEAR(light.open.x, -2 / (3 * kPi), 0.01);
    EXPECT_NEAR(light.open.y, 1.0 / 3, 0.01);
    EXPECT_NEAR(light.open.z, 0, 0.01);
    EXPECT_EQ(light.backs, 0);
}

TEST_F(BakedOcclusion, EndsAtItsDistance) {
    const TexelLight light = at(onFloor({ 0.5, 0, 0 }), 0.499);
    EXPECT_EQ(light.irradiance.x, 1);
    EXPECT_EQ(light.standardError.x, 0);
    EXPECT_NEAR(light.open.y, 2.0 / 3, 0.01);
    EXPECT_LT(at(onFloor({ 0.5, 0, 0 }), 0.6).irradiance.x, 1);
    EXPECT_GT(at(onFloor({ 0.5, 0, 0 }), 0.6).irradiance.x, at(onFloor({ 0.5, 0, 0 }), 6).irradiance.x);
}

TEST_F(BakedOcclusion, CountsBacksOfWalls) {
    const TexelLight light = at(onFloor({ 1.5, 0, 0 }), kFar);
    EXPECT_NEAR(light.backs, 0.5, 0.02) << "the wall's back hides half";
    EXPECT_NEAR(light.irradiance.x, 0.5, 0.02);
}

// A board a millimetre away hides the point from every camera: its texel is filled.
TEST_F(BakedOcclusion, CountsWhatCoversThePoint) {
    SurfacePoint wall{ .position = { 0.999, 0, 0 }, .normal = { 1, 0, 0 }, .faceNormal = { 1, 0, 0 } };
    wall.longestEdge = 1;
    mScene.models.front() = { reference::makeModel(hugeWall(), doubleSided()) };
    wall.coverMeters = 0.0005;
    EXPECT_EQ(at(wall, kFar).backs, 0);
    EXPECT_EQ(at(wall, kFar).irradiance.x, 0);
    wall.coverMeters = 0.01;
    EXPECT_NEAR(at(wall, kFar).backs, 1, 0.05) << "grazing rays meet it further away";
    EXPECT_EQ(at(wall, 0.0005).backs, 0) << "nothing is so near";
}

// Two of the stated errors hold for 95.4 % of points.
TEST_F(BakedOcclusion, StaysWithinItsStatedError) {
    uint32_t within = 0;
    for (uint64_t i = 0; i < 400; ++i) {
        const TexelLight light = at(onFloor({ 0.5, 0, 0 }), kFar, 64, 100 + i);
        within += std::abs(light.irradiance.x - 0.5) <= 2 * light.standardError.x;
    }
    EXPECT_GT(within, 400 * 0.92);
}

/// What a texture says, in the world.
double3 decoded(std::span<const std::byte> texel, TextureFrame const& frame) {
    const double x = (std::to_integer<int>(texel[1]) - 128) / 127.0, y = (std::to_integer<int>(texel[2]) - 128) / 127.0;
    return frame.right * x + frame.up * y + frame.normal * std::sqrt(std::max(0.0, 1 - x * x - y * y));
}

// Whatever places of an atlas turn and mirror: what is read back is what was found.
TEST(OcclusionImage, HoldsDirectionsInTheFrameOfItsCharts) {
    std::mt19937 random(5);
    const auto unit = [&] { return double(random() >> 8) / 8388608.0 - 1; };
    jobs::JobSystem jobs({ .workers = 0 });
    for (int round = 0; round < 20; ++round) {
        BakeSurface surface;
        for (int i = 0; i < 3; ++i) surface.positions.push_back({ unit(), unit(), unit() });
        surface.indices = { 0, 1, 2 };
        const Result<Atlas> atlas = makeAtlas({ &surface, 1 }, { .texelsPerMeter = 8 }, jobs);
        ASSERT_TRUE(atlas);
        const std::vector<AtlasTexel> texels = findTexels(*atlas);
        if (texels.empty()) continue; // a sliver
        const double3 normal = pointOf(surface, texels[0]).normal;
        double3 open = normal + 0.8 * double3(unit(), unit(), unit());
        if (glm::dot(open, normal) < 0.1) open = normal;
        const std::vector<TexelLight> lights(
                texels.size(), { .irradiance = double3(0.25), .open = open * 0.3, .openness = 0.25, .samples = 32 });
        const OcclusionImage image = makeOcclusionImage({ &surface, 1 }, *atlas, texels, lights);
        for (AtlasTexel const& texel : texels) {
            const size_t index = size_t(texel.y) * image.visible.side + texel.x;
            const std::span<const std::byte> codes = std::span(image.rgba8).subspan(index * 4, 4);
            EXPECT_EQ(std::to_integer<int>(codes[0]), 64);
            EXPECT_EQ(std::to_integer<int>(codes[3]), 255);
            const TextureFrame frame = frameOf(surface, atlas->surfaces[0], texel);
            EXPECT_GT(glm::dot(decoded(codes, frame), glm::normalize(open)), 0.999) << round;
            EXPECT_NEAR(image.visible.texels[index].x, 64 / 255.0, 1e-12);
        }
    }
}

BakeSurface square(double z) {
    return { .positions = { { 0, 0, z }, { 1, 0, z }, { 1, 1, z }, { 0, 1, z } },
             .normals = {},
             .indices = { 0, 1, 2, 0, 2, 3 } };
}

// Loaders make the smaller levels by means of 2 x 2 texels: wherever they look, an even occlusion stays what it is.
TEST(OcclusionImage, HasTheMeanBetweenChartsOfAllPages) {
    jobs::JobSystem jobs({ .workers = 0 });
    const BakeSurface surfaces[] = { square(0), square(2), square(4) };
    const Result<Atlas> atlas =
            makeAtlas(surfaces, { .texelsPerMeter = 12, .maxSide = 40, .maxPages = 3, .levels = 4 }, jobs);
    ASSERT_TRUE(atlas) << atlas.error().message;
    ASSERT_GT(atlas->pages, 1u);
    const std::vector<AtlasTexel> texels = findTexels(*atlas);
    const std::vector<TexelLight> lights(texels.size(), { .irradiance = double3(0.25), .open = { 0, 0, 0.5 } });
    const OcclusionImage image = makeOcclusionImage(surfaces, *atlas, texels, lights);
    ASSERT_EQ(image.rgba8.size(), size_t(atlas->side) * atlas->side * atlas->pages * 4);
    for (size_t i = 0; i < image.rgba8.size(); i += 4) ASSERT_EQ(std::to_integer<int>(image.rgba8[i]), 64) << i / 4;
    EXPECT_TRUE(image.visible.smaller.empty());
}

} // namespace
} // namespace filament_core::bake
