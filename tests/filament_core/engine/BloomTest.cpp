// SPDX-License-Identifier: Apache-2.0
// Bloom on both APIs: how far it spreads light, that it adds none, and that it costs nothing where there is nothing to
// spread.
#include "filament_core/passes/BloomPass.h"
#include "tests/filament_core/engine/SkyStage.h"
#include "tests/filament_core/engine/materials/MaterialFixture.h"

#include <filament/Renderer.h>

#include <cmath>
#include <functional>

namespace filament {
namespace {

using test::halfPixel;

/// A square in front of black.
class BloomingLamp {
public:
    BloomingLamp(Backend backend, float light, double side)
            : engine(std::move(*Engine::create({ .backend = backend, .workers = 1, .validation = true }))),
              mSquare(engine), scene(engine) {
        mMaterial = test::loadMaterial(engine,
                                       test::text("shadingModel : unlit",
                                                  fmt::format("material.baseColor = vec4(vec3({:.3f}), 1.0);", light)));
        mInstance = engine.own(engine.createInstance(mMaterial));
        if (side > 0) mSquare.add(scene, mInstance, {}, side);
        view.camera = Camera::lookAt({ 0, 0, 1 }, { 0, 0, 0 }, { .verticalFovDegrees = 90 }); // the picture is 2 m high
        view.size = { 256, 256 };
    }
    ~BloomingLamp() { test::expectNoErrors(engine); }

    Engine engine;

private:
    test::SquareMesh mSquare;
    Owned<Material> mMaterial;
    Owned<MaterialInstance> mInstance;

public:
    Scene scene;
    View view;
};

/// The pictures of both APIs, which have the same bits.
Image pictureOf(float light, double side, std::function<void(View&)> const& set) {
    std::vector<Image> images;
    for (const Backend backend : test::kBothApis) {
        BloomingLamp lamp(backend, light, side);
        set(lamp.view);
        images.push_back(test::renderLinear(lamp.engine, lamp.scene, lamp.view));
    }
    EXPECT_EQ(test::differingPixels(images[0], images[1]), 0u);
    return std::move(images[0]);
}

double sumOf(Image const& image) {
    double sum = 0;
    for (uint32_t y = 0; y < image.height; ++y)
        for (uint32_t x = 0; x < image.width; ++x) sum += static_cast<double>(halfPixel(image, x, y).x);
    return sum;
}

/// Along x, about the middle.
double varianceOf(Image const& image) {
    double sum = 0, squares = 0;
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            const double light = static_cast<double>(halfPixel(image, x, y).x);
            const double away = x + 0.5 - image.width / 2.0;
            sum += light;
            squares += light * away * away;
        }
    }
    return squares / sum;
}

// A level's lobe: of the weights 1, 3, 3, 1 on the way down, of two look-ups between texels on the way up. All texels
// of a level are looked up a quarter off the centre of one of the smaller one: 7/16 of its width squared, and 3/16 for
// the one look-up at the end.
double varianceOfLevels(int levels) {
    double sum = 0;
    for (int i = 0; i < levels; ++i) {
        double variance = (std::pow(4.0, i + 1) - 1) / 4 + 4 * 3 / 16.0;
        for (int j = 1; j <= i; ++j) variance += std::pow(4.0, j + 1) * 7 / 16;
        sum += variance;
    }
    return sum / levels;
}

TEST(BloomLevels, FollowTheRadius) {
    using passes::bloomLevels;
    EXPECT_EQ(bloomLevels({ 1280, 720 }, 0), 1);
    EXPECT_EQ(bloomLevels({ 1280, 720 }, 4), 2);
    EXPECT_EQ(bloomLevels({ 1280, 720 }, 72), 6);
    EXPECT_EQ(bloomLevels({ 1280, 720 }, 1e9f), 9) << "the last is a texel high";
    EXPECT_EQ(bloomLevels({ 16384, 16384 }, 1e9f), 10);
    EXPECT_EQ(bloomLevels({ 1, 1 }, 100), 1);
    EXPECT_EQ(bloomLevels({ 5000, 3 }, 100), 1);
}

TEST(Bloom, SpreadsLightAsFarAsTheSumOfItsLobes) {
    for (const auto& [radius, levels] : { std::pair(0.004f, 1), std::pair(0.03f, 3), std::pair(0.0625f, 4) }) {
        const Image spread = pictureOf(64, 1 / 128.0, [&](View& view) {
            view.effects.bloom = { .enabled = true, .strength = 1, .radius = radius };
        });
        const double ofLamp = 0.25; // two pixels, each half a pixel off the middle
        const double wanted = varianceOfLevels(levels) + ofLamp;
        EXPECT_NEAR(varianceOf(spread), wanted, 0.002 * wanted) << levels << " levels";
    }
}

TEST(Bloom, MovesLightAndAddsNone) {
    const double before = sumOf(pictureOf(8, 0.25, [](View&) {}));
    for (const float strength : { 0.1f, 0.5f, 1.0f }) {
        const Image image = pictureOf(8, 0.25, [&](View& view) {
            view.effects.bloom = { .enabled = true, .strength = strength, .radius = 0.05f };
        });
        EXPECT_NEAR(sumOf(image), before, 0.005 * before) << strength;
        EXPECT_GT(halfPixel(image, 92, 128).x, 0.0f) << "beside the lamp";
    }
}

/// A picture of one light stays what it is, up to its edges.
TEST(Bloom, LeavesAnEvenPictureAlone) {
    const Image image = pictureOf(
            0.75f, 4, [](View& view) { view.effects.bloom = { .enabled = true, .strength = 0.5f, .radius = 0.3f }; });
    const test::Extremes found = test::extremesOf(image);
    EXPECT_NEAR(found.least, 0.75f, 2e-3f);
    EXPECT_NEAR(found.most, 0.75f, 2e-3f);
}

TEST(Bloom, BelowItsThresholdNothingChanges) {
    const Image off = pictureOf(0.9f, 0.25, [](View&) {});
    const Image on = pictureOf(
            0.9f, 0.25, [](View& view) { view.effects.bloom = { .enabled = true, .strength = 1, .threshold = 1 }; });
    EXPECT_EQ(test::differingPixels(off, on), 0u);
}

TEST(Bloom, IsFiniteAtItsEndsAndInAllSizes) {
    for (const uint2 size : { uint2(1, 1), uint2(3, 70), uint2(131, 17), uint2(64, 64) }) {
        for (const float radius : { 1e-3f, 1.0f }) {
            for (const uint8_t samples : { uint8_t{ 1 }, uint8_t{ 4 } }) {
                const Image image = pictureOf(60'000, 0.5, [&](View& view) {
                    view.size = size;
                    view.samples = samples;
                    view.effects.bloom = { .enabled = true, .strength = 0.5f, .radius = radius };
                });
                EXPECT_GE(test::extremesOf(image).least, 0);
            }
        }
    }
}

/// The passes of a frame, and what explain() says of bloom.
void expectNone(BloomingLamp& lamp, const char* reason) {
    Renderer renderer(lamp.engine);
    const View plain{ .camera = lamp.view.camera, .size = lamp.view.size };
    (void)renderer.renderToImage(lamp.scene, plain);
    const uint32_t passes = renderer.statistics().passesRun, draws = renderer.statistics().draws;
    const auto before = renderer.renderToImage(lamp.scene, plain);
    const auto after = renderer.renderToImage(lamp.scene, lamp.view);
    EXPECT_EQ(renderer.statistics().passesRun, passes);
    EXPECT_EQ(renderer.statistics().draws, draws);
    ASSERT_TRUE(before && after);
    EXPECT_EQ(before->pixels, after->pixels);
    EXPECT_NE(renderer.explain().find(reason), std::string::npos) << renderer.explain();
}

TEST(Bloom, CostsNothingWithoutAnythingToSpread) {
    for (const Backend backend : test::kBothApis) {
        BloomingLamp lamp(backend, 2, 0.25);
        expectNone(lamp, "switched off: bloom=off");
        lamp.view.effects.bloom = { .enabled = true, .strength = 0 };
        expectNone(lamp, "its intensity is 0");
        BloomingLamp dark(backend, 2, 0);
        dark.view.effects.bloom = { .enabled = true };
        expectNone(dark, "nothing is visible, not even a sky");
    }
}

} // namespace
} // namespace filament
