// SPDX-License-Identifier: Apache-2.0
// Which reflection probes a view uses, in which order, and where their cubes lie: without a device.
#include "filament_core/prepare/PlaceProbes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <vector>

namespace filament_core::prepare {
namespace {

constexpr scene::CubeShape kShape{ Format::RGBA16F, 64, 5 };

backend::TextureHandle cubeNumber(uint32_t number) {
    backend::TextureHandle cube;
    cube.bits = number;
    return cube;
}

struct ProbeScene {
    scene::SceneData scene;
    Arena arena{ 1 << 16 };
    ViewInput view;
    HeldProbes held;
    shader::FrameUniforms uniforms{};
    jobs::JobSystem jobs{ { .workers = 1 } };
    std::vector<LitBox> lit{ { float3(0, 0, -20), float3(25) } }; ///< reaches all that is in view

    ProbeScene() {
        view.size = { 64, 64 };
        view.camera = Camera::lookAt({ 0, 0, 0 }, { 0, 0, -1 });
        uniforms.ambient = float4(3, 4, 3, 0);
        scene.indirectLight.specular = cubeNumber(100);
        scene.indirectLight.shape = kShape;
        scene.indirectLight.levelOfRoughnessOne = 4;
    }

    void add(uint32_t cube, double3 center, float half = 1) {
        scene.probes.index.add();
        scene.probes.records.push_back({ .centerWorld = center,
                                         .halfExtent = float3(half),
                                         .cube = cubeNumber(cube),
                                         .shape = kShape,
                                         .levelOfRoughnessOne = 4 });
    }

    ProbePacket place() {
        ViewPacket packet;
        packet.uniforms = uniforms;
        ProbePacket placed = placeProbes(jobs, arena, scene, view, held, lit, packet);
        uniforms = packet.uniforms;
        return placed;
    }

    /// The cubes of the records.
    static std::vector<uint32_t> cubesOf(ProbePacket const& packet) {
        std::vector<uint32_t> cubes;
        for (uint32_t i = 0; i < packet.used; ++i) {
            const auto layer = static_cast<size_t>(packet.uniforms->probes[i].irradianceSh[0].w);
            cubes.push_back(static_cast<uint32_t>(packet.cubes[layer].texture.bits));
        }
        return cubes;
    }
};

using Cubes = std::vector<uint32_t>;

TEST(PlaceProbes, TheSmallestComesFirst) {
    ProbeScene of;
    of.add(1, { 0, 0, -9 }, 3);
    of.add(2, { 0, 0, -5 }, 1);
    of.add(3, { 0, 0, -3 }, 2);
    const ProbePacket placed = of.place();
    EXPECT_EQ(ProbeScene::cubesOf(placed), (Cubes{ 2, 3, 1 }));
    EXPECT_EQ(placed.cubes[0].texture.bits, 100u) << "the environment's";
    EXPECT_TRUE(placed.addsEnvironment);
    EXPECT_LT(placed.uniforms->probes[3].axes[0].w, 0) << "a box without a point";
}

TEST(PlaceProbes, TheNearestOfTooManyAreUsed) {
    ProbeScene of;
    for (uint32_t i = 0; i < 12; ++i) of.add(i + 1, { 0, 0, -40.0 + 3 * i }); // the last are the nearest
    const ProbePacket placed = of.place();
    EXPECT_EQ(placed.used, 8u);
    EXPECT_EQ(placed.leftOut, 4u);
    EXPECT_EQ(ProbeScene::cubesOf(placed), (Cubes{ 5, 6, 7, 8, 9, 10, 11, 12 }));
    EXPECT_EQ(placed.uses[3], ProbeUse::OverLimit);
    EXPECT_EQ(placed.uses[4], ProbeUse::Used);
}

TEST(PlaceProbes, WhatTheViewDoesNotSeeOrCannotCopyIsLeftOut) {
    ProbeScene of;
    of.add(1, { 0, 0, 5 });
    of.add(2, { 0, 0, -5 });
    of.add(3, { 0, 0, -5 });
    of.scene.probes.records[2].shape.size = 32;
    ProbePacket placed = of.place();
    EXPECT_EQ(placed.outOfReach, 1u);
    EXPECT_EQ(placed.leftOut, 1u);
    EXPECT_EQ(placed.uses[2], ProbeUse::OtherShape);
    of.scene.indirectLight.shape.format = of.scene.probes.records[1].shape.format = Format::RGB9E5;
    EXPECT_EQ(of.place().uses[1], ProbeUse::NotCopyable);
    of.held.hasArrays = false;
    placed = of.place();
    EXPECT_TRUE(placed.empty());
    EXPECT_EQ(placed.uses[1], ProbeUse::NoArrays);
}

TEST(PlaceProbes, ACubeStaysInItsLayer) {
    ProbeScene of;
    of.add(1, { 0, 0, -9 }, 3);
    of.add(2, { 0, 0, -5 }, 2);
    const ProbePacket first = of.place();
    of.held.cubes = first.cubes;
    of.held.shape = first.shape;
    of.add(3, { 0, 0, -3 }, 1);
    const ProbePacket second = of.place();
    for (size_t layer = 0; layer < 3; ++layer) EXPECT_EQ(second.cubes[layer], first.cubes[layer]) << layer;
    EXPECT_EQ(second.cubes[3].texture.bits, 3u);
    of.held.shape.size = 32; // another array: all are placed anew
    EXPECT_EQ(of.place().cubes[1].texture.bits, 3u);
}

TEST(PlaceProbes, FactorsAreThoseOfNitsBeforeTheFactorOfTheEnvironment) {
    ProbeScene of;
    of.add(1, { 0, 0, -5 });
    of.scene.probes.records[0].intensity = 7;
    const float exposure = of.view.camera.exposure.factor();
    EXPECT_FLOAT_EQ(of.place().uniforms->probes[0].capture.w * 3, 7 * exposure) << "ambient.x is 3";
    of.scene.indirectLight.specular = {};
    of.uniforms.ambient.x = 0;
    const ProbePacket alone = of.place();
    EXPECT_FALSE(alone.addsEnvironment);
    EXPECT_FLOAT_EQ(of.uniforms.ambient.x, exposure);
    EXPECT_FLOAT_EQ(alone.uniforms->probes[0].capture.w, 7);
}

TEST(PlaceProbes, WithoutProbesOrLitSurfacesThereIsNothing) {
    ProbeScene of;
    EXPECT_TRUE(of.place().uses.empty());
    of.add(1, { 0, 0, -5 });
    of.lit.clear();
    EXPECT_TRUE(of.place().empty());
}

TEST(PlaceProbes, ABoxThatReachesNoLitSurfaceIsLeftOut) {
    ProbeScene of;
    of.add(1, { 0, 0, -5 }, 1);
    of.scene.probes.records[0].blendMeters = 0.5f;
    const auto usesWith = [&](float3 center, float3 half) {
        of.lit = { { center, half } };
        return of.place().used;
    };
    EXPECT_EQ(usesWith({ 3, 0, -5 }, float3(1.51f, 1, 1)), 1u) << "in the blend distance";
    EXPECT_EQ(usesWith({ 3, 0, -5 }, float3(1.49f, 1, 1)), 0u);
    EXPECT_EQ(usesWith(kUnlitBox.center, kUnlitBox.halfExtent), 0u);
    of.scene.probes.records[0].worldFromBox = float3x3(glm::rotate(float4x4(1), 0.7853982f, float3(0, 1, 0)));
    EXPECT_EQ(usesWith({ 3, 0, -5 }, float3(1.2f, 1, 0.01f)), 1u) << "a corner of the turned box is nearer";
}

TEST(PlaceProbes, TheEnvironmentIsLeftOutWhereEachSurfaceIsInABox) {
    ProbeScene of;
    of.add(1, { 0, 0, -15 }, 2);
    of.add(2, { 5, 0, -15 }, 2);
    of.lit = { { float3(0, 0, -15), float3(2) }, { float3(5, 0, -15), float3(1) } };
    EXPECT_FALSE(of.place().addsEnvironment);
    of.lit.push_back({ float3(2.5f, 0, -15), float3(0.6f) });
    EXPECT_TRUE(of.place().addsEnvironment) << "between the boxes";
    of.lit.pop_back();
    of.scene.probes.records[1].lightsDiffuse = false;
    EXPECT_TRUE(of.place().addsEnvironment) << "its diffuse light is the environment's";
}

TEST(PlaceProbes, TheNumberOfWorkersChangesNoBit) {
    ProbeScene of;
    for (uint32_t i = 0; i < 70; ++i) of.add(i + 1, { i % 10 - 5.0, i / 10 - 3.0, -12 }, 0.4f);
    of.lit.clear();
    for (int i = 0; i < 20'000; ++i)
        of.lit.push_back({ float3(float2(i % 140, i / 140 % 100) * 0.1f - float2(7, 5), -12), float3(0.02f) });
    const ProbePacket one = of.place();
    jobs::JobSystem four{ { .workers = 4 } };
    ViewPacket packet;
    packet.uniforms = of.uniforms;
    const ProbePacket other = placeProbes(four, of.arena, of.scene, of.view, of.held, of.lit, packet);
    EXPECT_EQ(std::memcmp(one.uniforms, other.uniforms, sizeof(shader::ProbeUniforms)), 0);
    EXPECT_TRUE(std::ranges::equal(one.uses, other.uses));
    EXPECT_EQ(one.addsEnvironment, other.addsEnvironment);
}

} // namespace
} // namespace filament_core::prepare
