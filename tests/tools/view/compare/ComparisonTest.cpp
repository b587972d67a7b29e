// SPDX-License-Identifier: Apache-2.0
// Pictures made by code, whose differences are known.
#include "tools/view/compare/Comparison.h"

#include "base/math/Half.h"
#include "toolkit/pictures/Pixels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace filament_core::view {
namespace {

using ::testing::HasSubstr;

constexpr Format kFormats[] = { Format::RGBA8, Format::RGBA8Srgb, Format::RGB10A2, Format::RGBA16F };

Image randomPicture(Format format, uint32_t width, uint32_t height, uint32_t seed) {
    std::mt19937 random(seed);
    Image image{ .width = width, .height = height, .format = format };
    const size_t bytes = format == Format::RGBA16F ? 8 : 4;
    image.pixels.resize(bytes * width * height);
    for (size_t i = 0; i < image.pixels.size(); i += 2) {
        // Halves up to 2: finite in each format.
        const auto bits = static_cast<uint16_t>(random() % (format == Format::RGBA16F ? 0x4000 : 0x10000));
        std::memcpy(&image.pixels[i], &bits, 2);
    }
    return image;
}

Image grey(uint32_t width, uint32_t height, uint8_t code) {
    return { .width = width,
             .height = height,
             .pixels = std::vector<std::byte>(size_t{ 4 } * width * height, std::byte{ code }) };
}

TEST(Comparison, OfAPictureWithItselfIsEveryPixelInEveryFormat) {
    for (const Format format : kFormats) {
        const Image a = randomPicture(format, 13, 7, 1);
        const auto same = compareImages(a, a);
        ASSERT_TRUE(same.ok()) << same.error().message;
        EXPECT_EQ(same->percentage(), "100.0000 %");
        EXPECT_EQ(same->identical, 91u);
        EXPECT_EQ(same->maxDifference, 0u);
        EXPECT_FALSE(same->first);
        const auto map = differenceMap(a, a);
        ASSERT_TRUE(map.ok());
        for (size_t i = 0; i < pixelCount(*map); ++i)
            EXPECT_EQ(pixelAt(*map, i), (std::array<float, 4>{ 0, 0, 0, 1 })) << i;
    }
}

TEST(Comparison, FindsAnySingleBitOfAnyPixel) {
    for (const Format format : kFormats) {
        const Image a = randomPicture(format, 5, 3, 2);
        const size_t stride = a.pixels.size() / 15;
        for (size_t bit = 0; bit < 8 * a.pixels.size(); ++bit) {
            Image b = a;
            b.pixels[bit / 8] ^= std::byte(1u << bit % 8);
            const auto differs = compareImages(a, b);
            ASSERT_TRUE(differs.ok());
            ASSERT_EQ(differs->identical, 14u) << bit;
            ASSERT_TRUE(differs->first) << bit;
            const size_t pixel = bit / 8 / stride;
            EXPECT_EQ(uint2(differs->first->x, differs->first->y), uint2(pixel % 5, pixel / 5)) << bit;
            EXPECT_EQ(differs->first->a, pixelAt(a, pixel));
            EXPECT_GE(differs->maxDifference, 1u) << bit;
            EXPECT_EQ(differs->percentage(), "93.3333 %");
        }
    }
}

TEST(Comparison, OnePixelOfAMillionIsNotAHundredPercent) {
    const Image a = grey(1500, 1000, 7);
    Image b = a;
    b.pixels.back() = std::byte{ 8 };
    EXPECT_EQ(compareImages(a, b)->percentage(), "99.9999 %");
}

TEST(Comparison, RefusesPicturesThatAreNotAlike) {
    const Image a = grey(4, 4, 0);
    EXPECT_THAT(compareImages(a, grey(4, 5, 0)).error().message, HasSubstr("4x4 pixels of RGBA8 and 4x5"));
    EXPECT_THAT(compareImages(a, randomPicture(Format::RGBA16F, 4, 4, 1)).error().message, HasSubstr("RGBA16F"));
    Image cut = a;
    cut.pixels.pop_back();
    EXPECT_THAT(compareImages(a, cut).error().message, HasSubstr("63 bytes"));
    EXPECT_THAT(wiped(cut, a, {}).error().message, HasSubstr("63 bytes"));
    EXPECT_THAT(compareImages(Image{}, Image{}).error().message, HasSubstr("0x0"));
    cut.format = Format::R8;
    EXPECT_THAT(flipMap(cut, cut).error().message, HasSubstr("R8"));
    EXPECT_THAT(differenceMap(a, a, 0).error().message, HasSubstr("above 0"));
    EXPECT_THAT(differenceMap(a, a, std::numeric_limits<float>::infinity()).error().message, HasSubstr("above 0"));
    const Image ten = randomPicture(Format::RGB10A2, 4, 4, 1);
    EXPECT_THAT(flipMap(ten, ten).error().message, HasSubstr("8 bits"));
}

TEST(RmsError, IsTheRootOfTheMeanSquareOfThreeComponents) {
    for (const Format format : kFormats)
        EXPECT_EQ(*rmsError(randomPicture(format, 9, 5, 6), randomPicture(format, 9, 5, 6)), 0);
    EXPECT_NEAR(*rmsError(grey(7, 3, 51), grey(7, 3, 102)), 0.2, 1e-7);
    Image one = grey(4, 1, 0);
    one.pixels[4] = std::byte{ 255 }; // red of the second of four pixels
    one.pixels[3] = std::byte{ 255 }; // alpha is not looked at
    EXPECT_NEAR(*rmsError(grey(4, 1, 0), one), std::sqrt(1.0 / 12), 1e-7);
    EXPECT_FALSE(rmsError(grey(4, 1, 0), grey(1, 4, 0)));
}

TEST(DifferenceMap, IsTheAmplifiedDifferenceClamped) {
    for (int difference = 0; difference < 256; ++difference) {
        const Image a = grey(1, 1, 0), b = grey(1, 1, static_cast<uint8_t>(difference));
        for (auto const& [x, y] : { std::pair(&a, &b), std::pair(&b, &a) }) {
            const auto map = differenceMap(*x, *y, 4);
            ASSERT_TRUE(map.ok());
            for (size_t c = 0; c < 3; ++c)
                EXPECT_EQ(std::to_integer<int>(map->pixels[c]), std::min(255, 4 * difference)) << difference;
        }
    }
}

TEST(DifferenceMap, WhatIsNotANumberInOneOfTheTwoIsWhite) {
    Image a{ .width = 1, .height = 1, .format = Format::RGBA16F, .pixels = std::vector<std::byte>(8) };
    Image b = a;
    const uint16_t quietNan = 0x7E00, infinity = 0x7C00;
    std::memcpy(&a.pixels[0], &quietNan, 2);
    std::memcpy(&a.pixels[2], &infinity, 2);
    std::memcpy(&b.pixels[2], &infinity, 2);
    const auto map = differenceMap(a, b);
    ASSERT_TRUE(map.ok());
    EXPECT_EQ(pixelAt(*map, 0), (std::array<float, 4>{ 1, 0, 0, 1 }));
    EXPECT_EQ(pixelAt(*differenceMap(a, a), 0), (std::array<float, 4>{ 0, 0, 0, 1 }));
}

TEST(FlipMap, IsBlackForEqualPicturesAndBrightWhereTheyDiffer) {
    const Image a = grey(32, 32, 128);
    const auto same = flipMap(a, a);
    ASSERT_TRUE(same.ok());
    EXPECT_EQ(same->mean, 0);
    for (size_t i = 0; i < pixelCount(a); ++i) EXPECT_EQ(same->image.pixels[4 * i], std::byte{ 0 });
    Image b = a;
    for (size_t y = 12; y < 20; ++y)
        std::fill_n(b.pixels.begin() + static_cast<ptrdiff_t>(4 * (32 * y + 12)), 32, std::byte{ 255 });
    const auto differs = flipMap(a, b);
    ASSERT_TRUE(differs.ok());
    EXPECT_GT(differs->mean, 0);
    EXPECT_GT(pixelAt(differs->image, 16 * 32 + 16)[0], 0.5f);
    EXPECT_LT(pixelAt(differs->image, 0)[0], 0.2f);
}

TEST(ErrorColor, GrowsBrighterFromBlackToWhite) {
    const auto luminance = [](float error) {
        const auto rgb = errorColor(error);
        return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
    };
    EXPECT_EQ(errorColor(0), (std::array<uint8_t, 3>{ 0, 0, 0 }));
    EXPECT_EQ(errorColor(1), (std::array<uint8_t, 3>{ 255, 255, 255 }));
    EXPECT_EQ(errorColor(-1), errorColor(0));
    EXPECT_EQ(errorColor(std::nanf("")), errorColor(1));
    for (int i = 0; i < 100; ++i)
        EXPECT_LT(luminance(static_cast<float>(i) / 100), luminance(static_cast<float>(i + 1) / 100)) << i;
}

TEST(Wipe, EveryPixelIsOneOfTheTwoAtEveryPosition) {
    for (const Format format : kFormats) {
        const Image a = randomPicture(format, 9, 6, 3), b = randomPicture(format, 9, 6, 4);
        const size_t stride = a.pixels.size() / 54;
        for (const WipeAxis axis : { WipeAxis::Vertical, WipeAxis::Horizontal }) {
            const uint32_t side = axis == WipeAxis::Vertical ? 9 : 6;
            for (uint32_t line = 0; line <= side; ++line) {
                const Wipe wipe{ axis, static_cast<float>(line) / static_cast<float>(side) };
                ASSERT_EQ(wipePixel(wipe, { 9, 6 }), line);
                const auto picture = wiped(a, b, wipe);
                ASSERT_TRUE(picture.ok());
                for (uint32_t i = 0; i < 54; ++i) {
                    Image const& from = (axis == WipeAxis::Vertical ? i % 9 : i / 9) < line ? a : b;
                    EXPECT_EQ(std::memcmp(&picture->pixels[i * stride], &from.pixels[i * stride], stride), 0);
                }
            }
        }
    }
}

TEST(Wipe, PositionsOutsideAreClamped) {
    const uint2 size(10, 4);
    EXPECT_EQ(wipePixel({ .position = -1 }, size), 0u);
    EXPECT_EQ(wipePixel({ .position = 2 }, size), 10u);
    EXPECT_EQ(wipePixel({ .position = std::nanf("") }, size), 0u);
    EXPECT_EQ(wipePixel({ WipeAxis::Horizontal, 0.5f }, size), 2u);
}

TEST(Split, TheTwoRectanglesCoverTheTargetOnce) {
    const uint2 size(7, 5);
    for (const WipeAxis axis : { WipeAxis::Vertical, WipeAxis::Horizontal }) {
        for (int step = 0; step <= 20; ++step) {
            const SplitRects rects = splitRects({ axis, static_cast<float>(step) / 20 }, size);
            std::vector<int> covered(35);
            for (auto const& rect : { rects.a, rects.b }) {
                if (!rect) continue;
                EXPECT_GT(rect->size.x * rect->size.y, 0u);
                for (uint32_t y = 0; y < rect->size.y; ++y) {
                    for (uint32_t x = 0; x < rect->size.x; ++x)
                        ++covered.at((rect->offset.y + y) * 7 + rect->offset.x + x);
                }
            }
            EXPECT_THAT(covered, ::testing::Each(1)) << step;
        }
    }
    EXPECT_FALSE(splitRects({}, { 0, 4 }).b);
}

} // namespace
} // namespace filament_core::view
