// SPDX-License-Identifier: Apache-2.0
// Motion blur on both APIs: edges become as wide as what moves goes while the shutter is open, light stays, and nothing
// runs where nothing moves.
#include "tests/filament_core/engine/SkyStage.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <filament_core/Renderer.h>

#include <glm/ext/matrix_transform.hpp>

#include <cmath>
#include <functional>
#include <limits>

namespace filament_core {
namespace {

using test::halfPixel;

constexpr uint2 kMotionBlurSize(192, 96);
constexpr double kSquareMeters = 2;
constexpr double kLensDegrees = 40;
constexpr double kHalfSquare = 0.3;
constexpr float kWallLight = 1, kLampLight = 4;

double pixelsPerMeter() { return kMotionBlurSize.y / (2 * kSquareMeters * std::tan(glm::radians(kLensDegrees / 2))); }

/// A square that shines, before a wall that stays.
class Passing {
public:
    explicit Passing(Backend backend)
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))),
              scene(engine), renderer(engine), mSquare(engine) {
        mMaterial =
                test::loadMaterial(engine, test::text("shadingModel : unlit,\n parameters : [ { type : float, name : "
                                                      "light } ]",
                                                      "material.baseColor = vec4(vec3(materialParams.light), 1.0);"));
        mLamp = instance(kLampLight);
        mWall = instance(kWallLight);
        mSquare.add(scene, mWall, double3(0, 0, -kSquareMeters - 3), 40);
        square = mSquare.add(scene, mLamp, double3(0, 0, -kSquareMeters), kHalfSquare);
        lookFrom(0);
        view.size = kMotionBlurSize;
        view.effects.motionBlur = { .enabled = true, .shutterDegrees = 360, .maxRadius = 0.1f };
    }
    ~Passing() { test::expectNoErrors(engine); }

    /// With the middle of the square so many pixels to the right of that of the image.
    Image draw(double pixels) {
        double4x4 world(kHalfSquare);
        world[3] = double4(pixels / pixelsPerMeter(), 0, -kSquareMeters, 1);
        scene.setTransform(square, world);
        return draw();
    }
    Image draw() { return test::renderLinear(engine, renderer, scene, view); }
    void lookFrom(double x) {
        view.camera = Camera::lookAt({ x, 0, 0 }, { x, 0, -1 }, { .verticalFovDegrees = kLensDegrees });
    }

    Engine engine;
    Scene scene;
    Renderer renderer;
    View view;
    Renderable square;

private:
    Owned<MaterialInstance> instance(float light) {
        Owned<MaterialInstance> made = engine.own(engine.createInstance(mMaterial));
        EXPECT_TRUE(engine.set(made, "light", light));
        return made;
    }

    test::SquareMesh mSquare;
    Owned<Material> mMaterial;
    Owned<MaterialInstance> mLamp, mWall;
};

/// The second of two frames; the square moves by so many pixels, to the middle.
Image blurred(
        double pixels, std::function<void(Passing&)> const& set = [](Passing&) {}) {
    std::vector<Image> images;
    for (const Backend backend : test::kBothApis) {
        Passing passing(backend);
        set(passing);
        passing.draw(-pixels);
        images.push_back(passing.draw(0));
    }
    EXPECT_EQ(test::differingPixels(images[0], images[1]), 0u) << pixels;
    return std::move(images[0]);
}

/// The share of the exposure during which the square covers a place, pixels right of the middle, of the middle row.
double coverage(double place, double way) {
    const double edge = kHalfSquare * pixelsPerMeter();
    if (way == 0) return std::abs(place) < edge ? 1 : 0;
    const double first = std::max(-edge, place - way / 2), last = std::min(edge, place + way / 2);
    return std::max(last - first, 0.0) / way;
}

/// Root of the mean square of the differences in the middle row, from the exact image of an open shutter.
double errorOfRow(Image const& image, double way) {
    double squares = 0;
    for (uint32_t x = 0; x < image.width; ++x) {
        const double wanted =
                std::lerp(double{ kWallLight }, double{ kLampLight }, coverage(x + 0.5 - image.width / 2.0, way));
        const double difference = static_cast<double>(halfPixel(image, x, image.height / 2).x) - wanted;
        squares += difference * difference;
    }
    return std::sqrt(squares / image.width);
}

TEST(MotionBlur, SpreadsEdgesOverTheWayThatTheyGo) {
    for (const double pixels : { 4.0, 9.0, 16.0 }) {
        const double sharp =
                errorOfRow(blurred(pixels, [](Passing& at) { at.view.effects.motionBlur.enabled = false; }), pixels);
        EXPECT_LT(errorOfRow(blurred(pixels), pixels), 0.35 * sharp) << pixels << " without: " << sharp;
    }
}

TEST(MotionBlur, HalfAShutterBlursHalfTheWay) {
    const Image half = blurred(16, [](Passing& at) { at.view.effects.motionBlur.shutterDegrees = 180; });
    EXPECT_LT(errorOfRow(half, 8), 0.5 * errorOfRow(half, 16));
}

TEST(MotionBlur, FollowsTheCamera) {
    // Everything moves by 12 pixels at the distance of the square, and by less behind it, where all is alike.
    const double meters = 12 / pixelsPerMeter();
    std::vector<Image> images;
    for (const Backend backend : test::kBothApis) {
        Passing passing(backend);
        passing.lookFrom(meters);
        passing.draw(0);
        passing.lookFrom(0);
        images.push_back(passing.draw(0));
    }
    EXPECT_EQ(test::differingPixels(images[0], images[1]), 0u);
    EXPECT_LT(errorOfRow(images[0], 12), 0.5 * errorOfRow(images[0], 0));
}

TEST(MotionBlur, LeavesAnEvenPictureAlone) {
    for (const Backend backend : test::kBothApis) {
        Passing passing(backend);
        passing.scene.remove(passing.square);
        for (const double x : { 0.0, 0.3 }) {
            passing.lookFrom(x);
            const test::Extremes found = test::extremesOf(passing.draw());
            EXPECT_NEAR(found.least, kWallLight, 2e-3f);
            EXPECT_NEAR(found.most, kWallLight, 2e-3f);
        }
    }
}

TEST(MotionBlur, IsFiniteAtItsEnds) {
    for (const uint2 size : { uint2(1, 1), uint2(3, 90), uint2(131, 17) }) {
        for (const double pixels : { 1e-6, 1e5 }) {
            const Image image = blurred(pixels, [size](Passing& at) { at.view.size = size; });
            const test::Extremes found = test::extremesOf(image);
            EXPECT_GE(found.least, 0.0f);
            EXPECT_LE(found.most, kLampLight * 1.01f);
        }
    }
}

TEST(MotionBlur, CostsNothingWhereNothingMoves) {
    for (const Backend backend : test::kBothApis) {
        Passing passing(backend);
        passing.view.effects.motionBlur.enabled = false;
        passing.draw(0);
        const Image without = passing.draw(0);
        const uint32_t passes = passing.renderer.statistics().passesRun;
        passing.view.effects.motionBlur.enabled = true;
        for (int frame = 0; frame < 3; ++frame) {
            EXPECT_EQ(test::differingPixels(passing.draw(0), without), 0u) << frame;
            EXPECT_EQ(passing.renderer.statistics().passesRun, passes) << frame;
        }
    }
}

} // namespace
} // namespace filament_core
