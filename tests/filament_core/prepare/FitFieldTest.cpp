// SPDX-License-Identifier: Apache-2.0
// Fields of light over boxes, against closed forms; and which draws of a view have one.
#include "filament_core/prepare/FitField.h"
#include "filament_core/prepare/PlaceGrids.h"
#include "tests/filament_core/prepare/BoxScene.h"
#include "tests/scenes/GridOf.h"

#include <glm/ext/matrix_transform.hpp>
#include <gtest/gtest.h>

namespace filament_core::prepare {
namespace {

using scene::GridRecord;
using scene::gridRecord;
using scenes::ambientOf;
using scenes::gridOf;

const IrradianceSh kBlack{};
const float3 kSlope(1, -2, 0.5f);

IrradianceSh linearLight(float3 p) {
    IrradianceSh light{};
    light[0] = float3(10 + glm::dot(p, kSlope));
    light[1] = float3(2 * p.x, 0, 0);
    light[4] = float3(0, 1, 0);
    return light;
}

LightField fieldOf(IrradianceGridDesc const& desc, FieldBox const& box, IrradianceSh const& environment = kBlack) {
    const GridRecord record = gridRecord(desc);
    GridRecord const* const list = &record;
    return fitField(std::span(&list, 1), environment, box);
}

TEST(FitField, UniformLightHasNoChangeAndNoError) {
    const IrradianceGridDesc grid = gridOf(float3(2), uint3(3), [](float3) { return ambientOf({ 1, 2, 3 }); });
    for (const float3 half : { float3(0), float3(0.5f), float3(1.5f, 0.01f, 1), float3(50) }) {
        const LightField field = fieldOf(grid, { double3(0.2), half });
        if (half.x > 2) continue; // reaches out of the grid
        EXPECT_LT(glm::length(field.middle[0] - float3(1, 2, 3)), 1e-5f);
        for (float3 const& change : field.change[0]) EXPECT_LT(glm::length(change), 1e-5f);
        EXPECT_LT(field.error, 1e-5f);
    }
}

TEST(FitField, LinearLightIsExact) {
    const LightField field =
            fieldOf(gridOf(float3(2), { 3, 4, 5 }, linearLight), { { 0.25, -0.5, 0.5 }, { 0.5f, 0.25f, 1 } });
    const float3 at(0.25f, -0.5f, 0.5f);
    EXPECT_NEAR(field.middle[0].x, 10 + glm::dot(at, kSlope), 1e-4f);
    EXPECT_NEAR(field.change[0][0].y, 0.5f * kSlope.x, 1e-4f);
    EXPECT_NEAR(field.change[0][1].y, 0.25f * kSlope.y, 1e-4f);
    EXPECT_NEAR(field.change[0][2].y, 1 * kSlope.z, 1e-4f);
    EXPECT_NEAR(field.middle[1].x, 0.5f, 1e-4f);
    EXPECT_NEAR(field.change[1][0].x, 1, 1e-4f);
    EXPECT_NEAR(field.constant[0].y, 1, 1e-5f);
    EXPECT_LT(field.error, 1e-4f);
}

TEST(FitField, ABoxWithoutExtentHasTheLightOfItsPoint) {
    const LightField field = fieldOf(gridOf(float3(2), uint3(3), linearLight), { { 0.5, 0, -0.5 }, float3(0) });
    EXPECT_NEAR(field.middle[0].x, 10 + glm::dot(float3(0.5f, 0, -0.5f), kSlope), 1e-4f);
    for (float3 const& change : field.change[0]) EXPECT_LT(glm::length(change), 1e-4f);
}

TEST(FitField, OneProbeLightsTheWholeBoxOfItsGrid) {
    const LightField field = fieldOf(gridOf(float3(2), uint3(1), [](float3) { return ambientOf(float3(4)); }),
                                     { double3(1), float3(1) });
    EXPECT_NEAR(field.middle[0].x, 4, 1e-5f);
}

TEST(FitField, ItIsTheSameFarFromTheOrigin) {
    const double3 far(1e8, -3e8, 7e7);
    IrradianceGridDesc grid = gridOf(float3(2), uint3(3), linearLight);
    const FieldBox box{ { 0.5, 0.25, -0.5 }, float3(0.5f) };
    const LightField near = fieldOf(grid, box);
    grid.centerWorld = far;
    const LightField away = fieldOf(grid, { box.centerWorld + far, box.halfExtent });
    EXPECT_EQ(near.middle, away.middle);
    EXPECT_EQ(near.change, away.change);
}

TEST(FitField, ATurnedGridTurnsItsLight) {
    const double3x3 turn(glm::rotate(double4x4(1.0), glm::radians(90.0), double3(0, 0, 1))); // x goes to y
    IrradianceGridDesc grid = gridOf(float3(2, 3, 2), uint3(3), [](float3 p) {
        IrradianceSh light = ambientOf(float3(5 + p.x));
        light[3] = float3(1); // from +x of the box
        return light;
    });
    grid.worldFromBox = float3x3(turn);
    const LightField field = fieldOf(grid, { double3(0), float3(1) });
    EXPECT_NEAR(field.change[0][1].x, 1, 1e-4f); // brighter towards +y of the world
    EXPECT_NEAR(field.change[0][0].x, 0, 1e-4f);
    EXPECT_NEAR(field.middle[1].x, 1, 1e-5f); // and from +y
    EXPECT_NEAR(field.middle[3].x, 0, 1e-5f);
}

TEST(FitField, BetweenGridAndEnvironmentTheLightBlends) {
    IrradianceGridDesc grid = gridOf(float3(1), uint3(2), [](float3) { return ambientOf(float3(1)); });
    grid.blendMeters = 2;
    const LightField field = fieldOf(grid, { { 2, 0, 0 }, float3(0) }, ambientOf(float3(5)));
    EXPECT_NEAR(field.middle[0].x, 0.5f * 1 + 0.5f * 5, 1e-4f);
    EXPECT_TRUE(reaches(gridRecord(grid), { { 3.4, 0, 0 }, float3(0.5f) }));
    EXPECT_FALSE(reaches(gridRecord(grid), { { 3.6, 0, 0 }, float3(0.5f) }));
}

TEST(FitField, ABoxThatAllProbesAreHiddenFromHasTheirLightAllTheSame) {
    IrradianceGridDesc grid = gridOf(float3(1), uint3(2), [](float3) { return ambientOf(float3(3)); });
    auto probes = std::make_shared<IrradianceProbes>(*grid.probes);
    probes->depthSize = 1;
    probes->depths.assign(probes->probes.size(), float2(1e-3f, 1e-6f)); // each is in a tiny box
    grid.probes = probes;
    EXPECT_NEAR(fieldOf(grid, { double3(0), float3(0.5f) }, ambientOf(float3(100))).middle[0].x, 3, 1e-4f);
    for (IrradianceProbe& probe : probes->probes) probe.isInside = true;
    EXPECT_NEAR(fieldOf(grid, { double3(0), float3(0.5f) }, ambientOf(float3(100))).middle[0].x, 100, 1e-3f);
}

TEST(FitField, AWallHasTheLightOfBothItsSides) {
    IrradianceGridDesc grid = gridOf(float3(2), { 4, 3, 3 }, [](float3 p) {
        IrradianceSh light = ambientOf(float3(p.x < 0 ? 1 : 100));
        light[8] = float3(p.x < 0 ? 0 : 20); // x^2 - y^2, of the bright side alone
        return light;
    });
    auto probes = std::make_shared<IrradianceProbes>(*grid.probes);
    probes->depthSize = 8;
    for (size_t i = 0; i < probes->probes.size(); ++i) { // they see 0.6 m, up to the wall, in all directions
        for (int texel = 0; texel < 64; ++texel) probes->depths.emplace_back(0.6f, 0.36f);
    }
    grid.probes = probes;
    const LightField field = fieldOf(grid, { double3(0), { 0.07f, 0.02f, 0.02f } });
    EXPECT_NEAR(field.middle[0].x - field.change[0][0].x, 1, 0.1f);
    EXPECT_NEAR(field.middle[0].x + field.change[0][0].x, 100, 2);
    EXPECT_LT(field.constant[4].x, 0.2f); // the dark side would be lit by it
}

// ------------------------------------------------------------------------------------------------ in a view

struct GridsInView : testing::Test, BoxScene {
    Arena arena;
    ViewInput view{ .camera = Camera::lookAt({ 0, 0, 10 }, { 0, 0, 0 }),
                    .size = { 640, 480 },
                    .quality = { .shadows = ShadowFilter::Off } };

    scene::MaterialInstance* lit() {
        scene::MaterialInstance* instance = material();
        materials.back().package.shading = shader::ShadingModel::Lit;
        return instance;
    }
    void addGrid(IrradianceGridDesc const& desc) {
        scene.grids.index.add();
        scene.grids.records.push_back(gridRecord(desc));
        ++scene.grids.changes;
    }
    FramePacket prepare(int workers = 0, FieldCache* cache = nullptr) {
        jobs::JobSystem jobs{ { .workers = workers } };
        return prepareFrame(jobs, arena, scene, std::span(&view, 1), {}, {}, {}, cache);
    }
};

TEST_F(GridsInView, OnlyLitDrawsInAGridHaveFields) {
    addGrid(gridOf(float3(1), uint3(2), linearLight));
    auto* shaded = lit();
    auto* unlit = material();
    materials.back().package.shading = shader::ShadingModel::Unlit;
    add({ 0, 0, 0 }, shaded, 1);
    add({ 3, 0, 0 }, shaded, 2);
    add({ 0, 0, 0 }, unlit, 3);
    const FramePacket packet = prepare();
    EXPECT_EQ(packet.grids.fields.size(), 1u);
    uint32_t with = 0;
    for (DrawCall const& draw : packet.mainView().opaque) with += draw.firstField != kNowhere ? 1 : 0;
    EXPECT_EQ(with, 1u);
    EXPECT_TRUE(packet.demand.needs(Effect::IrradianceGrids));
}

TEST_F(GridsInView, AllInstancesOfADrawHaveFields) {
    addGrid(gridOf(float3(1), uint3(2), linearLight));
    auto* shaded = lit();
    for (int i = -2; i <= 2; ++i) add({ i * 1.0, 0, 0 }, shaded);
    const FramePacket packet = prepare();
    ASSERT_EQ(packet.mainView().opaque.size(), 1u);
    EXPECT_EQ(packet.grids.fields.size(), 5u);
}

TEST_F(GridsInView, OutOfViewTheyGiveThePacketOfASceneWithoutThem) {
    add({ 0, 0, 0 }, lit());
    const uint64_t without = hashPacket(prepare());
    IrradianceGridDesc behind = gridOf(float3(1), uint3(2), linearLight);
    behind.centerWorld = { 0, 0, 50 };
    addGrid(behind);
    EXPECT_EQ(hashPacket(prepare()), without);
    EXPECT_FALSE(prepare().demand.needs(Effect::IrradianceGrids));
}

TEST_F(GridsInView, FieldsAreTheSameForAnyNumberOfWorkersAndFromEarlierFrames) {
    addGrid(gridOf(float3(4), { 5, 4, 3 }, linearLight));
    auto* shaded = lit();
    Random random(7);
    std::vector<Renderable> boxes;
    for (int i = 0; i < 200; ++i)
        boxes.push_back(add({ random.within(-4, 4), random.within(-3, 3), random.within(-6, 2) }, shaded, 1 + i % 3,
                            random.within(0.1, 3)));
    const uint64_t expected = hashPacket(prepare(0));
    for (const int workers : { 1, 2, 3, 16 }) EXPECT_EQ(hashPacket(prepare(workers)), expected) << workers;
    FieldCache cache;
    const FramePacket first = prepare(0, &cache);
    EXPECT_EQ(hashPacket(first), expected);
    EXPECT_EQ(first.grids.evaluated, first.grids.fields.size());
    EXPECT_GT(first.grids.evaluated, 50u);
    const FramePacket second = prepare(0, &cache);
    EXPECT_EQ(hashPacket(second), expected);
    EXPECT_EQ(second.grids.evaluated, 0u);

    double4x4 world(1.0);
    world[3] = double4(0.5, 0, 0, 1);
    setTransform(scene, boxes.front(), world);
    EXPECT_EQ(prepare(0, &cache).grids.evaluated, 1u);
    ++scene.grids.changes;
    EXPECT_EQ(prepare(0, &cache).grids.evaluated, first.grids.evaluated);
}

} // namespace
} // namespace filament_core::prepare
