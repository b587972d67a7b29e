// SPDX-License-Identifier: Apache-2.0
// Froxel lists must not miss a light. The light's formulas are those of the shaders, compiled as C++.
#include "filament_core/prepare/Froxels.h"

#include "filament_core/prepare/SelectLights.h"
#include "shaders/lib/LibCpp.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace filament_core::prepare {
namespace {

using scene::LightRecord;
using shader::PunctualLight;

constexpr FroxelOptions kAlways{ .fewest = 1 };

/// A view with the lights of a scene, in lists.
struct Assigned {
    ViewSpace space;
    shader::FrameUniforms frame{};
    ViewCounts counts;
    std::span<const PunctualLight> lights;
    std::span<const uint32_t> words;

    /// The lights of a froxel; of none: all.
    bool has(std::optional<uint32_t> froxel, uint32_t light) const {
        if (!froxel) return true;
        const std::span list = listOf(*froxel);
        return std::ranges::find(list, light) != list.end();
    }
    std::span<const uint32_t> listOf(uint32_t froxel) const {
        const uint32_t word = words[froxel];
        return words.subspan(word >> shader::kFroxelCountBits, word & ((1u << shader::kFroxelCountBits) - 1));
    }
};

struct FroxelsTest : testing::Test {
    jobs::JobSystem jobs{ { .workers = 1 } };
    Arena arena;

    Assigned assign(ViewInput const& view, scene::SceneData const& scene, FroxelOptions const& options = kAlways) {
        arena.reset();
        Assigned result{ .space = makeViewSpace(view) };
        writeFrameUniforms(result.frame, result.space, view, scene);
        result.lights = LightSelector(arena, scene.lights).select(result.space, result.frame, result.counts).lights;
        result.words =
                assignLights(jobs, arena, result.space, view.size, result.lights, result.frame, result.counts, options)
                        .words;
        return result;
    }
};

double3 randomDirection(Random& random) {
    for (;;) {
        const double3 d(random.within(-1, 1), random.within(-1, 1), random.within(-1, 1));
        const double length = glm::length(d);
        if (length > 0.1 && length < 1) return d / length;
    }
}

double logarithmic(Random& random, double low, double high) {
    return std::exp(random.within(std::log(low), std::log(high)));
}

// Perspective, off-centre, or parallel; reversed depth as Camera::clipFromView().
std::optional<float4x4> randomLens(Random& random, double scale) {
    const uint32_t kind = random.next() % 3;
    if (kind == 0) return {};
    float4x4 clip(0.0f);
    clip[0][0] = static_cast<float>(random.within(0.3, 4));
    clip[1][1] = -clip[0][0] * static_cast<float>(random.within(0.5, 2));
    if (kind == 1) {
        clip[2][0] = static_cast<float>(random.within(-1, 1)), clip[2][1] = static_cast<float>(random.within(-1, 1));
        clip[2][3] = -1, clip[3][2] = static_cast<float>(0.01 * scale);
        return clip;
    }
    clip[0][0] /= static_cast<float>(scale), clip[1][1] /= static_cast<float>(scale);
    clip[2][2] = static_cast<float>(0.001 / scale);
    clip[3] = float4(random.within(-1, 1), random.within(-1, 1), 1, 1);
    return clip;
}

/// A view somewhere in the world, and a size of what it sees: from a millimetre to 100 km.
struct RandomView {
    double scale;
    double3 eye;
    ViewInput view;

    explicit RandomView(Random& random)
            : scale(logarithmic(random, 1e-3, 1e5)), eye(randomDirection(random) * random.within(0, 1e7)) {
        const auto fov = static_cast<float>(random.within(0.5, 170));
        view.camera = Camera::lookAt(eye, eye + randomDirection(random),
                                     { fov, static_cast<float>(logarithmic(random, 1e-4, 1e-1) * scale) });
        view.clipFromView = randomLens(random, scale);
        view.size = { 1 + random.next() % 2000, 1 + random.next() % 2000 };
        if (random.next() % 2) view.quality.depthRange = DepthRange::Ordinary;
        if (random.next() % 2) view.quality.cameraRelative = false;
    }
};

/// In front of, behind and around the camera; some unlimited, some spots of 0.005 to 89.5 degrees.
LightRecord randomLight(Random& random, RandomView const& view) {
    LightRecord light{ .type = random.next() % 2 ? LightRecord::Type::Spot : LightRecord::Type::Point };
    light.positionWorld = view.eye + randomDirection(random) * logarithmic(random, 1e-2, 10) * view.scale;
    light.directionWorld = float3(randomDirection(random));
    light.intensity = static_cast<float>(logarithmic(random, 1e-3, 1e9));
    light.rangeMeters = random.next() % 20 ? static_cast<float>(logarithmic(random, 1e-3, 3) * view.scale) : 0.0f;
    light.outerConeRadians = static_cast<float>(logarithmic(random, 8.7e-5, 1.562));
    light.innerConeRadians = light.outerConeRadians * static_cast<float>(random.within(0, 1));
    if (random.next() % 3 == 0) {
        light.type = static_cast<LightRecord::Type>(3 + random.next() % 3); // areas, maybe larger than their range
        light.sideWorld = float3(randomDirection(random));
        light.halfExtent = float2(logarithmic(random, 1e-4, 1), logarithmic(random, 1e-4, 1)) * float(view.scale);
    }
    return light;
}

/// What the shader computes before it shades; 0: it skips the light.
float attenuationAt(PunctualLight const& light, float3 point) {
    namespace lib = shader::lib;
    const float3 toLight = float3(light.positionRange) - point;
    if (light.colorIntensity.w > 1) return lib::rangeWindow(toLight, light.positionRange.w);
    float attenuation = lib::distanceAttenuation(toLight, light.positionRange.w);
    if (light.colorIntensity.w > 0 && attenuation > 0) {
        const float length = glm::length(toLight);
        const float3 direction = length > 0 ? toLight / length : float3(0);
        attenuation *=
                lib::spotAttenuation(direction, float3(light.directionScale), light.directionScale.w, light.offset.x);
    }
    return attenuation;
}

/// A point that a light may just reach or just not: inside, at the end of the range, or at the side of the cone.
float3 pointNear(Random& random, PunctualLight const& light, double scale) {
    const double range = light.positionRange.w > 0 ? 1 / std::sqrt(double{ light.positionRange.w }) : scale;
    double3 direction = randomDirection(random);
    if (light.colorIntensity.w == 1) {
        const double3 axis(light.directionScale);
        const double cosine = std::clamp(double{ -light.offset.x / light.directionScale.w }, -1.0, 1.0);
        const double angle = std::acos(cosine) * (random.next() % 2 ? random.within(0, 1) : 0.999999);
        const double3 side = glm::normalize(glm::cross(axis, direction));
        direction = axis * std::cos(angle) + side * std::sin(angle);
    }
    const double distance = range * (random.next() % 2 ? random.within(0, 1) : 1 - random.within(0, 1e-6));
    return float3(double3(light.positionRange) + direction * distance);
}

TEST_F(FroxelsTest, AFroxelHasEveryLightThatReachesAPointInIt) {
    uint32_t reached = 0, inFroxels = 0;
    for (uint32_t seed = 0; seed < 600; ++seed) {
        Random random(seed);
        const RandomView view(random);
        BoxScene boxes;
        for (int i = 0; i < 60; ++i) addLight(boxes.scene, randomLight(random, view));
        const Assigned assigned = assign(view.view, boxes.scene);
        for (uint32_t i = 0; i < assigned.lights.size(); ++i) {
            for (int k = 0; k < 20; ++k) {
                const float3 point = pointNear(random, assigned.lights[i], view.scale);
                if (!(attenuationAt(assigned.lights[i], point) > 0)) continue;
                ++reached;
                if (assigned.words.empty()) continue;
                const std::optional<uint32_t> froxel = froxelAt(assigned.frame, point);
                inFroxels += froxel.has_value();
                ASSERT_TRUE(assigned.has(froxel, i)) << "seed " << seed << ", light " << i << ", froxel " << *froxel;
            }
        }
    }
    EXPECT_GT(reached, 100'000u);
    EXPECT_GT(inFroxels, reached / 4) << "the test looks where there are lists";
}

// Points on borders of tiles and slices which a light barely reaches, seen by a parallel projection far from the
// origin: the worst case of the margins.
uint32_t missesAtBorders(FroxelsTest& test, FroxelMargins margins) {
    uint32_t misses = 0;
    for (uint32_t seed = 0; seed < 400; ++seed) {
        Random random(seed);
        ViewInput view{ .camera = Camera::lookAt({ 0, 0, 0 }, randomDirection(random)), .size = { 160, 90 } };
        float4x4 clip(0.0f);
        clip[0][0] = 0.1f, clip[1][1] = -0.17f, clip[2][2] = 1e-4f, clip[3] = float4(0.3f, 0.2f, 1, 1);
        if (seed % 2) view.clipFromView = clip;
        const ViewSpace space = makeViewSpace(view);
        const FroxelGrid grid = makeFroxelGrid(view.size, 1, 100);
        const TileAxes axes = *tileAxes(grid, space.clipFromView);
        BoxScene boxes;
        for (int i = 0; i < 200; ++i) {
            const float depth =
                    i % 2 ? static_cast<float>(random.within(2, 50)) : grid.sliceBegin(1 + random.next() % 20);
            const auto border = static_cast<float>(1 + random.next() % (grid.columns - 1));
            const double x = axes.x.borderOf(border, depth), y = axes.y.borderOf(4.5f, depth);
            const double range = random.within(0.05, 0.9) * depth, side = random.next() % 2 ? 1 : -1;
            const double3 away = i % 2 ? double3(side, 0, 0) : double3(0, 0, side);
            const double3 center = double3(x, y, -depth) + away * range * (1 - 1e-7);
            const double3 world = glm::transpose(double3x3(space.viewFromWorld)) * center;
            addLight(boxes.scene, { .type = LightRecord::Type::Point,
                                    .positionWorld = world,
                                    .intensity = 1,
                                    .rangeMeters = static_cast<float>(range) });
        }
        const Assigned assigned = test.assign(view, boxes.scene, { .fewest = 1, .margins = margins });
        for (uint32_t i = 0; i < assigned.lights.size(); ++i) {
            PunctualLight const& light = assigned.lights[i];
            const float3 center(light.positionRange);
            const float range = 1 / std::sqrt(light.positionRange.w);
            for (const float3 axis : { float3(1, 0, 0), float3(-1, 0, 0), float3(0, 0, 1), float3(0, 0, -1) }) {
                const float3 away = glm::transpose(float3x3(space.viewFromWorld)) * axis;
                for (const float step : { 1.0f, 1 - 6e-8f, 1 - 2e-7f, 1 - 1e-6f }) {
                    const float3 point = center + away * (range * step);
                    if (attenuationAt(light, point) > 0) misses += !assigned.has(froxelAt(assigned.frame, point), i);
                }
            }
        }
    }
    return misses;
}

TEST_F(FroxelsTest, MarginsCoverTheRoundingAtBordersAndAreNeeded) {
    EXPECT_EQ(missesAtBorders(*this, {}), 0u);
    EXPECT_EQ(missesAtBorders(*this, { .factor = 0.25f }), 0u) << "there is some left";
    EXPECT_GT(missesAtBorders(*this, { .factor = 0 }), 0u) << "without margins lights are missed";
    EXPECT_GT(missesAtBorders(*this, { .factor = -1 }), 0u);
}

TEST_F(FroxelsTest, SmallLightsAreInFewFroxels) {
    BoxScene boxes;
    Random random(1);
    for (int i = 0; i < 500; ++i) {
        addLight(boxes.scene, { .type = LightRecord::Type::Point,
                                .positionWorld = { random.within(-5, 5), random.within(-5, 5), random.within(-20, -5) },
                                .intensity = 1,
                                .rangeMeters = 0.5f });
    }
    const Assigned assigned =
            assign({ .camera = Camera::lookAt({ 0, 0, 0 }, { 0, 0, -1 }), .size = { 1280, 720 } }, boxes.scene);
    EXPECT_EQ(assigned.counts.froxels,
              assigned.frame.froxelGrid.x * assigned.frame.froxelGrid.y * assigned.frame.froxelGrid.z);
    EXPECT_GT(assigned.counts.froxelEntries, 0u);
    EXPECT_LT(assigned.counts.froxelEntries, 500u * 40) << "of " << assigned.counts.froxels << " each";
}

TEST_F(FroxelsTest, ANarrowSpotIsInFewerFroxelsThanItsSphere) {
    BoxScene boxes;
    addLight(boxes.scene, { .type = LightRecord::Type::Spot,
                            .positionWorld = { -5, 0, -10 },
                            .directionWorld = { 1, 0, 0 },
                            .intensity = 1,
                            .rangeMeters = 10,
                            .innerConeRadians = 0.05f,
                            .outerConeRadians = 0.1f });
    const ViewInput view{ .camera = Camera::lookAt({ 0, 0, 0 }, { 0, 0, -1 }), .size = { 1280, 720 } };
    const uint32_t spot = assign(view, boxes.scene).counts.froxelEntries;
    boxes.scene.lights.records[0].type = LightRecord::Type::Point;
    const uint32_t point = assign(view, boxes.scene).counts.froxelEntries;
    EXPECT_GT(spot, 0u);
    EXPECT_LT(spot, point / 8);
}

TEST_F(FroxelsTest, AFullFroxelKeepsItsBrightestLightsInOrder) {
    BoxScene boxes;
    for (uint32_t i = 0; i < 400; ++i) {
        addLight(boxes.scene, { .type = LightRecord::Type::Point,
                                .positionWorld = { 0, 0, -10 },
                                .intensity = 1.0f + static_cast<float>(i * 7 % 400),
                                .rangeMeters = 1 });
    }
    const Assigned assigned =
            assign({ .camera = Camera::lookAt({ 0, 0, 0 }, { 0, 0, -1 }), .size = { 1280, 720 } }, boxes.scene);
    const std::optional<uint32_t> froxel = froxelAt(assigned.frame, { 0, 0, -10 });
    ASSERT_TRUE(froxel);
    const std::span<const uint32_t> list = assigned.listOf(*froxel);
    ASSERT_EQ(list.size(), shader::kMaxLightsOfFroxel);
    EXPECT_TRUE(std::ranges::is_sorted(list));
    for (const uint32_t light : list) EXPECT_GE(light * 7 % 400, 400 - shader::kMaxLightsOfFroxel) << light;
    EXPECT_GT(assigned.counts.fullFroxels, 0u);
    EXPECT_EQ(assigned.counts.lightsLeftOut, assigned.counts.fullFroxels * (400 - shader::kMaxLightsOfFroxel));
    EXPECT_EQ(assigned.counts.longestFroxel, shader::kMaxLightsOfFroxel);
}

TEST_F(FroxelsTest, FewOrOnlyUnlimitedLightsAreOneListWithoutBytes) {
    BoxScene boxes;
    const ViewInput view{ .camera = Camera::lookAt({ 0, 0, 0 }, { 0, 0, -1 }), .size = { 1280, 720 } };
    EXPECT_TRUE(assign(view, boxes.scene).words.empty()) << "no lights";
    const LightRecord lamp{ .type = LightRecord::Type::Point, .positionWorld = { 0, 0, -5 }, .intensity = 1 };
    for (int i = 0; i < 100; ++i) addLight(boxes.scene, lamp);
    const Assigned unlimited = assign(view, boxes.scene);
    EXPECT_TRUE(unlimited.words.empty());
    EXPECT_EQ(unlimited.frame.froxelGrid, float4(0));
    BoxScene few;
    for (size_t i = 0; i + 1 < kLightsWorthAGrid; ++i) {
        addLight(few.scene, lamp);
        few.scene.lights.records.back().rangeMeters = 1;
    }
    EXPECT_TRUE(assign(view, few.scene, {}).words.empty());
}

TEST_F(FroxelsTest, ALightThatIsNotANumberIsEverywhere) {
    BoxScene boxes;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const LightRecord lamp{
        .type = LightRecord::Type::Point, .positionWorld = { 0, 0, -5 }, .intensity = 1, .rangeMeters = 1
    };
    addLight(boxes.scene, lamp);
    addLight(boxes.scene, lamp);
    boxes.scene.lights.records[0].positionWorld.x = nan;
    const Assigned assigned =
            assign({ .camera = Camera::lookAt({ 0, 0, 0 }, { 0, 0, -1 }), .size = { 1280, 720 } }, boxes.scene);
    ASSERT_EQ(assigned.lights.size(), 2u);
    for (uint32_t froxel = 0; froxel < assigned.counts.froxels; ++froxel) EXPECT_TRUE(assigned.has(froxel, 0));
}

TEST_F(FroxelsTest, ListsAreTheSameForAnyNumberOfWorkers) {
    BoxScene boxes;
    Random random(3);
    const RandomView view(random);
    for (int i = 0; i < 3000; ++i) addLight(boxes.scene, randomLight(random, view));
    const Assigned reference = assign(view.view, boxes.scene);
    ASSERT_FALSE(reference.words.empty());
    const std::vector<uint32_t> expected(reference.words.begin(), reference.words.end());
    for (const int workers : { 0, 2, 3, 16 }) {
        jobs::JobSystem other({ .workers = workers });
        Assigned again = reference;
        Arena memory;
        again.words = assignLights(other, memory, reference.space, view.view.size, reference.lights, again.frame,
                                   again.counts, kAlways)
                              .words;
        EXPECT_TRUE(std::ranges::equal(again.words, expected)) << workers;
    }
}

} // namespace
} // namespace filament_core::prepare
