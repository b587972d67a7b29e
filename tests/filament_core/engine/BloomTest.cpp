// SPDX-License-Identifier: Apache-2.0
// Bloom on both APIs: how far it spreads light, that it adds none, and that it costs nothing where there is nothing to
// spread.
#include "filament_core/passes/BloomPass.h"
#include "tests/filament_core/engine/LampStage.h"

#include <array>
#include <cmath>

namespace filament_core {
namespace {

using test::expectSameAsPlain;
using test::halfPixel;
using test::LampStage;
using test::pictureOfLamp;
using test::sumOf;

/// Of light along x, off the middle of the image, pixels.
double middleOf(Image const& image) {
    double sum = 0, moments = 0;
    for (uint32_t y = 0; y < image.height; ++y) {
        for (uint32_t x = 0; x < image.width; ++x) {
            const double light = static_cast<double>(halfPixel(image, x, y).x);
            sum += light;
            moments += light * (x + 0.5 - image.width / 2.0);
        }
    }
    return moments / sum;
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
// of a level are looked up a quarter off the centre of one of the smaller one: 7/16 of its width squared. A look-up d
// of a texel's width off its centre widens the lobe by d (1 - d), which is 3/16 at half resolution and in the mean
// 11/64 of a quarter, for the one look-up at the end. The weights of a quarter, 1 to 7, move light by 1.75 or 3.75.
double varianceOfLevels(int levels, BloomResolution resolution) {
    const bool isQuarter = resolution == BloomResolution::Quarter;
    const int first = isQuarter ? 1 : 0;
    const double atEnd = isQuarter ? 16 * 11 / 64.0 : 4 * 3 / 16.0;
    double sum = 0;
    for (int i = first; i < first + levels; ++i) {
        double variance = atEnd + (isQuarter ? 3.75 : 0.75);
        for (int j = first + 1; j <= i; ++j) variance += std::pow(4.0, j) * 3 / 4 + std::pow(4.0, j + 1) * 7 / 16;
        sum += variance;
    }
    return sum / levels;
}

TEST(BloomLevels, FollowTheRadius) {
    const auto levels = [](uint2 view, float radius) {
        return passes::bloomLevels(view, radius, BloomResolution::Half);
    };
    EXPECT_EQ(levels({ 1280, 720 }, 0), 1);
    EXPECT_EQ(levels({ 1280, 720 }, 4), 2);
    EXPECT_EQ(levels({ 1280, 720 }, 72), 6);
    EXPECT_EQ(levels({ 1280, 720 }, 1e9f), 9) << "the last is a texel high";
    EXPECT_EQ(levels({ 16384, 16384 }, 1e9f), 10);
    EXPECT_EQ(levels({ 1, 1 }, 100), 1);
    EXPECT_EQ(levels({ 5000, 3 }, 100), 1);
}

TEST(BloomLevels, OfAQuarterReachAsFarWithOneLess) {
    for (const uint2 view : { uint2(1, 1), uint2(3, 2), uint2(1280, 720), uint2(131, 17), uint2(16384, 16384) }) {
        for (float radius = 0; radius < 1e5f; radius = 2 * radius + 1) {
            const int half = passes::bloomLevels(view, radius, BloomResolution::Half);
            EXPECT_EQ(passes::bloomLevels(view, radius, BloomResolution::Quarter), std::max(1, half - 1))
                    << view.x << " x " << view.y << ", " << radius;
        }
    }
}

TEST(Bloom, SpreadsLightAsFarAsTheSumOfItsLobes) {
    for (const BloomResolution resolution : { BloomResolution::Half, BloomResolution::Quarter }) {
        for (const auto& [radius, levels] : { std::pair(0.004f, 1), std::pair(0.03f, 3), std::pair(0.0625f, 4) }) {
            const Image spread = pictureOfLamp(64, 1 / 128.0, [resolution, radius = radius](View& view) {
                view.effects.bloom = { .enabled = true, .strength = 1, .radius = radius };
                view.effects.bloom.resolution = resolution;
            });
            const double ofLamp = 0.25; // two pixels, each half a pixel off the middle
            const int drawn = resolution == BloomResolution::Half ? levels : std::max(1, levels - 1);
            const double wanted = varianceOfLevels(drawn, resolution) + ofLamp;
            EXPECT_NEAR(varianceOf(spread), wanted, 0.002 * wanted) << toString(resolution) << ", " << levels;
        }
    }
}

// Wherever the lamp is in a texel of the first level, the middle of its light is where it was.
TEST(Bloom, OfAQuarterKeepsLightInItsPlace) {
    for (int i = 0; i < 8; ++i) {
        const auto blooming = [](View& view) {
            view.effects.bloom = { .enabled = true, .strength = 1, .radius = 0.03f };
            view.effects.bloom.resolution = BloomResolution::Quarter;
        };
        const Image spread = pictureOfLamp(64, 1 / 128.0, blooming, { i / 128.0, 0 });
        EXPECT_NEAR(middleOf(spread), i, 0.02) << "pixels to the right";
    }
}

TEST(Bloom, MovesLightAndAddsNone) {
    const double before = sumOf(pictureOfLamp(8, 0.25, [](View&) {}));
    for (const BloomResolution resolution : { BloomResolution::Half, BloomResolution::Quarter }) {
        for (const float strength : { 0.1f, 0.5f, 1.0f }) {
            const Image image = pictureOfLamp(8, 0.25, [&](View& view) {
                view.effects.bloom = { .enabled = true, .strength = strength, .radius = 0.05f };
                view.effects.bloom.resolution = resolution;
            });
            EXPECT_NEAR(sumOf(image), before, 0.005 * before) << strength << " " << toString(resolution);
            EXPECT_GT(halfPixel(image, 92, 128).x, 0.0f) << "beside the lamp";
        }
    }
}

/// An image of one light stays what it is, up to its edges.
TEST(Bloom, LeavesAnEvenPictureAlone) {
    for (const BloomResolution resolution : { BloomResolution::Half, BloomResolution::Quarter }) {
        const Image image = pictureOfLamp(0.75f, 4, [resolution](View& view) {
            view.effects.bloom = { .enabled = true, .strength = 0.5f, .radius = 0.3f };
            view.effects.bloom.resolution = resolution;
        });
        const test::Extremes found = test::extremesOf(image);
        EXPECT_NEAR(found.least, 0.75f, 2e-3f) << toString(resolution);
        EXPECT_NEAR(found.most, 0.75f, 2e-3f) << toString(resolution);
    }
}

TEST(Bloom, BelowItsThresholdNothingChanges) {
    const Image off = pictureOfLamp(0.9f, 0.25, [](View&) {});
    const Image on = pictureOfLamp(
            0.9f, 0.25, [](View& view) { view.effects.bloom = { .enabled = true, .strength = 1, .threshold = 1 }; });
    EXPECT_EQ(test::differingPixels(off, on), 0u);
}

TEST(Bloom, IsFiniteAtItsEndsAndInAllSizes) {
    for (const uint2 size : { uint2(1, 1), uint2(3, 70), uint2(131, 17), uint2(64, 64) }) {
        for (const float radius : { 1e-3f, 1.0f }) {
            for (const uint8_t samples : { uint8_t{ 1 }, uint8_t{ 4 } }) {
                const Image image = pictureOfLamp(60'000, 0.5, [&](View& view) {
                    view.size = size;
                    view.samples = samples;
                    view.effects.bloom = { .enabled = true, .strength = 0.5f, .radius = radius };
                    view.effects.bloom.resolution = samples == 1 ? BloomResolution::Quarter : BloomResolution::Half;
                });
                EXPECT_GE(test::extremesOf(image).least, 0);
            }
        }
    }
}

TEST(Bloom, CostsNothingWithoutAnythingToSpread) {
    for (const Backend backend : test::kBothApis) {
        LampStage lamp(backend, 2, 0.25);
        expectSameAsPlain(lamp, "switched off: bloom=off");
        lamp.view.effects.bloom = { .enabled = true, .strength = 0 };
        expectSameAsPlain(lamp, "its intensity is 0");
        LampStage dark(backend, 2, 0);
        dark.view.effects.bloom = { .enabled = true };
        expectSameAsPlain(dark, "nothing is visible, not even a sky");
    }
}

// ---- dirt on the lens

/// Columns of sRGB codes, as wide as each other, with all mip levels.
Owned<Texture> columns(Engine& engine, std::vector<uint8_t> const& codes) {
    constexpr uint32_t kSide = 64;
    std::vector<std::byte> texels;
    for (uint32_t i = 0; i < kSide * kSide; ++i) {
        const auto code = std::byte{ codes[i % kSide * codes.size() / kSide] };
        texels.insert(texels.end(), { code, code, code, std::byte{ 255 } });
    }
    return engine.own(engine.create(TextureDesc{ .format = Format::RGBA8Srgb,
                                                 .width = kSide,
                                                 .height = kSide,
                                                 .generateMips = true,
                                                 .pixels = texels,
                                                 .name = "dirt" }));
}

/// The lamp in the middle, all of whose light is scattered; without codes the lens is clean.
Image pictureThroughDirt(std::vector<uint8_t> const& codes, float dirtStrength, float strength = 1) {
    std::vector<Image> images;
    for (const Backend backend : test::kBothApis) {
        LampStage stage(backend, 8, 0.25);
        Owned<Texture> dirt;
        if (!codes.empty()) dirt = columns(stage.engine, codes);
        stage.view.effects.bloom = {
            .enabled = true, .strength = strength, .radius = 0.05f, .dirt = dirt, .dirtStrength = dirtStrength
        };
        images.push_back(test::renderLinear(stage.engine, stage.scene, stage.view));
    }
    EXPECT_EQ(test::differingPixels(images[0], images[1]), 0u);
    return std::move(images[0]);
}

TEST(BloomThroughDirt, ComesWhereTheLensIsDirty) {
    const Image clean = pictureThroughDirt({}, 1);
    for (const float share : { 1.0f, 0.5f, 0.25f }) {
        const Image image = pictureThroughDirt({ 0, 255 }, share); // twice the mean to the right, none to the left
        for (const uint32_t x : { 40u, 70u, 100u, 156u, 186u, 216u }) {
            for (const uint32_t y : { 60u, 128u, 190u }) {
                const float factor = x < 128 ? 1 - share : 1 + share;
                const float expected = halfPixel(clean, x, y).x * factor;
                EXPECT_NEAR(halfPixel(image, x, y).x, expected, 0.01f * expected + 1e-4f) << x << " " << y;
            }
        }
        EXPECT_NEAR(sumOf(image), sumOf(clean), 0.005 * sumOf(clean)) << "the lamp is in the middle of both";
    }
}

TEST(BloomThroughDirt, IsThatOfACleanLensWhereDirtIsEven) {
    const Image clean = pictureThroughDirt({}, 1, 0.5f);
    for (const uint8_t code : { uint8_t{ 60 }, uint8_t{ 255 } }) {
        const Image even = pictureThroughDirt({ code }, 1, 0.5f);
        for (uint32_t y = 0; y < even.height; ++y)
            for (uint32_t x = 0; x < even.width; ++x)
                ASSERT_NEAR(halfPixel(even, x, y).x, halfPixel(clean, x, y).x, 2e-3f * halfPixel(clean, x, y).x + 1e-5f)
                        << x << " " << y;
    }
}

TEST(BloomThroughDirt, IsFiniteWithoutAnyDirtInATexture) {
    const Image black = pictureThroughDirt({ 0 }, 1);
    EXPECT_EQ(test::extremesOf(black).most, 0.0f) << "nothing is scattered towards the picture";
}

TEST(BloomThroughDirt, OfNoStrengthIsThatOfACleanLens) {
    EXPECT_EQ(test::differingPixels(pictureThroughDirt({}, 1), pictureThroughDirt({ 0, 255 }, 0)), 0u);
}

TEST(BloomThroughDirt, IsNotWhatTheFrameDrawsTo) {
    LampStage stage(Backend::Vulkan, 8, 0.25);
    const Owned<Texture> pixels = stage.engine.own(stage.engine.create(
            TextureDesc{ .width = 64, .height = 64, .levels = 7, .renderable = true, .name = "pane" }));
    const Owned<RenderTarget> target =
            stage.engine.own(stage.engine.create(RenderTargetDesc{ .color = pixels, .generateMips = true }));
    stage.view.size = { 64, 64 };
    stage.view.effects.bloom = { .enabled = true, .dirt = pixels };
    Renderer renderer(stage.engine);
    renderer.render(stage.scene, stage.view, target.get());
    const std::vector<std::string> errors = stage.engine.takeErrors();
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_NE(errors[0].find("the dirt of bloom is 'pane', which the frame draws to"), std::string::npos) << errors[0];
}

TEST(BloomThroughDirt, IsNamedByExplain) {
    LampStage stage(Backend::Vulkan, 8, 0.25);
    const Owned<Texture> dirt = columns(stage.engine, { 0, 255 });
    stage.view.effects.bloom = { .enabled = true, .dirt = dirt };
    Renderer renderer(stage.engine);
    ASSERT_TRUE(renderer.renderToImage(stage.scene, stage.view));
    EXPECT_NE(renderer.explain().find("by dirt on the lens"), std::string::npos) << renderer.explain();
}

} // namespace
} // namespace filament_core
