// SPDX-License-Identifier: Apache-2.0
// Statistics and distances of images, compared with closed forms.
#include "base/math/Half.h"
#include "toolkit/pictures/Picture.h"
#include "tools/accuracy/Statistics.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstring>

namespace filament_core::accuracy {
namespace {

using testing::DoubleNear;

Picture uniform(uint32_t width, uint32_t height, float value) {
    return { width, height, std::vector<float3>(size_t(width) * height, float3(value)) };
}

TEST(Statistics, TheIntervalHoldsTheMedianAndShrinksWithMoreSamples) {
    std::vector<double> few, many;
    for (int i = 0; i < 9; ++i) few.push_back(10 + std::sin(i * 12.9898) * 3);
    for (int i = 0; i < 400; ++i) many.push_back(10 + std::sin(i * 12.9898) * 3);
    const Estimate wide = estimate(few), narrow = estimate(many);
    EXPECT_LE(wide.low, wide.median);
    EXPECT_GE(wide.high, wide.median);
    EXPECT_LT(narrow.high - narrow.low, 0.5 * (wide.high - wide.low));
}

TEST(Statistics, TheSameSamplesGiveTheSameInterval) {
    const std::vector<double> samples{ 1, 5, 2, 8, 3, 9, 4 };
    const Estimate a = estimate(samples), b = estimate(samples);
    EXPECT_EQ(a.low, b.low);
    EXPECT_EQ(a.high, b.high);
}

TEST(Statistics, ARatioTakenInTurnsDoesNotSeeTheMachineSlowDown) {
    std::vector<double> a, b;
    for (int round = 0; round < 15; ++round) {
        const double load = 1 + round; // fifteen times slower at the end
        a.push_back(3 * load), b.push_back(2 * load);
    }
    const Estimate ratio = estimateRatio(a, b);
    EXPECT_EQ(ratio.median, 1.5);
    EXPECT_EQ(ratio.low, 1.5);
    EXPECT_EQ(ratio.high, 1.5);
}

TEST(Picture, ATenthBrighterIsAnErrorOfATenthOverTheBrighterOne) {
    const ErrorFigures figures = compare(uniform(8, 8, 0.5f), uniform(8, 8, 0.55f));
    const double length = std::sqrt(3.0);
    const double expected = 0.05 * length / (0.55 * length + 0.01 * 0.5 * length);
    EXPECT_THAT(figures.rms, DoubleNear(expected, 1e-6));
    EXPECT_THAT(figures.max, DoubleNear(expected, 1e-6));
    EXPECT_GT(figures.flip, 0.0);
}

TEST(Picture, EqualPicturesHaveNoError) {
    const ErrorFigures figures = compare(uniform(8, 8, 0.5f), uniform(8, 8, 0.5f));
    EXPECT_EQ(figures.rms, 0.0);
    EXPECT_EQ(figures.max, 0.0);
    EXPECT_EQ(figures.flip, 0.0);
}

TEST(Picture, OneBrightPixelIsAnErrorBelowOne) {
    Picture spark = uniform(8, 8, 0.01f);
    spark.pixels[10] = float3(1e6f);
    EXPECT_LE(compare(uniform(8, 8, 0.01f), spark).max, 1.0);
}

TEST(Picture, BackgroundDoesNotDiluteAnError) {
    Picture small = uniform(4, 4, 0.5f), smallBrighter = uniform(4, 4, 0.6f);
    Picture large = uniform(16, 16, 0), largeBrighter = uniform(16, 16, 0);
    for (uint32_t y = 0; y < 4; ++y) {
        for (uint32_t x = 0; x < 4; ++x) {
            large.pixels[(y + 5) * 16 + x + 5] = float3(0.5f);
            largeBrighter.pixels[(y + 5) * 16 + x + 5] = float3(0.6f);
        }
    }
    EXPECT_DOUBLE_EQ(compare(small, smallBrighter).rms, compare(large, largeBrighter).rms);
}

TEST(Picture, WhereEdgesAreSkippedOnePixelOfSilhouetteMayDiffer) {
    Picture shape = uniform(16, 16, 0);
    for (uint32_t y = 4; y < 12; ++y)
        for (uint32_t x = 4; x < 12; ++x) shape.pixels[y * 16 + x] = float3(0.5f);
    Picture grown = shape;
    for (uint32_t y = 4; y < 12; ++y) grown.pixels[y * 16 + 12] = float3(0.5f);
    EXPECT_GT(compare(shape, grown, Edges::Count).rms, 0.1);
    EXPECT_EQ(compare(shape, grown, Edges::Skip).rms, 0.0);
    grown.pixels[8 * 16 + 8] = float3(0.6f); // inside
    EXPECT_GT(compare(shape, grown, Edges::Skip).rms, 0.01);
}

TEST(Picture, ABoxFilterKeepsTheMean) {
    Picture checker = uniform(8, 4, 0);
    for (size_t i = 0; i < checker.pixels.size(); ++i) checker.pixels[i] = float3((i + i / 8) % 2 ? 1.0f : 0.0f);
    const Picture small = boxFiltered(checker, 4);
    ASSERT_EQ(small.width, 2u);
    ASSERT_EQ(small.height, 1u);
    for (float3 const& pixel : small.pixels) EXPECT_EQ(pixel, float3(0.5f));
}

TEST(Picture, HalfFloatsAndCodesBecomeLinearLight) {
    Image half{ .width = 1, .height = 1, .format = Format::RGBA16F, .pixels = std::vector<std::byte>(8) };
    const uint16_t values[4] = { halfFromFloat(0.25f), halfFromFloat(2.0f), halfFromFloat(0), halfFromFloat(1) };
    std::memcpy(half.pixels.data(), values, sizeof(values));
    EXPECT_EQ(pictureOf(half).pixels[0], float3(0.25f, 2.0f, 0));
    const Image codes{ .width = 1,
                       .height = 1,
                       .format = Format::RGBA8,
                       .pixels = { std::byte{ 188 }, std::byte{ 255 }, std::byte{ 0 }, std::byte{ 255 } } };
    const float3 linear = pictureOf(codes).pixels[0];
    EXPECT_NEAR(linear.x, 0.5029f, 1e-4f); // ((188/255 + 0.055) / 1.055)^2.4
    EXPECT_EQ(linear.y, 1.0f);
    EXPECT_EQ(displayImage(pictureOf(codes)).pixels, codes.pixels);
}

} // namespace
} // namespace filament_core::accuracy
