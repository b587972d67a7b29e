// SPDX-License-Identifier: Apache-2.0
// Shadow maps by demand: which scenes need one, when it is drawn again, and what is in it.
#include "filament_core/prepare/FitShadows.h"
#include "tests/filament_core/prepare/BoxScene.h"

#include <gtest/gtest.h>

#include <bit>

namespace filament_core::prepare {
namespace {

using scene::LightRecord;

/// A slab with a box above it, under a sun from above, seen from the side.
struct PrepareShadowsTest : testing::Test, BoxScene {
    jobs::JobSystem jobs{ { .workers = 1 } };
    Arena arena;
    ShadowAtlas held;
    scene::MaterialInstance* lit = material();
    Renderable slab = addSlab(), box = add({ 0, 3, 0 }, lit);
    Light sun = addLight(scene, { .type = LightRecord::Type::Sun, .intensity = 1000 });
    ViewInput view{ .camera = Camera::lookAt({ 0, 4, 20 }, { 0, 0, 0 }),
                    .size = { 640, 480 },
                    .quality = { .shadows = ShadowFilter::Pcf3, .shadowMapSize = 512 } };

    Renderable addSlab() {
        double4x4 world(10.0);
        world[1][1] = 0.1;
        world[3] = double4(0, 0, 0, 1);
        return add(world, lit, 2);
    }

    /// As a renderer does it: the atlas holds what was drawn.
    FramePacket frame() {
        arena.reset();
        const FramePacket packet = prepareFrame(jobs, arena, scene, std::span(&view, 1), held);
        if (!packet.shadows.maps.empty()) {
            held.size = packet.shadows.atlasSize;
            held.moments = packet.shadows.moments;
            held.maps.clear();
            for (ShadowMapPacket const& map : packet.shadows.maps) held.maps.push_back(map.held);
        }
        return packet;
    }

    void expectNone(DemandReason reason) {
        const FramePacket packet = frame();
        EXPECT_TRUE(packet.shadows.maps.empty());
        EXPECT_EQ(packet.views.size(), 1u);
        EXPECT_EQ(packet.mainView().variant & shader::kVariantShadowReceiver, 0);
        EXPECT_FALSE(packet.demand.needs(Effect::Shadows));
        EXPECT_EQ(packet.demand.of(Effect::Shadows).reason, reason);
        EXPECT_FALSE(describe(Effect::Shadows, packet.demand.of(Effect::Shadows)).empty());
    }

    /// Instead of slab and box.
    void leaveOneBox(bool casts, bool receives) {
        removeRenderable(scene, slab);
        removeRenderable(scene, box);
        scene::RenderableInput input = BoxScene::box(double4x4(1.0), lit, 1);
        input.castsShadows = casts;
        input.properties.receivesShadows = receives;
        addRenderable(scene, input);
    }

    static LightRecord lamp(double3 at, float range) {
        return { .type = LightRecord::Type::Point, .positionWorld = at, .intensity = 10, .rangeMeters = range };
    }
    static LightRecord spot(double3 at, float3 direction, float cone, float range = 30) {
        return { .type = LightRecord::Type::Spot,
                 .positionWorld = at,
                 .directionWorld = direction,
                 .intensity = 10,
                 .rangeMeters = range,
                 .outerConeRadians = cone };
    }
};

TEST_F(PrepareShadowsTest, ASunOverAnObjectOverASlabTakesOneMap) {
    const FramePacket packet = frame();
    ASSERT_EQ(packet.shadows.maps.size(), 1u);
    EXPECT_EQ(packet.shadows.maps[0].view, 1u);
    EXPECT_EQ(packet.shadows.maps[0].held.tile, (ShadowTile{ 0, 0, 512 }));
    EXPECT_EQ(packet.shadows.atlasSize, 512u);
    EXPECT_FALSE(packet.shadows.keepsAtlas);
    ASSERT_EQ(packet.views.size(), 2u);
    EXPECT_EQ(packet.views[1].kind, ViewKind::Shadow);
    EXPECT_EQ(packet.views[1].counts.visible, 2u);
    EXPECT_NE(packet.mainView().variant & shader::kVariantShadowReceiver, 0);
    EXPECT_EQ(packet.shadows.uniforms->sun, float4(0, 1, 0, 0));
    EXPECT_TRUE(packet.demand.needs(Effect::Shadows));
}

TEST_F(PrepareShadowsTest, SwitchedOffThereIsNone) {
    view.quality.shadows = ShadowFilter::Off;
    expectNone(DemandReason::SwitchedOff);
}

TEST_F(PrepareShadowsTest, WithoutALightThatCastsThereIsNone) {
    removeLight(scene, sun);
    expectNone(DemandReason::NoLightCasts);
    addLight(scene, { .type = LightRecord::Type::Sun, .intensity = 1000, .castsShadows = false });
    expectNone(DemandReason::NoLightCasts);
}

TEST_F(PrepareShadowsTest, WithoutACasterThereIsNone) {
    leaveOneBox(false, true);
    expectNone(DemandReason::NoCaster);
}

TEST_F(PrepareShadowsTest, FogThatASunLightsNeedsNoneInAnEmptyScene) {
    removeRenderable(scene, slab);
    removeRenderable(scene, box);
    view.effects.fog = { .enabled = true, .volumetric = true };
    EXPECT_TRUE(frame().shadows.maps.empty());
}

TEST_F(PrepareShadowsTest, BlendedAndCameraBoundMaterialsCastNone) {
    removeRenderable(scene, slab);
    removeRenderable(scene, box);
    add({ 0, 1, 0 }, material(shader::Blending::Transparent));
    scene::MaterialInstance* device = material();
    device->material->package.vertexDomain = shader::VertexDomain::Device;
    const Renderable changing = add({ 0, 0, 0 }, device);
    expectNone(DemandReason::NoCaster);
    setMaterial(scene.renderables, changing, *lit);
    EXPECT_EQ(frame().shadows.maps.size(), 1u) << "the flag follows the material";
}

TEST_F(PrepareShadowsTest, WithoutAReceiverInViewThereIsNone) {
    view.camera = Camera::lookAt({ 0, 4, 20 }, { 0, 4, 40 });
    expectNone(DemandReason::NoReceiver);
}

TEST_F(PrepareShadowsTest, UnlitSurfacesReceiveNoneUnlessTheyCatchShadows) {
    lit->material->package.shading = shader::ShadingModel::Unlit;
    expectNone(DemandReason::NoReceiver);
    lit->material->package.shadowMultiplier = true;
    addLight(scene, lamp({ 0, 6, 0 }, 20));
    EXPECT_EQ(frame().shadows.maps.size(), 1u) << "catchers catch the shadows of the sun alone";
}

TEST_F(PrepareShadowsTest, RenderablesThatReceiveNoneAreNoReason) {
    leaveOneBox(true, false);
    expectNone(DemandReason::NoReceiver);
}

TEST_F(PrepareShadowsTest, OnlyMomentsAreBlurred) {
    addLight(scene, lamp({ 0, 6, 0 }, 20));
    view.quality.shadowBlurTexels = 16;
    for (const ShadowFilter filter :
         { ShadowFilter::Pcf3, ShadowFilter::Pcss, ShadowFilter::Vsm, ShadowFilter::Evsm }) {
        view.quality.shadows = filter;
        const FramePacket packet = frame();
        const bool hasMoments = momentsFor(filter) != ShadowMoments::None;
        ASSERT_EQ(packet.shadows.maps.size(), 2u);
        shader::ShadowMapRecord const &ofSun = packet.shadows.uniforms->maps[0],
                                      &ofLamp = packet.shadows.uniforms->maps[1];
        EXPECT_EQ(ofSun.softness.z, 0) << "parallel light has linear depths";
        EXPECT_EQ(ofLamp.softness.z > 0, hasMoments) << toString(filter);
        EXPECT_EQ(ofSun.softness.w > 0, hasMoments) << toString(filter);
        EXPECT_LE(ofSun.softness.w, 16);
    }
}

TEST_F(PrepareShadowsTest, MomentsAreMadeAnewForAnotherFilterOrBlur) {
    const auto drawn = [&](ShadowFilter filter, uint8_t blur) {
        view.quality.shadows = filter;
        view.quality.shadowBlurTexels = blur;
        return frame().shadows.drawn;
    };
    EXPECT_EQ(drawn(ShadowFilter::Pcf3, 2), 1u);
    EXPECT_EQ(drawn(ShadowFilter::Pcss, 7), 0u) << "the same depths";
    EXPECT_EQ(drawn(ShadowFilter::Vsm, 2), 1u);
    EXPECT_EQ(drawn(ShadowFilter::Vsm, 2), 0u);
    EXPECT_EQ(drawn(ShadowFilter::Vsm, 3), 1u);
    EXPECT_EQ(drawn(ShadowFilter::Evsm, 3), 1u);
    EXPECT_EQ(drawn(ShadowFilter::Pcf3, 3), 1u);
}

TEST_F(PrepareShadowsTest, WhatIsBehindTheCameraCastsIntoTheView) {
    removeRenderable(scene, box);
    add({ 0, 60, 40 }, lit, 3); // behind the camera and above, between the sun and the slab
    removeLight(scene, sun);
    addLight(scene, { .type = LightRecord::Type::Sun,
                      .directionWorld = glm::normalize(float3(0, -60, -40)),
                      .intensity = 1000 });
    const FramePacket packet = frame();
    ASSERT_EQ(packet.views.size(), 2u);
    EXPECT_EQ(packet.mainView().counts.visible, 1u);
    EXPECT_EQ(packet.views[1].counts.visible, 2u);
}

TEST_F(PrepareShadowsTest, AStillSceneIsNotDrawnAgain) {
    EXPECT_EQ(frame().shadows.drawn, 1u);
    const FramePacket second = frame();
    EXPECT_EQ(second.shadows.drawn, 0u);
    EXPECT_EQ(second.views.size(), 1u);
    EXPECT_EQ(second.shadows.maps.size(), 1u);
    EXPECT_EQ(second.shadows.maps[0].view, kKeptMap);
    EXPECT_TRUE(second.shadows.keepsAtlas);
    EXPECT_NE(second.mainView().variant & shader::kVariantShadowReceiver, 0);
    view.camera = Camera::lookAt({ 3, 5, 17 }, { 1, 0, 0 });
    EXPECT_EQ(frame().shadows.drawn, 0u) << "the map holds the whole scene: the camera does not matter";
}

TEST_F(PrepareShadowsTest, WhateverChangesTheMapIsDrawnAgain) {
    frame();
    const auto expectDrawn = [&](const char* why) {
        EXPECT_EQ(frame().shadows.drawn, 1u) << why;
        EXPECT_EQ(frame().shadows.drawn, 0u) << why;
    };
    double4x4 moved(1.0);
    moved[3] = double4(0.001, 3, 0, 1);
    setTransform(scene, box, moved);
    expectDrawn("a caster moved");
    scene.lights.records[0].directionWorld = glm::normalize(float3(0.001f, -1, 0));
    expectDrawn("the light turned");
    const Renderable other = add({ 2, 2, 0 }, lit, 5);
    expectDrawn("a caster came");
    removeRenderable(scene, other);
    expectDrawn("a caster went");
    view.quality.shadowMapSize = 256;
    expectDrawn("the map has another size");
    scene.lights.records[0].intensity = 7;
    scene.lights.records[0].color = float3(1, 0, 0);
    EXPECT_EQ(frame().shadows.drawn, 0u) << "brightness is no part of a map";
    view.quality.shadows = ShadowFilter::Hard;
    EXPECT_EQ(frame().shadows.drawn, 0u) << "nor is the filter";
}

TEST_F(PrepareShadowsTest, ParametersAndTimeCountForMaterialsWhoseDepthReadsThem) {
    lit->parameters.resize(16);
    frame();
    lit->parameters[0] = std::byte{ 1 };
    view.timeSeconds = 1;
    EXPECT_EQ(frame().shadows.drawn, 0u);
    lit->material->package.depthReadsParameters = true;
    frame();
    lit->parameters[0] = std::byte{ 2 };
    EXPECT_EQ(frame().shadows.drawn, 1u);
    view.timeSeconds = 2;
    EXPECT_EQ(frame().shadows.drawn, 0u);
    lit->material->package.readsFrame = true;
    view.timeSeconds = 3;
    EXPECT_EQ(frame().shadows.drawn, 1u);
}

TEST_F(PrepareShadowsTest, MapsInWhichSomethingTransmitsHaveThreeChannelsInATileTwiceAsLarge) {
    scene::MaterialInstance* glass = material();
    glass->material->package.refractionMode = shader::RefractionMode::Cubemap;
    setMaterial(scene.renderables, box, *glass);
    EXPECT_EQ(frame().shadows.maps[0].channels, 1u) << "switched off";

    view.quality.coloredShadows = true;
    const FramePacket colored = frame();
    ASSERT_EQ(colored.shadows.maps.size(), 1u);
    EXPECT_EQ(colored.shadows.maps[0].channels, 3u);
    EXPECT_EQ(colored.shadows.maps[0].held.tile.size, 1024);
    EXPECT_EQ(drawnChannels(colored.shadows), 3u);
    EXPECT_TRUE(colored.demand.needs(Effect::ColoredShadows));
    EXPECT_EQ(frame().shadows.drawn, 0u) << "kept as others are";

    glass->parameters.resize(16);
    EXPECT_EQ(frame().shadows.drawn, 1u) << "its tint may be another";
    setMaterial(scene.renderables, box, *lit);
    const FramePacket plain = frame();
    EXPECT_EQ(plain.shadows.maps[0].channels, 1u) << "nothing transmits";
    EXPECT_EQ(plain.shadows.maps[0].held.tile.size, 512);
    EXPECT_EQ(plain.demand.of(Effect::ColoredShadows).reason, DemandReason::NoTransmission);
}

TEST_F(PrepareShadowsTest, LampsTakeTheFacesInWhichSomethingCasts) {
    removeLight(scene, sun);
    addLight(scene, lamp({ 0, 8, 0 }, 30));
    const FramePacket packet = frame();
    ASSERT_EQ(packet.shadows.maps.size(), 1u) << "everything is below";
    ASSERT_EQ(packet.mainView().lights.size(), 1u);
    EXPECT_EQ(packet.mainView().lights[0].offset.y, 1);
    EXPECT_EQ(packet.mainView().lights[0].offset.z, (1 << 3) + (1 << kCubeFaces)) << "-y of a cube";
}

TEST_F(PrepareShadowsTest, WhatIsBeyondTheReachOfALampIsDrawnOnlyIntoMeans) {
    removeLight(scene, sun);
    addLight(scene, spot({ 0, 9, 0 }, { 0, -1, 0 }, 0.3f, 6.4f)); // as far as the box, which ends at 2.5, and no slab
    const FramePacket packet = frame();
    ASSERT_EQ(packet.views.size(), 2u);
    EXPECT_EQ(packet.views[1].counts.visible, 1u);
    EXPECT_EQ(packet.views[1].counts.outOfView, 1u);
    double4x4 lower(10.0);
    lower[1][1] = 0.1;
    lower[3] = double4(0, -1, 0, 1);
    setTransform(scene, slab, lower);
    EXPECT_EQ(frame().shadows.drawn, 0u) << "nothing in the map has changed";
    view.quality.shadows = ShadowFilter::Vsm;
    EXPECT_EQ(frame().views[1].counts.visible, 2u);
}

TEST_F(PrepareShadowsTest, SpotsTakeOneMapAndWideOnesACube) {
    removeLight(scene, sun);
    addLight(scene, spot({ 0, 8, 0 }, { 0, -1, 0 }, 0.5f));
    EXPECT_EQ(frame().mainView().lights[0].offset.z, 1);
    scene.lights.records[0].outerConeRadians = 1.5f;
    EXPECT_GE(frame().mainView().lights[0].offset.z, 1 << kCubeFaces);
}

TEST_F(PrepareShadowsTest, EverySunTakesItsCascades) {
    add({ 4000, 0, -4000 }, lit, 7);
    view.quality.shadowCascades = 3;
    addLight(scene, { .type = LightRecord::Type::Sun,
                      .directionWorld = glm::normalize(float3(1, -1, 0)),
                      .intensity = 10,
                      .contactShadows = true });
    const FramePacket packet = frame();
    const uint32_t ofBrightest = static_cast<uint32_t>(packet.shadows.uniforms->sun.y);
    ASSERT_EQ(packet.mainView().lights.size(), 1u);
    const float4 offset = packet.mainView().lights[0].offset;
    EXPECT_EQ(packet.shadows.uniforms->sun.x, 0) << "the brightest sun comes first";
    EXPECT_EQ(offset.y, static_cast<float>(ofBrightest + 1));
    const auto bits = static_cast<uint32_t>(offset.z);
    EXPECT_EQ(ofBrightest + static_cast<uint32_t>(std::popcount(bits & 15)), packet.shadows.maps.size());
    EXPECT_GT(std::popcount(bits & 15), 1);
    EXPECT_EQ(bits & ~15u, shader::kContactShadowBit);
    EXPECT_EQ(frame().shadows.drawn, 0u);
}

TEST_F(PrepareShadowsTest, AreasTakeTheFacesThatTheyShineThrough) {
    removeLight(scene, sun);
    LightRecord area = lamp({ 0, 2, 0 }, 30); // between the slab and the box
    area.type = LightRecord::Type::Rect;
    area.directionWorld = { 0, -1, 0 };
    area.sideWorld = { 1, 0, 0 };
    area.halfExtent = float2(0.1f);
    addLight(scene, area);
    const auto faces = [&] {
        const FramePacket packet = frame();
        return packet.mainView().lights.empty() ? 0u : static_cast<uint32_t>(packet.mainView().lights[0].offset.z);
    };
    constexpr uint32_t kUp = 1 << 2, kDown = 1 << 3, kCube = 1 << kCubeFaces;
    EXPECT_EQ(faces() & (kUp | kDown | kCube), kDown | kCube) << "the box is behind it";
    scene.lights.records[0].isTwoSided = true;
    EXPECT_EQ(faces() & (kUp | kDown | kCube), kUp | kDown | kCube);
    scene.lights.records[0].isTwoSided = false;
    scene.lights.records[0].type = LightRecord::Type::Tube;
    EXPECT_EQ(faces() & (kUp | kDown | kCube), kUp | kDown | kCube);
    scene.lights.records[0].castsShadows = false;
    expectNone(DemandReason::NoLightCasts);
}

TEST_F(PrepareShadowsTest, LightsOutOfReachOfWhatIsSeenTakeNone) {
    removeLight(scene, sun);
    addLight(scene, lamp({ 0, 8, 0 }, 30));
    scene.lights.records[0].positionWorld = { 0, 20, 0 };
    scene.lights.records[0].rangeMeters = 10;
    expectNone(DemandReason::NoLightCasts);
}

TEST_F(PrepareShadowsTest, TheBudgetHoldsForSixtyFourSpotsAndTheNearestHaveTheMostTexels) {
    removeLight(scene, sun);
    view.quality.shadowAtlasMegabytes = 4;
    for (int i = 0; i < 64; ++i) addLight(scene, spot({ i * 0.1 - 3, 6, -0.1 * i }, { 0, -1, 0 }, 0.6f));
    const FramePacket packet = frame();
    EXPECT_EQ(packet.shadows.maps.size(), 64u);
    EXPECT_LE(uint64_t{ packet.shadows.atlasSize } * packet.shadows.atlasSize * 4, uint64_t{ 4 } << 20);
    EXPECT_EQ(packet.shadows.drawn, 64u);
    EXPECT_EQ(frame().shadows.drawn, 0u);
    scene.lights.records[7].positionWorld.x += 0.01;
    EXPECT_EQ(frame().shadows.drawn, 1u) << "the others keep theirs";
}

TEST_F(PrepareShadowsTest, BeyondAllMapsTheLeastImportantLightsHaveNone) {
    removeLight(scene, sun);
    for (int i = 0; i < 200; ++i) addLight(scene, spot({ i * 0.01, 6, 0 }, { 0, -1, 0 }, 0.6f));
    const FramePacket packet = frame();
    EXPECT_EQ(packet.shadows.maps.size(), shader::kMaxShadowMaps);
    uint32_t withMap = 0;
    for (shader::PunctualLight const& light : packet.mainView().lights) withMap += light.offset.y > 0;
    EXPECT_EQ(withMap, shader::kMaxShadowMaps);
}

TEST_F(PrepareShadowsTest, CascadesAreNeighboursAndOnlyAsManyAsTheSceneNeeds) {
    view.quality.shadowCascades = 4;
    EXPECT_EQ(frame().shadows.maps.size(), 1u) << "one map holds the whole scene with more texels a metre";
    add({ 4000, 0, -4000 }, lit, 7);
    view.camera = Camera::lookAt({ 0, 1, 20 }, { 0, 0, 0 });
    const FramePacket far = frame();
    EXPECT_GT(far.shadows.maps.size(), 1u);
    EXPECT_EQ(far.shadows.uniforms->sun.y, static_cast<float>(far.shadows.maps.size()));
}

TEST_F(PrepareShadowsTest, PacketsAreTheSameForAnyNumberOfWorkers) {
    addCube(20'000, 5, 7);
    for (int i = 0; i < 40; ++i) addLight(scene, lamp({ i - 20.0, 5, -10 }, 15));
    view.quality.shadowCascades = 3;
    uint64_t reference = 0;
    for (const int workers : { 0, 1, 3 }) {
        jobs::JobSystem others({ .workers = workers });
        arena.reset();
        const uint64_t hash = hashPacket(prepareFrame(others, arena, scene, std::span(&view, 1), held));
        if (workers == 0) reference = hash;
        EXPECT_EQ(hash, reference) << workers;
    }
}

} // namespace
} // namespace filament_core::prepare
