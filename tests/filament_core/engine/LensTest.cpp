// SPDX-License-Identifier: Apache-2.0
// What parallel and shifted lenses show, and pick, on both APIs: in closed form.
#include "tests/filament_core/engine/ShadowStage.h"
#include "tests/filament_core/engine/WhiteEnvironment.h"

namespace filament {
namespace {

using prepare::Random;
using test::ShadowStage;

constexpr const char* kLensFlat = R"(material { name : flat, shadingModel : unlit, culling : none,
    parameters : [ { type : float4, name : color } ] }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material); material.baseColor = materialParams.color; } })";
struct LensTest : testing::TestWithParam<Backend> {
    ShadowStage stage{ GetParam() };
};
INSTANTIATE_TEST_SUITE_P(BothApis, LensTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

/// Looks down on the plane z = 0 from above.
Camera above(double height, Lens const& lens) {
    return Camera::lookAt({ 0, 0, height }, { 0, 0, 0 }, lens, {}, { 0, 1, 0 });
}

// A pixel of a box is a rectangle of the world: squares cover exactly the pixels whose centres they contain.
TEST_P(LensTest, ABoxShowsSquaresWhereTheyAre) {
    Engine& engine = stage.engine;
    const Owned<Material> flat = test::loadMaterial(engine, kLensFlat);
    const Owned<MaterialInstance> paint = engine.own(engine.createInstance(flat));
    ASSERT_TRUE(engine.set(paint, "color", float4(1)));
    Random random(3);
    for (int i = 0; i < 6; ++i) {
        Scene scene(engine);
        const double half = random.within(0.3, 2);
        const double3 at(random.within(-2, 2), random.within(-2, 2), random.within(-5, 5));
        stage.square.add(scene, paint, at, half);
        const View view{ .camera = above(8, Lens::box(-3, 5, -2, 4, 0, 20)), .size = { 64, 48 } };
        const Image image = test::renderLinear(engine, scene, view);
        size_t wrong = 0, covered = 0;
        for (uint32_t y = 0; y < view.size.y; ++y) {
            for (uint32_t x = 0; x < view.size.x; ++x) {
                const double2 world(-3 + (x + 0.5) / 8, 4 - (y + 0.5) / 8);
                const double2 away = glm::abs(world - double2(at)) - half;
                const double outside = std::max(away.x, away.y);
                if (std::abs(outside) < 1e-4) continue;
                covered += outside < 0;
                wrong += (test::halfPixel(image, x, y).x > 0.5f) != (outside < 0);
            }
        }
        EXPECT_EQ(wrong, 0u);
        EXPECT_GT(covered, 4u);
    }
}

TEST_P(LensTest, FourShiftedQuartersAreThePicture) {
    Engine& engine = stage.engine;
    Scene scene(engine);
    Random random(5);
    test::addCrowd(stage, scene, random, 1);
    const auto drawn = [&](Lens const& lens, uint2 size) {
        View view{ .camera = Camera::lookAt({ 5, 4, 3 }, { 0, 0, 0.5 }, lens, {}, { 0, 0, 1 }), .size = size };
        view.quality.shadows = ShadowFilter::Off;
        return test::renderLinear(engine, scene, view);
    };
    const Image whole = drawn(Lens::offCenter(-1, 1, -0.5f, 0.5f), { 64, 32 });
    size_t different = 0;
    for (uint32_t part = 0; part < 4; ++part) {
        const uint32_t column = part & 1, row = part >> 1;
        const float left = column ? 0 : -1, top = row ? 0 : 0.5f;
        const Image quarter = drawn(Lens::offCenter(left, left + 1, top - 0.5f, top), { 32, 16 });
        for (uint32_t y = 0; y < 16; ++y) {
            for (uint32_t x = 0; x < 32; ++x) {
                const float4 a = test::halfPixel(quarter, x, y),
                             b = test::halfPixel(whole, column * 32 + x, row * 16 + y);
                different += glm::length(a - b) > 0.01f * glm::length(b) + 1e-4f;
            }
        }
    }
    EXPECT_LE(different, 8u) << "of 2048, at edges";
}

TEST_P(LensTest, PickingAndDepthsAreThoseOfTheBox) {
    Engine& engine = stage.engine;
    Scene scene(engine);
    const Renderable low = stage.square.add(scene, stage.white, { 0, 0, -1 }, 3);
    const Renderable high = stage.square.add(scene, stage.white, { 1, 0.5, 2 }, 0.6);
    Renderer renderer(engine);
    for (const bool isShifted : { false, true }) {
        View view{ .camera = above(5, { .nearMeters = 0, .parallelMeters = 4, .farMeters = 50 }), .size = { 32, 32 } };
        if (isShifted) view.camera.lens.shift = { 0.125f, -0.25f };
        for (const uint2 pixel : { uint2(3, 28), uint2(16, 16), uint2(22, 10), uint2(24, 14) }) {
            const PickHit hit = renderer.waitPick(renderer.pick(scene, view, pixel)).value();
            const double2 at = (double2(pixel) + 0.5) / 32.0 * 2.0 - 1.0;
            const double3 expected = view.camera.viewFromPicture(at, 1, 1) + double3(0, 0, 1);
            const double2 away = glm::abs(double2(expected) - double2(1, 0.5)) - 0.6;
            const bool isHigh = std::max(away.x, away.y) < 0;
            ASSERT_TRUE(hit) << pixel.x << ' ' << pixel.y;
            EXPECT_EQ(hit.renderable, isHigh ? high : low);
            EXPECT_NEAR(hit.positionWorld.x, expected.x, 1e-5);
            EXPECT_NEAR(hit.positionWorld.y, expected.y, 1e-5);
            EXPECT_NEAR(hit.distanceMeters, isHigh ? 3 : 6, 1e-4);
        }
    }
}

TEST_P(LensTest, NothingIsOutOfFocusForAParallelLens) {
    Engine& engine = stage.engine;
    Scene scene(engine);
    stage.square.add(scene, stage.white, { 0, 0, -1 }, 3);
    Renderer renderer(engine);
    View view{ .camera = above(5, { .parallelMeters = 4 }), .size = { 32, 32 } };
    view.camera.exposure.aperture = 1;
    view.effects.depthOfField = { .enabled = true, .focusMeters = 1, .blurScale = 50 };
    const Image blurred = test::renderLinear(engine, renderer, scene, view);
    for (EffectDecision const& decision : renderer.decisions()) {
        const bool isFocus = decision.name == "depth of field";
        EXPECT_TRUE(!isFocus || decision.state == EffectDecision::State::NotNeeded);
    }
    view.effects.depthOfField.enabled = false;
    EXPECT_EQ(test::differingPixels(blurred, test::renderLinear(engine, scene, view)), 0u);
}

// Until their passes know parallel projections.
TEST_P(LensTest, WhatNeedsAPerspectiveLensIsLeftOutAndSaysSo) {
    Engine& engine = stage.engine;
    Scene scene(engine);
    stage.addBox(scene, {}, double3(1));
    const WhiteEnvironment white(engine);
    Renderer renderer(engine);
    View view{ .camera = above(5, { .parallelMeters = 4 }), .size = { 32, 32 } };
    white.light(scene, view.camera);
    view.quality.ao = AmbientOcclusionTerm::Gtao;
    view.effects.motionBlur.enabled = true;
    for (int frame = 0; frame < 3; ++frame) {
        view.camera.worldFromView[3].x = 0.1 * frame;
        test::extremesOf(test::renderLinear(engine, renderer, scene, view));
    }
    size_t leftOut = 0;
    for (EffectDecision const& decision : renderer.decisions())
        leftOut += decision.reason == "the lens is parallel: it needs a perspective one";
    EXPECT_EQ(leftOut, 2u);
}

} // namespace
} // namespace filament
