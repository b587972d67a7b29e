// SPDX-License-Identifier: Apache-2.0
// Parallel and shifted lenses on both APIs: in closed form, beside a perspective lens that is far away, and with every
// effect that looks at depths.
#include "tests/filament_core/engine/ShadowStage.h"
#include "tests/filament_core/engine/WhiteEnvironment.h"

#include <functional>

namespace filament_core {
namespace {

using prepare::Random;
using test::ShadowStage;

constexpr const char* kLensFlat = R"(material { name : flat, shadingModel : unlit, culling : none,
    parameters : [ { type : float4, name : color } ] }
fragment { void material(inout MaterialInputs material) { prepareMaterial(material); material.baseColor = materialParams.color; } })";
constexpr const char* kLensMetal = R"(material { name : metal, shadingModel : lit }
fragment { void material(inout MaterialInputs material) {
    prepareMaterial(material);
    material.baseColor.rgb = vec3(0.9, 0.7, 0.3);
    material.metallic = 1.0;
    material.roughness = 0.3;
} })";

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
        const View view{ .camera = above(8, Lens::orthographic(-3, 5, -2, 4, 0, 20)), .size = { 64, 48 } };
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

// View and light have one direction each, so a plane has one colour.
TEST_P(LensTest, ASmoothPlaneHasOneColourAndThatOfAFarCamera) {
    Engine& engine = stage.engine;
    const Owned<Material> metal = test::loadMaterial(engine, kLensMetal);
    const Owned<MaterialInstance> gold = engine.own(engine.createInstance(metal));
    Scene scene(engine);
    stage.square.add(scene, gold, {}, 50);
    scene.add(SunLight{ .directionWorld = { 0.5f, 0.3f, -1 }, .illuminance = Lux{ 40'000 } });
    View view{ .camera = Camera::lookAt({ -3, -2, 8 }, { 0, 0, 0 }, { .orthographicHeight = 6 }), .size = { 16, 12 } };
    const Image parallel = test::renderLinear(engine, scene, view);
    const float4 color = test::halfPixel(parallel, 0, 0);
    EXPECT_GT(color.x, 0.01f);
    for (uint32_t i = 0; i < 16 * 12; ++i) EXPECT_EQ(test::halfPixel(parallel, i % 16, i / 16), color);
    view.camera = Camera::lookAt(double3(-3, -2, 8) * 1000.0, { 0, 0, 0 }, { .verticalFovDegrees = 0.01f });
    const float4 far = test::halfPixel(test::renderLinear(engine, scene, view), 8, 6);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(far[c], color[c], 0.004f * color[c]);
}

// ---------------------------------------------------------------------------------------------- beside a far camera

constexpr double kFar = 400; ///< metres: where a perspective lens is nearly orthographic
constexpr float kHigh = 5;   ///< metres, of the image

struct LensCase {
    const char* name;
    std::function<void(View&)> turnOn;
    float most = 0; ///< of the mean difference between both cameras, over what the effect changes
};

double meanDifference(Image const& a, Image const& b) {
    double sum = 0;
    for (uint32_t i = 0; i < a.width * a.height; ++i) {
        const float4 difference =
                glm::abs(test::halfPixel(a, i % a.width, i / a.width) - test::halfPixel(b, i % a.width, i / a.width));
        sum += static_cast<double>(difference.x + difference.y + difference.z);
    }
    return sum / (a.width * a.height);
}

/// A crowd seen by a parallel lens at 10 m, and by a perspective one that is kFar metres farther away.
struct LensStage {
    ShadowStage stage;
    WhiteEnvironment white{ stage.engine };
    Scene scene{ stage.engine };

    explicit LensStage(Backend backend) : stage(backend) {
        Random random(11);
        test::addCrowd(stage, scene, random, 1);
        white.light(scene, Camera{});
    }

    Image draw(bool isParallel, LensCase const& effect, bool isOn) {
        const double3 back = glm::normalize(double3(1, -2, 2));
        const double distance = isParallel ? 10 : 10 + kFar;
        const Lens lens = isParallel ? Lens{ .nearMeters = 0.5f, .orthographicHeight = kHigh, .farMeters = 100 }
                                     : Lens{ .verticalFovDegrees = static_cast<float>(
                                                     glm::degrees(2 * std::atan(kHigh / 2 / (10 + kFar)))),
                                             .nearMeters = static_cast<float>(kFar) };
        View view{ .camera = Camera::lookAt(back * distance, { 0, 0, 0 }, lens, {}, { 0, 0, 1 }), .size = { 96, 72 } };
        view.quality.shadows = ShadowFilter::Off;
        if (isOn) effect.turnOn(view);
        if (!isParallel) view.effects.fog.startMeters += static_cast<float>(kFar);
        return test::renderLinear(stage.engine, scene, view);
    }
};

std::vector<LensCase> lensCases() {
    const auto ao = [](AmbientOcclusionMethod method, AmbientOcclusionResolution resolution, bool bent) {
        return [=](View& view) {
            view.effects.ambientOcclusion.enabled = true;
            view.effects.ambientOcclusion.method = method;
            view.effects.ambientOcclusion.resolution = resolution;
            view.effects.ambientOcclusion.bentNormals = bent;
            view.effects.ambientOcclusion.radiusMeters = 0.5f;
        };
    };
    using Method = AmbientOcclusionMethod;
    using Resolution = AmbientOcclusionResolution;
    return {
        { "gtao", ao(Method::Gtao, Resolution::Full, false), 0.15f },
        { "sao half", ao(Method::Sao, Resolution::Half, false), 0.25f },
        { "gtao checkerboard", ao(Method::Gtao, Resolution::Checkerboard, false), 0.25f },
        { "bent normals", ao(Method::Gtao, Resolution::Full, true), 0.15f },
        { "shadows", [](View& view) { view.quality.shadows = ShadowFilter::Pcf3; }, 0.15f },
        { "fog",
          [](View& view) {
              view.effects.fog = { .enabled = true, .density = 0.1f, .startMeters = 4, .heightFalloff = 0.5f };
          },
          0.05f },
    };
}

TEST_P(LensTest, EffectsShowWhatTheyShowFromFarAway) {
    LensStage crowd(GetParam());
    for (LensCase const& effect : lensCases()) {
        SCOPED_TRACE(effect.name);
        const Image off = crowd.draw(true, effect, false), on = crowd.draw(true, effect, true);
        const Image farOff = crowd.draw(false, effect, false), farOn = crowd.draw(false, effect, true);
        const double changed = meanDifference(off, on), asFar = meanDifference(on, farOn),
                     bare = meanDifference(off, farOff);
        EXPECT_GT(changed, 0.002) << "the effect is seen";
        EXPECT_LT(asFar, bare + changed * static_cast<double>(effect.most));
    }
}

TEST_P(LensTest, PickingAndDepthsAreThoseOfTheBox) {
    Engine& engine = stage.engine;
    Scene scene(engine);
    const Renderable low = stage.square.add(scene, stage.white, { 0, 0, -1 }, 3);
    const Renderable high = stage.square.add(scene, stage.white, { 1, 0.5, 2 }, 0.6);
    Renderer renderer(engine);
    for (const bool isShifted : { false, true }) {
        View view{ .camera = above(5, { .nearMeters = 0, .orthographicHeight = 4, .farMeters = 50 }),
                   .size = { 32, 32 } };
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
    View view{ .camera = above(5, { .orthographicHeight = 4 }), .size = { 32, 32 } };
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

// ---------------------------------------------------------------------------------------------- the same on both APIs

TEST(LensBits, BothApisDrawTheSamePicturesOfEveryLens) {
    LensStage vulkan(Backend::Vulkan), gles(Backend::Gles);
    std::vector<LensCase> cases = lensCases();
    cases.push_back({ "everything", [](View& view) {
                         for (LensCase const& other : lensCases()) other.turnOn(view);
                         view.effects.depthOfField.enabled = true;
                         view.effects.motionBlur.enabled = true;
                         view.quality.antiAliasing = AntiAliasing::Taa;
                     } });
    for (LensCase const& effect : cases) {
        SCOPED_TRACE(effect.name);
        EXPECT_EQ(test::differingPixels(vulkan.draw(true, effect, true), gles.draw(true, effect, true)), 0u);
    }
}

TEST_P(LensTest, EveryFrameOfAMovingParallelCameraIsFinite) {
    LensStage crowd(GetParam());
    Renderer renderer(crowd.stage.engine);
    for (int frame = 0; frame < 6; ++frame) {
        const double turn = frame * 0.2;
        const Lens lens{ .nearMeters = 0,
                         .orthographicHeight = 3 + 0.5f * static_cast<float>(frame),
                         .farMeters = 60,
                         .shift = { 0.1f * static_cast<float>(frame), 0 } };
        View view{ .camera = Camera::lookAt({ 6 * std::cos(turn), 6 * std::sin(turn), 4 }, { 0, 0, 0 }, lens, {},
                                            { 0, 0, 1 }),
                   .size = { 64, 48 } };
        for (LensCase const& other : lensCases()) other.turnOn(view);
        view.effects.screenSpaceReflections.enabled = true;
        view.effects.motionBlur.enabled = true;
        view.quality.antiAliasing = AntiAliasing::Taa;
        test::extremesOf(test::renderLinear(crowd.stage.engine, renderer, crowd.scene, view));
    }
}

} // namespace
} // namespace filament_core
