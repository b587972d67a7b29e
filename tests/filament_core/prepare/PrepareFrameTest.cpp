// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PrepareFrame.h"

#include "filament_core/prepare/LastFrame.h"
#include "filament_core/prepare/ObjectData.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <memory>
#include <vector>

namespace filament_core::prepare {
namespace {

using scene::LightRecord;

struct PrepareFrameTest : testing::Test, BoxScene {
    jobs::JobSystem jobs{ { .workers = 1 } };
    Arena arena;
    ViewInput view{ .camera = Camera::lookAt({ 0, 0, 10 }, { 0, 0, 0 }),
                    .size = { 640, 480 },
                    .quality = { .shadows = ShadowFilter::Off } };

    ViewPacket prepare() { return prepareFrame(jobs, arena, scene, view).mainView(); }

    std::vector<shader::ObjectData> objectsOf(ViewPacket const& packet) {
        std::vector<shader::ObjectData> objects(packet.objects.size());
        writeObjects(jobs, packet.objects, objects);
        return objects;
    }
};

TEST_F(PrepareFrameTest, DropsWhatTheCameraCannotSeeAndSaysWhy) {
    auto* opaque = material(shader::Blending::Opaque);
    add({ 0, 0, 0 }, opaque);
    add({ 0, 0, 20 }, opaque);
    add({ 100, 0, 0 }, opaque);
    const ViewPacket packet = prepare();
    EXPECT_EQ(packet.counts.renderables, 3u);
    EXPECT_EQ(packet.counts.visible, 1u);
    EXPECT_EQ(packet.counts.outOfView, 2u);
    EXPECT_EQ(packet.objects.size(), 1u);
}

TEST_F(PrepareFrameTest, PositionsAreRelativeToTheCameraAtAnyDistanceFromTheOrigin) {
    auto* opaque = material(shader::Blending::Opaque);
    const Renderable box = add({ 0.25, 0, 0 }, opaque);
    const shader::ObjectData reference = objectsOf(prepare())[0];

    const double3 far(1e7, -3e6, 5e6);
    setTransform(scene, box, [&] {
        double4x4 world(1.0);
        world[3] = double4(far + double3(0.25, 0, 0), 1);
        return world;
    }());
    view.camera = Camera::lookAt(far + double3(0, 0, 10), far);
    const std::vector<shader::ObjectData> moved = objectsOf(prepare());
    ASSERT_EQ(moved.size(), 1u);
    EXPECT_EQ(moved[0].row0, reference.row0);
    EXPECT_EQ(moved[0].row1, reference.row1);
    EXPECT_EQ(moved[0].row2, reference.row2);
}

TEST_F(PrepareFrameTest, MergesEqualNeighboursIntoOneInstancedDraw) {
    auto* a = material(shader::Blending::Opaque);
    auto* b = material(shader::Blending::Opaque);
    for (int i = 0; i < 10; ++i) {
        add({ i * 0.2 - 1, 0, 0 }, a);
        add({ i * 0.2 - 1, 1, 0 }, b);
    }
    const ViewPacket packet = prepare();
    ASSERT_EQ(packet.opaque.size(), 2u);
    EXPECT_EQ(packet.opaque[0].instanceCount + packet.opaque[1].instanceCount, 20u);
    EXPECT_EQ(packet.counts.triangles, 20u * 12u);
}

TEST_F(PrepareFrameTest, NoDrawCrossesAWindowOfObjects) {
    auto* a = material(shader::Blending::Opaque);
    for (int i = 0; i < 1000; ++i) add({ 0, 0, 0 }, a);
    const ViewPacket packet = prepare();
    uint32_t covered = 0;
    for (DrawCall const& draw : packet.opaque) {
        EXPECT_EQ(draw.firstObject, covered);
        EXPECT_EQ(draw.firstObject / shader::kObjectsPerWindow,
                  (draw.firstObject + draw.instanceCount - 1) / shader::kObjectsPerWindow);
        covered += draw.instanceCount;
    }
    EXPECT_EQ(covered, 1000u);
    EXPECT_EQ(packet.opaque.size(), 4u);
}

TEST_F(PrepareFrameTest, MirroredInstancesDrawApart) {
    auto* a = material(shader::Blending::Opaque);
    add({ 0, 0, 0 }, a);
    add({ 0, 0, 0 }, a, 1, -1.0);
    const ViewPacket packet = prepare();
    ASSERT_EQ(packet.opaque.size(), 2u);
    EXPECT_NE(packet.opaque[0].mirrored, packet.opaque[1].mirrored);
    EXPECT_EQ(objectsOf(packet)[packet.opaque[0].mirrored ? 0 : 1].flags.x, -1.0f);
}

TEST_F(PrepareFrameTest, DrawsOpaqueFrontToBackAndBlendedBackToFront) {
    auto* solid = material(shader::Blending::Opaque);
    auto* glass = material(shader::Blending::Transparent);
    for (uint32_t i = 0; i < 4; ++i) {
        add({ 0, 0, -20.0 * i }, solid, 10 + i);
        add({ 0, 0, -20.0 * i }, glass, 20 + i);
    }
    const ViewPacket packet = prepare();
    ASSERT_EQ(packet.opaque.size(), 4u);
    ASSERT_EQ(packet.blended.size(), 4u);
    for (uint32_t i = 0; i < 4; ++i) {
        EXPECT_EQ(packet.opaque[i].geometry->vertices.index(), 10 + i);
        EXPECT_EQ(packet.blended[i].geometry->vertices.index(), 23 - i);
    }
}

TEST_F(PrepareFrameTest, IsTheSameForAnyNumberOfWorkers) {
    auto* solid = material(shader::Blending::Opaque);
    auto* glass = material(shader::Blending::Transparent);
    uint32_t random = 7;
    const auto next = [&] { return (random = random * 1664525u + 1013904223u) >> 8; };
    for (int i = 0; i < 5000; ++i) {
        add({ next() % 40 - 20.0, next() % 40 - 20.0, -static_cast<double>(next() % 60) }, next() % 3 ? solid : glass,
            next() % 5);
    }
    uint64_t reference = 0;
    for (int workers : { 0, 1, 2, 3, 16 }) {
        jobs::JobSystem other({ .workers = workers });
        const FramePacket packet = prepareFrame(other, arena, scene, view);
        const uint64_t hash = hashPacket(packet);
        if (workers == 0) reference = hash;
        EXPECT_EQ(hash, reference) << workers << " workers";
    }
}

TEST_F(PrepareFrameTest, PreExposesLightsInFullPrecision) {
    add({ 0, 0, 0 }, material()); // lit, in view
    addLight(scene, { .type = LightRecord::Type::Sun, .directionWorld = { 0, -1, 0 }, .intensity = 110'000 });
    const ViewPacket packet = prepare();
    EXPECT_NEAR(packet.uniforms.sunIlluminance.x, 2.86462f, 1e-4f);
    EXPECT_EQ(packet.uniforms.sunDirection, float4(0, 1, 0, 1));
    EXPECT_EQ(packet.variant, shader::kVariantSun);
}

TEST_F(PrepareFrameTest, ShadesWithTheBrightestSun) {
    addLight(scene, { .type = LightRecord::Type::Sun, .directionWorld = { 1, 0, 0 }, .intensity = 10 });
    addLight(scene, { .type = LightRecord::Type::Sun, .directionWorld = { 0, 0, 1 }, .intensity = 20 });
    const ViewPacket packet = prepare();
    EXPECT_EQ(packet.uniforms.sunDirection, float4(0, 0, -1, 1));
    EXPECT_EQ(packet.counts.suns, 2u);
}

TEST_F(PrepareFrameTest, FurtherSunsAreInTheListOfLightsInTheOrderOfTheScene) {
    add({ 0, 0, 0 }, material()); // lit, in view
    addLight(scene, { .type = LightRecord::Type::Sun, .directionWorld = { 1, 0, 0 }, .intensity = 10 });
    addLight(scene, { .type = LightRecord::Type::Point, .intensity = 5 });
    addLight(scene, { .type = LightRecord::Type::Sun, .directionWorld = { 0, 0, 1 }, .intensity = 20 });
    addLight(scene, { .type = LightRecord::Type::Sun, .directionWorld = { 0, -1, 0 }, .intensity = 5 });
    addLight(scene, { .type = LightRecord::Type::Sun, .directionWorld = { 0, 1, 0 }, .intensity = 0 });
    const ViewPacket packet = prepare();
    EXPECT_EQ(packet.variant, shader::kVariantSun | shader::kVariantPunctual);
    ASSERT_EQ(packet.lights.size(), 3u);
    EXPECT_EQ(packet.lights[0].positionRange, float4(-1, 0, 0, 0)) << "towards the sun; unlimited";
    EXPECT_EQ(packet.lights[0].colorIntensity, float4(float3(10 * packet.uniforms.exposure.x), -1));
    EXPECT_EQ(packet.lights[1].colorIntensity.w, 0);
    EXPECT_EQ(packet.lights[2].positionRange, float4(0, 1, 0, 0));
}

std::shared_ptr<const std::vector<uint32_t>> profileOf(uint32_t words) {
    return std::make_shared<const std::vector<uint32_t>>(words, 1u);
}

TEST_F(PrepareFrameTest, ProfilesAreListedOnceAndLightsNameTheirPlace) {
    add({ 0, 0, 0 }, material()); // lit, in view
    using Type = scene::LightRecord::Type;
    const auto street = profileOf(10), lamp = profileOf(7);
    const auto light = [&](Type type, std::shared_ptr<const std::vector<uint32_t>> profile, float3 side, float range) {
        addLight(scene, { .type = type,
                          .positionWorld = { 0, 0, range > 0 ? 1e6 : 0 },
                          .directionWorld = { 0, 0, -1 },
                          .intensity = 8,
                          .rangeMeters = range,
                          .outerConeRadians = 0.5f,
                          .sideWorld = side,
                          .profile = std::move(profile) });
    };
    light(Type::Point, street, { 1, 0, 0 }, 0);
    light(Type::Point, nullptr, { 1, 0, 0 }, 0);
    light(Type::Spot, lamp, { 0, 3, 1 }, 0);    // a node with unequal scales
    light(Type::Point, lamp, { 1, 0, 0 }, 2);   // out of view
    light(Type::Point, street, { 0, 0, 1 }, 0); // any side
    const ViewPacket packet = prepare();
    ASSERT_EQ(packet.lights.size(), 4u);
    EXPECT_EQ(packet.counts.profiledLights, 3u);
    EXPECT_EQ(packet.counts.profiledLightsLeftOut, 1u);
    EXPECT_EQ(packet.counts.profilesOverLimit, 0u);
    const std::array expected{ 1.0f, 0.0f, 2.0f, 3.0f };
    for (size_t i = 0; i < 4; ++i) EXPECT_EQ(packet.lights[i].offset.w, expected[i]) << i;
    ASSERT_EQ(packet.profiles.tables.size(), 2u);
    EXPECT_EQ(packet.profiles.tables[0].data(), street->data());
    EXPECT_EQ(packet.profiles.tables[1].data(), lamp->data());
    ASSERT_EQ(packet.profiles.lights.size(), 3u * shader::kProfiledLightWords);
    const auto own = [&](size_t i) { return packet.profiles.lights.subspan(i * shader::kProfiledLightWords, 4); };
    const auto sideOf = [&](size_t i) {
        return float3(std::bit_cast<float>(own(i)[0]), std::bit_cast<float>(own(i)[1]),
                      std::bit_cast<float>(own(i)[2]));
    };
    EXPECT_EQ(sideOf(0), float3(1, 0, 0));
    EXPECT_EQ(sideOf(1), float3(0, 1, 0)) << "across the direction";
    EXPECT_EQ(sideOf(2), float3(0, 0, 0));
    EXPECT_EQ(own(0)[3], 12u) << "behind the words of the lights";
    EXPECT_EQ(own(1)[3], 22u);
    EXPECT_EQ(own(2)[3], 12u);
}

TEST_F(PrepareFrameTest, ViewsWithoutProfilesHaveTheLightsOfTheScene) {
    add({ 0, 0, 0 }, material());
    addLight(scene, { .type = scene::LightRecord::Type::Point, .intensity = 5 });
    const ViewPacket packet = prepare();
    EXPECT_TRUE(packet.profiles.empty());
    EXPECT_TRUE(packet.profiles.tables.empty());
    EXPECT_EQ(packet.lights[0].offset.w, 0);
}

TEST_F(PrepareFrameTest, LightsWhoseProfilesDoNotFitAreDarkAndCounted) {
    add({ 0, 0, 0 }, material());
    const uint32_t half = shader::kMaxProfileWords / 2;
    for (const uint32_t words : { half, half + 1, half }) {
        addLight(scene, { .type = scene::LightRecord::Type::Point, .intensity = 5, .profile = profileOf(words) });
    }
    const ViewPacket packet = prepare();
    ASSERT_EQ(packet.lights.size(), 3u);
    EXPECT_EQ(packet.profiles.tables.size(), 2u);
    EXPECT_EQ(packet.counts.profilesOverLimit, 1u);
    EXPECT_GT(packet.lights[0].colorIntensity.x, 0);
    EXPECT_EQ(packet.lights[1].colorIntensity, float4(0));
    EXPECT_EQ(packet.lights[1].offset.w, 0);
    EXPECT_GT(packet.lights[2].colorIntensity.x, 0);
}

TEST_F(PrepareFrameTest, AreaLightsAreInTheListWithTheirEdges) {
    add({ 0, 0, 0 }, material()); // lit, in view
    using Type = scene::LightRecord::Type;
    const auto area = [&](Type type, bool isTwoSided, float2 halfExtent) {
        addLight(scene, { .type = type,
                          .directionWorld = { 0, 0, -1 },
                          .intensity = 8,
                          .isTwoSided = isTwoSided,
                          .sideWorld = { 1, 0, 0 },
                          .halfExtent = halfExtent });
    };
    area(Type::Rect, false, { 2, 3 });
    area(Type::Disc, true, { 2, 2 });
    area(Type::Tube, false, { 2, 0.5f });
    area(Type::Rect, true, { 0, 3 }); // without an area
    const ViewPacket packet = prepare();
    ASSERT_EQ(packet.lights.size(), 3u);
    EXPECT_TRUE(packet.hasAreaLights);
    EXPECT_EQ(packet.counts.areaLights, 3u);
    const auto edges = [&](size_t i) {
        shader::PunctualLight const& light = packet.lights[i];
        return std::pair(float3(light.directionScale), float3(light.directionScale.w, light.offset.x, light.offset.w));
    };
    EXPECT_EQ(packet.lights[0].colorIntensity, float4(float3(8 * packet.uniforms.exposure.x), shader::kShapeRect));
    EXPECT_EQ(packet.lights[1].colorIntensity.w, shader::kShapeDisc + shader::kShapeTwoSided);
    EXPECT_EQ(packet.lights[2].colorIntensity.w, shader::kShapeTube);
    EXPECT_EQ(edges(0), std::pair(float3(2, 0, 0), float3(0, 3, 0)));
    EXPECT_GT(glm::cross(edges(1).first, edges(1).second).z, 0) << "against the direction";
    EXPECT_EQ(edges(2), std::pair(float3(2, 0, 0), float3(0.5f, 0, 0)));
    for (shader::PunctualLight const& light : packet.lights) EXPECT_EQ(light.offset.y, 0) << "no shadow map";
}

TEST_F(PrepareFrameTest, KeepsTheBrightestPunctualLightsWithinTheLimit) {
    add({ 0, 0, 0 }, material()); // lit, in view
    for (uint32_t i = 0; i < shader::kMaxPunctualLights + 44; ++i) {
        addLight(scene, { .type = LightRecord::Type::Point, .intensity = 1.0f + static_cast<float>(i) });
    }
    const ViewPacket packet = prepare();
    EXPECT_EQ(packet.lights.size(), shader::kMaxPunctualLights);
    EXPECT_EQ(packet.counts.lightsOverLimit, 44u);
    const float exposure = packet.uniforms.exposure.x;
    for (shader::PunctualLight const& light : packet.lights)
        EXPECT_GE(light.colorIntensity.x, 45.0f * exposure * 0.999f);
    const auto intensity = [](shader::PunctualLight const& light) { return light.colorIntensity.x; };
    EXPECT_TRUE(std::ranges::is_sorted(packet.lights, {}, intensity)) << "in the order of the scene";
}

TEST_F(PrepareFrameTest, LeavesLightOutWhereNothingLitIsVisible) {
    scene::MaterialInstance* unlit = material();
    unlit->material->package.shading = shader::ShadingModel::Unlit;
    add({ 0, 0, 0 }, unlit);
    addLight(scene, { .type = LightRecord::Type::Sun, .intensity = 20 });
    addLight(scene, { .type = LightRecord::Type::Point, .intensity = 1 });
    ViewPacket packet = prepare();
    EXPECT_EQ(packet.variant, 0);
    EXPECT_TRUE(packet.lights.empty());
    EXPECT_EQ(packet.counts.lights, 1u) << "it reaches the view";
    add({ 0, 0, 40 }, material()); // behind the camera
    EXPECT_EQ(prepare().variant, 0);
    add({ 1, 0, 0 }, material(shader::Blending::Transparent));
    packet = prepare();
    EXPECT_EQ(packet.variant, shader::kVariantSun | shader::kVariantPunctual);
    EXPECT_EQ(packet.lights.size(), 1u);
}

TEST_F(PrepareFrameTest, DropsALightWhoseRangeEndsBeforeTheView) {
    add({ 0, 0, 0 }, material()); // lit, in view
    addLight(scene,
             { .type = LightRecord::Type::Point, .positionWorld = { 0, 0, 30 }, .intensity = 1, .rangeMeters = 5 });
    addLight(scene,
             { .type = LightRecord::Type::Point, .positionWorld = { 0, 0, 12 }, .intensity = 1, .rangeMeters = 5 });
    const ViewPacket packet = prepare();
    EXPECT_EQ(packet.lights.size(), 1u);
    EXPECT_EQ(packet.counts.lightsOutOfView, 1u);
    EXPECT_EQ(packet.uniforms.ambient.w, 1.0f);
}

/// Passes read effects from the packet: what its hash does not see may differ between two runs unnoticed.
TEST_F(PrepareFrameTest, TheHashSeesEveryOptionOfEveryEffect) {
    add({ 0, 0, 0 }, material(shader::Blending::Opaque));
    for (Option const& option : optionsOf<Effects>()) {
        if (option.kind != OptionKind::Switch) continue;
        ASSERT_TRUE(setOption(view.effects, option.name, "on")) << option.name;
    }
    view.effects.fog.heightFalloff = 0.1f; // without it, heights do not matter
    const uint64_t before = hashPacket(prepareFrame(jobs, arena, scene, view));
    const Effects all = view.effects;
    for (Option const& option : optionsOf<Effects>()) {
        const std::string value = *optionValue(all, option.name);
        std::vector<std::string> others{ "0.02", "0.5", "0.75", "2", "9", "0.5,0.25,0.75,2" };
        others.insert(others.begin(), option.values.begin(), option.values.end());
        for (std::string const& other : others) {
            if (other != value && setOption(view.effects, option.name, other)) break;
        }
        ASSERT_NE(optionValue(view.effects, option.name), value) << option.name;
        EXPECT_NE(hashPacket(prepareFrame(jobs, arena, scene, view)), before) << option.name;
        view.effects = all;
    }
}

/// Only the view is jittered: shadow maps and previous transforms are not.
TEST_F(PrepareFrameTest, GatheringMovesThePictureInsideOfItsPixels) {
    add({ 0, 0, 0 }, material(shader::Blending::Opaque));
    view.quality.antiAliasing = AntiAliasing::Taa;
    const std::array views{ view };
    LastFrame last;
    std::array<int, 16> places{}; // in the pixel, 4 x 4 of them
    for (int frame = 0; frame < 64; ++frame) {
        const FramePacket packet = prepareFrame(jobs, arena, scene, views, {}, last);
        ASSERT_TRUE(packet.demand.needs(Effect::Taa));
        EXPECT_FALSE(packet.last.isElsewhere);
        const float2 jitter = packet.accumulation.jitterPixels;
        EXPECT_EQ(jitter == float2(0), frame == 0);
        EXPECT_NEAR(packet.accumulation.weight, 1.0f / static_cast<float>(frame + 1), 1e-6f);
        const float4 clip = packet.mainView().uniforms.clipFromWorld * float4(0, 0, -10, 1);
        EXPECT_NEAR(clip.x / clip.w * 320, jitter.x, 1e-4f);
        EXPECT_NEAR(clip.y / clip.w * 240, jitter.y, 1e-4f);
        const int2 place = int2((jitter + 0.5f) * 4.0f);
        ++places[static_cast<size_t>(place.y * 4 + place.x)];
        last.keep(scene, view, packet);
    }
    for (const int count : places) EXPECT_NEAR(count, 4, 2) << "evenly";
}

/// With temporal upscaling, a change of the drawn size changes neither the image nor the
/// history.
TEST_F(PrepareFrameTest, GatheringOfALargerPictureSurvivesAnotherScale) {
    add({ 0, 0, 0 }, material(shader::Blending::Opaque));
    view.quality.antiAliasing = AntiAliasing::Taa;
    view.shownSize = { 640, 480 };
    LastFrame last;
    const auto next = [&](uint2 size, Upscaling filter) {
        view.size = size;
        view.effects.resolution.upscaling = filter;
        view.effects.resolution.scale = float2(size) / float2(view.shownSize);
        const FramePacket packet = prepareFrame(jobs, arena, scene, std::array{ view }, {}, last);
        EXPECT_EQ(packet.settings.size, size);
        EXPECT_EQ(packet.settings.shownSize, view.shownSize);
        EXPECT_FALSE(packet.last.isElsewhere) << "the proportions are those of what is shown";
        const float2 jitter(packet.mainView().uniforms.jitter);
        EXPECT_EQ(jitter, 2.0f * packet.accumulation.jitterPixels / float2(size));
        last.keep(scene, view, packet);
        return packet.accumulation;
    };
    EXPECT_EQ(next({ 320, 240 }, Upscaling::Off).weight, 1);
    EXPECT_EQ(next({ 320, 240 }, Upscaling::Off).weight, 1.0f / 2);
    const Accumulation third = next({ 430, 321 }, Upscaling::Off);
    EXPECT_EQ(third.weight, 1.0f / 3);
    EXPECT_TRUE(third.isFixed);
    EXPECT_LT(third.ramp, 0.5f) << "narrower with each frame";
    EXPECT_EQ(next({ 640, 480 }, Upscaling::Off).ramp, 0) << "as many pixels as are shown";
    EXPECT_EQ(next({ 320, 240 }, Upscaling::Bilinear).weight, 1) << "another gathered picture";
    EXPECT_EQ(next({ 430, 321 }, Upscaling::Bilinear).weight, 1) << "of another size";
}

TEST_F(PrepareFrameTest, AnEmptySceneIsAnEmptyPacket) {
    const ViewPacket packet = prepare();
    EXPECT_TRUE(packet.opaque.empty());
    EXPECT_TRUE(packet.blended.empty());
    EXPECT_EQ(packet.variant, 0);
    EXPECT_EQ(packet.uniforms.ambient.x, 0.0f);
}

} // namespace
} // namespace filament_core::prepare
