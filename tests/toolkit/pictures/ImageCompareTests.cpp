// SPDX-License-Identifier: Apache-2.0
#include "base/math/Half.h"
#include "toolkit/pictures/ImageCompare.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>

namespace filament_core::tools {
namespace {

Image grey8(uint32_t width, uint32_t height, uint8_t value) {
    Image image{ .width = width, .height = height };
    image.pixels.assign(size_t(width) * height * 4, std::byte{ value });
    return image;
}

Image half16(std::initializer_list<float> components) {
    Image image{ .width = static_cast<uint32_t>(components.size() / 4), .height = 1, .format = Format::RGBA16F };
    for (const float value : components) {
        const uint16_t bits = std::isnan(value) ? uint16_t{ 0x7e00 } : halfFromFloat(value);
        const auto* bytes = reinterpret_cast<const std::byte*>(&bits);
        image.pixels.insert(image.pixels.end(), bytes, bytes + 2);
    }
    return image;
}

std::array<int, 3> rgbAt(Image const& image, size_t pixel) {
    const auto at = [&](size_t c) { return std::to_integer<int>(image.pixels[pixel * 4 + c]); };
    return { at(0), at(1), at(2) };
}

TEST(ImageCompare, AnImageIsIdenticalToItself) {
    const Image image = grey8(7, 3, 200);
    const auto comparison = compareImages(image, image);
    ASSERT_TRUE(comparison.ok());
    EXPECT_EQ(comparison->line(), "identical: 100.0000 % of pixels, max difference 0/255");
    EXPECT_TRUE(comparison->within(0));
}

TEST(ImageCompare, OneWrongPixelInAMillionIsNotOneHundredPercent) {
    const Image a = grey8(4000, 1000, 10);
    Image b = a;
    b.pixels[123] = std::byte{ 13 };
    const auto comparison = compareImages(a, b);
    ASSERT_TRUE(comparison.ok());
    EXPECT_EQ(comparison->identical, 3'999'999u);
    EXPECT_EQ(comparison->line(), "identical: 99.9999 % of pixels, max difference 3/255");
    EXPECT_FALSE(comparison->within(2));
    EXPECT_TRUE(comparison->within(3));
}

TEST(ImageCompare, TheLargestDifferenceIsTakenOverAllComponentsInBothDirections) {
    Image a = grey8(2, 1, 100), b = grey8(2, 1, 100);
    b.pixels[2] = std::byte{ 90 };
    b.pixels[7] = std::byte{ 140 }; // alpha counts
    const auto comparison = compareImages(a, b);
    ASSERT_TRUE(comparison.ok());
    EXPECT_EQ(comparison->identical, 0u);
    EXPECT_EQ(comparison->maxDifference, 40u);
}

TEST(ImageCompare, HalfFloatsThatDifferByOneBitAreNotIdentical) {
    const Image a = half16({ 0.5f, 0.5f, 0.5f, 1 });
    Image b = a;
    b.pixels[0] ^= std::byte{ 1 };
    const auto comparison = compareImages(a, b);
    ASSERT_TRUE(comparison.ok());
    EXPECT_EQ(comparison->identical, 0u);
    EXPECT_EQ(comparison->maxDifference, 1u); // rounded up
}

TEST(ImageCompare, TenBitsAreComparedByTheirChannels) {
    const auto pixel = [](uint32_t red, uint32_t blue) {
        const std::array words{ red | blue << 20 | 3u << 30 };
        const auto bytes = std::as_bytes(std::span(words));
        return Image{ .width = 1, .height = 1, .format = Format::RGB10A2, .pixels = { bytes.begin(), bytes.end() } };
    };
    const auto difference = [&](Image const& a, Image const& b) { return compareImages(a, b)->maxDifference; };
    EXPECT_EQ(difference(pixel(500, 7), pixel(500, 7)), 0u);
    EXPECT_EQ(difference(pixel(500, 7), pixel(501, 7)), 1u); // rounded up
    EXPECT_EQ(difference(pixel(500, 0), pixel(500, 1023)), 255u);
    EXPECT_EQ(rgbAt(differenceImage(pixel(1023, 512), pixel(1023, 512)), 0), (std::array{ 63, 0, 32 }));
}

TEST(ImageCompare, NotANumberIsAsFarAsItGets) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const auto comparison = compareImages(half16({ nan, 0, 0, 1 }), half16({ 0, 0, 0, 1 }));
    ASSERT_TRUE(comparison.ok());
    EXPECT_EQ(comparison->maxDifference, 255u);
}

TEST(ImageCompare, SizesFormatsAndByteCountsMustFit) {
    EXPECT_EQ(compareImages(grey8(2, 2, 0), grey8(4, 1, 0)).error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(compareImages(grey8(1, 1, 0), half16({ 0, 0, 0, 0 })).error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(compareImages(grey8(0, 0, 0), grey8(0, 0, 0)).error().code, ErrorCode::InvalidArgument);
    Image shortened = grey8(2, 2, 0);
    shortened.pixels.pop_back();
    EXPECT_EQ(compareImages(shortened, grey8(2, 2, 0)).error().code, ErrorCode::InvalidArgument);
}

TEST(ImageCompare, TheDifferencePictureDimsWhatAgreesAndReddensWithTheDistance) {
    const Image a = grey8(3, 1, 200);
    Image b = a;
    b.pixels[4] = std::byte{ 201 }; // pixel 1: one step
    b.pixels[8] = std::byte{ 100 }; // pixel 2: far
    const Image picture = differenceImage(a, b);
    EXPECT_EQ(rgbAt(picture, 0), (std::array{ 50, 50, 50 }));
    EXPECT_EQ(rgbAt(picture, 1), (std::array{ 255, 240, 0 }));
    EXPECT_EQ(rgbAt(picture, 2), (std::array{ 255, 0, 0 }));
}

} // namespace
} // namespace filament_core::tools
