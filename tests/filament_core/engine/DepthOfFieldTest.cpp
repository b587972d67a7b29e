// SPDX-License-Identifier: Apache-2.0
// Depth of field on both APIs: discs as large as the thin lens makes them, light that stays, and no passes where
// everything is sharp.
#include "tests/filament_core/engine/SkyStage.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <filament_core/Renderer.h>

#include <cmath>
#include <functional>

namespace filament_core {
namespace {

using test::halfPixel;

constexpr uint2 kFocusSize(192, 192);

/// A small lamp on the axis of the camera, before black.
class LampAt {
public:
    LampAt(Backend backend, double meters, double side)
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))),
              scene(engine), mSquare(engine) {
        mMaterial = test::loadMaterial(engine, test::text("shadingModel : unlit", "material.baseColor = vec4(4.0);"));
        mInstance = engine.own(engine.createInstance(mMaterial));
        mSquare.add(scene, mInstance, double3(0, 0, -meters), side);
        view.camera = Camera::lookAt({ 0, 0, 0 }, { 0, 0, -1 }, { .verticalFovDegrees = 40 });
        view.camera.exposure = { .aperture = 1.4f };
        view.size = kFocusSize;
        view.effects.depthOfField = { .enabled = true, .focusMeters = 2, .blurScale = 4 };
    }
    ~LampAt() { test::expectNoErrors(engine); }

    Engine engine;
    Scene scene;
    View view;

private:
    test::SquareMesh mSquare;
    Owned<Material> mMaterial;
    Owned<MaterialInstance> mInstance;
};

Image focused(
        double meters, double side, std::function<void(View&)> const& set = [](View&) {}) {
    std::vector<Image> images;
    for (const Backend backend : test::kBothApis) {
        LampAt lamp(backend, meters, side);
        set(lamp.view);
        images.push_back(test::renderLinear(lamp.engine, lamp.scene, lamp.view));
    }
    EXPECT_EQ(test::differingPixels(images[0], images[1]), 0u) << meters;
    return std::move(images[0]);
}

/// In pixels, by Potmesil and Chakravarty's formula for a sensor 24 mm high.
double discRadius(View const& view, double meters) {
    const double focal = 0.012 / std::tan(glm::radians(20.0));
    const double focus = static_cast<double>(view.effects.depthOfField.focusMeters);
    const double diameter = focal * focal * std::abs(meters - focus) /
                            (static_cast<double>(view.camera.exposure.aperture) * meters * (focus - focal));
    return diameter / 2 / 0.024 * view.size.y * static_cast<double>(view.effects.depthOfField.blurScale);
}

struct Spot {
    double light = 0, radius = 0; ///< of a disc of the same variance
};

Spot spotOf(Image const& image) {
    Spot spot;
    double squares = 0;
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            const auto light = static_cast<double>(halfPixel(image, x, y).x);
            const double2 away = double2(x + 0.5, y + 0.5) - double2(image.width, image.height) / 2.0;
            spot.light += light;
            squares += light * glm::dot(away, away);
        }
    }
    spot.radius = std::sqrt(2 * squares / spot.light);
    return spot;
}

TEST(DepthOfField, DrawsDiscsOfTheThinLens) {
    for (const double meters : { 1.2, 1.5, 3.0, 8.0 }) {
        const double side = 0.004 * meters; // about a pixel and a half
        const auto wide = [](View& view) {
            view.effects.depthOfField.blurScale = 12;
            view.effects.depthOfField.maxRadius = 0.1f;
        };
        const auto sharp = [](View& view) { view.effects.depthOfField.enabled = false; };
        LampAt lamp(Backend::Vulkan, meters, side);
        wide(lamp.view);
        const Spot blurred = spotOf(focused(meters, side, wide)), point = spotOf(focused(meters, side, sharp));
        const double radius = std::min(discRadius(lamp.view, meters), 0.1 * kFocusSize.y);
        EXPECT_NEAR(blurred.radius, radius, 0.15 * radius + 1.5) << meters;
        // Its disc is weighted against the blur of the background, which differs.
        EXPECT_NEAR(blurred.light, point.light, 0.35 * point.light) << meters;
    }
}

TEST(DepthOfField, StopsAtItsLargestRadius) {
    const auto wide = [](View& view) {
        view.effects.depthOfField.blurScale = 100;
        view.effects.depthOfField.maxRadius = 0.05f;
    };
    EXPECT_LT(spotOf(focused(8, 0.03, wide)).radius, 0.05 * kFocusSize.y + 2);
}

TEST(DepthOfField, LeavesAnEvenPictureAlone) {
    for (const double meters : { 1.0, 2.0, 9.0 }) {
        const test::Extremes found = test::extremesOf(focused(meters, 20));
        EXPECT_NEAR(found.least, 4, 4e-3f) << meters;
        EXPECT_NEAR(found.most, 4, 4e-3f) << meters;
    }
}

TEST(DepthOfField, IsFiniteAtItsEnds) {
    for (const float focus : { 0.0f, 1e9f }) {
        for (const uint2 size : { uint2(1, 1), uint2(3, 90), uint2(131, 17) }) {
            const Image image = focused(3, 1, [&](View& view) {
                view.effects.depthOfField.focusMeters = focus;
                view.effects.depthOfField.maxRadius = 0.1f;
                view.effects.depthOfField.blades = 5;
                view.size = size;
            });
            EXPECT_GE(test::extremesOf(image).least, 0.0f);
        }
    }
}

TEST(DepthOfField, CostsNothingWhereEverythingIsSharp) {
    for (const Backend backend : test::kBothApis) {
        LampAt lamp(backend, 2.0005, 0.1);
        Renderer renderer(lamp.engine);
        lamp.view.effects.depthOfField.enabled = false;
        const auto before = renderer.renderToImage(lamp.scene, lamp.view);
        const uint32_t passes = renderer.statistics().passesRun;
        lamp.view.effects.depthOfField.enabled = true;
        const auto after = renderer.renderToImage(lamp.scene, lamp.view);
        ASSERT_TRUE(before && after);
        EXPECT_EQ(renderer.statistics().passesRun, passes);
        EXPECT_EQ(before->pixels, after->pixels);
        EXPECT_NE(renderer.explain().find("everything visible is in focus"), std::string::npos);
        lamp.view.camera.exposure.aperture = 1e6f; // a pinhole
        lamp.view.effects.depthOfField.focusMeters = 0.5f;
        (void)renderer.renderToImage(lamp.scene, lamp.view);
        EXPECT_EQ(renderer.statistics().passesRun, passes);
    }
}

} // namespace
} // namespace filament_core
