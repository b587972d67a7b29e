// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/MipMaps.h"

#include "base/math/Half.h"
#include "base/math/Math.h"
#include "filament_core/assets/image/ChannelTransfer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>
#include <span>

namespace filament_core::assets::test {
namespace {

using backend::Format;

Image imageOf(uint32_t width, uint32_t height, std::vector<uint8_t> const& pixels) {
    Image image{ .width = width, .height = height, .data = std::vector<std::byte>(pixels.size()) };
    std::memcpy(image.data.data(), pixels.data(), pixels.size());
    return image;
}

Image noise(uint32_t width, uint32_t height) {
    std::mt19937 random(width * 1000 + height);
    std::vector<uint8_t> pixels(size_t{ width } * height * 4);
    for (uint8_t& value : pixels) value = static_cast<uint8_t>(random());
    return imageOf(width, height, pixels);
}

uint8_t texel(Image const& image, uint32_t level, size_t component) {
    return static_cast<uint8_t>(image.data[image.levelOffset(level) + component]);
}

double linearFromSrgb(double code) { return code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4); }
double srgbFromLinear(double v) { return v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055; }

/// The mean over the part of `image` level 0 that texel (x, y) of `level` covers, integrated exactly in double. Only
/// for levels whose chain never rounds an odd size down: level 1 of any size, all levels of powers of two.
double expectedCode(Image const& base, bool isColor, uint32_t width, uint32_t height, uint32_t x, uint32_t y,
                    uint32_t c) {
    const bool isSrgb = isColor && c < 3;
    const double sx = double(base.width) / width, sy = double(base.height) / height;
    double sum = 0;
    for (uint32_t v = 0; v < base.height; ++v) {
        const double coverY = std::min(v + 1.0, (y + 1) * sy) - std::max(double(v), y * sy);
        if (coverY <= 0) continue;
        for (uint32_t u = 0; u < base.width; ++u) {
            const double coverX = std::min(u + 1.0, (x + 1) * sx) - std::max(double(u), x * sx);
            if (coverX <= 0) continue;
            const double code = static_cast<uint8_t>(base.data[(size_t{ v } * base.width + u) * 4 + c]) / 255.0;
            sum += coverX * coverY * (isSrgb ? linearFromSrgb(code) : code);
        }
    }
    const double mean = sum / (sx * sy);
    return 255 * (isSrgb ? srgbFromLinear(mean) : mean);
}

void expectLevel(Image const& base, Image const& mips, uint32_t level, bool isColor) {
    const uint32_t width = std::max(1u, base.width >> level), height = std::max(1u, base.height >> level);
    double worst = 0;
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            for (uint32_t c = 0; c < 4; ++c) {
                const double actual = texel(mips, level, (size_t{ y } * width + x) * 4 + c);
                worst = std::max(worst, std::abs(actual - expectedCode(base, isColor, width, height, x, y, c)));
            }
        }
    }
    EXPECT_LE(worst, 0.53) << base.width << "x" << base.height << " level " << level; // rounding, and 16-bit steps
}

TEST(MipMaps, LevelOneIsTheExactAreaMeanForEvenAndOddSizes) {
    for (const auto& [width, height] :
         { std::pair{ 8u, 4u }, { 7u, 5u }, { 6u, 9u }, { 1u, 7u }, { 13u, 1u }, { 2u, 2u }, { 3u, 3u } }) {
        for (const bool isColor : { true, false }) {
            const Image base = noise(width, height);
            expectLevel(base, withMipMaps(base, isColor), 1, isColor);
        }
    }
}

TEST(MipMaps, RoundingDoesNotAddUpDownTheChain) {
    for (const bool isColor : { true, false }) {
        const Image base = noise(64, 64);
        const Image mips = withMipMaps(base, isColor);
        ASSERT_EQ(mips.levels, 7u);
        for (uint32_t level = 1; level < 7; ++level) expectLevel(base, mips, level, isColor);
    }
}

TEST(MipMaps, LevelZeroIsUntouchedAndTheFormatTellsTheUse) {
    const Image base = noise(5, 3);
    const Image color = withMipMaps(base, true), data = withMipMaps(base, false);
    EXPECT_EQ(std::memcmp(color.data.data(), base.data.data(), base.data.size()), 0);
    EXPECT_EQ(color.format, Format::RGBA8Srgb);
    EXPECT_EQ(data.format, Format::RGBA8);
    EXPECT_EQ(color.levels, 3u); // 5x3, 2x1, 1x1
    EXPECT_EQ(color.data.size(), (15 + 2 + 1) * 4u);
}

TEST(MipMaps, UniformImagesStayUniformForEveryCode) {
    for (uint32_t code = 0; code < 256; ++code) {
        for (const bool isColor : { true, false }) {
            const Image mips =
                    withMipMaps(imageOf(7, 6, std::vector<uint8_t>(7 * 6 * 4, static_cast<uint8_t>(code))), isColor);
            for (const std::byte value : mips.data) ASSERT_EQ(static_cast<uint32_t>(value), code);
        }
    }
}

TEST(MipMaps, HalfBlackHalfWhiteIsHalfTheLight) {
    const Image base = imageOf(2, 1, { 0, 0, 0, 0, 255, 255, 255, 255 });
    const Image color = withMipMaps(base, true);
    EXPECT_EQ(texel(color, 1, 0), 188); // 255 * srgbFromLinear(0.5)
    EXPECT_EQ(texel(color, 1, 3), 128); // alpha is a plain number
    EXPECT_EQ(texel(withMipMaps(base, false), 1, 0), 128);
}

TEST(MipMaps, TheSizeLimitDropsTheLargestLevels) {
    const Image base = noise(32, 8);
    const Image whole = withMipMaps(base, true), limited = withMipMaps(base, true, 9);
    EXPECT_EQ(limited.width, 8u);
    EXPECT_EQ(limited.height, 2u);
    EXPECT_EQ(limited.levels, whole.levels - 2);
    const auto tail = std::span(whole.data).subspan(whole.levelOffset(2));
    ASSERT_EQ(limited.data.size(), tail.size());
    EXPECT_EQ(std::memcmp(limited.data.data(), tail.data(), tail.size()), 0);
}

TEST(MipMaps, EachLayerHasTheChainThatItWouldHaveAlone) {
    for (const auto& [width, height] : { std::pair{ 8u, 8u }, { 5u, 3u }, { 1u, 1u } }) {
        const Image a = noise(width, height), b = noise(height, width);
        Image both{ .width = width, .height = height, .layers = 2, .data = a.data };
        both.data.insert(both.data.end(), b.data.begin(), b.data.end());
        const Image mips = withMipMaps(both, true);
        const Image first = withMipMaps(a, true),
                    second = withMipMaps({ .width = width, .height = height, .data = b.data }, true);
        ASSERT_EQ(mips.levels, first.levels);
        for (uint32_t level = 0; level < mips.levels; ++level) {
            const size_t bytes = first.levelBytes(level);
            const std::byte* at = mips.data.data() + mips.levelOffset(level);
            ASSERT_EQ(mips.levelBytes(level), 2 * bytes);
            EXPECT_EQ(std::memcmp(at, first.data.data() + first.levelOffset(level), bytes), 0) << level;
            EXPECT_EQ(std::memcmp(at + bytes, second.data.data() + second.levelOffset(level), bytes), 0) << level;
        }
    }
}

// The C library's variants of pow() for processors with and without FMA differ in the last bits of doubles (about 1e-16
// of the value, 1e-11 here). The table has the same entries everywhere, because none is that close to a rounding
// boundary.
TEST(ChannelTransfer, NoEntryOfSrgbDependsOnTheLastBitsOfPow) {
    for (int code = 0; code < 256; ++code) {
        const long double unit = code / 255.0L;
        const long double light = 65535 * (unit <= 0.04045L ? unit / 12.92L : std::pow((unit + 0.055L) / 1.055L, 2.4L));
        EXPECT_EQ(colorTransfer().linearFromCode[static_cast<size_t>(code)], std::lround(light)) << code;
        EXPECT_GT(std::abs(light - std::floor(light) - 0.5L), 1e-6L) << code;
    }
}

TEST(MipMaps, OneTexelIsItsOwnChain) {
    const Image mips = withMipMaps(noise(1, 1), true);
    EXPECT_EQ(mips.levels, 1u);
    EXPECT_EQ(mips.data.size(), 4u);
}

float halfAt(Image const& image, uint32_t level, size_t number) {
    uint16_t half = 0;
    std::memcpy(&half, &image.data[image.levelOffset(level) + 2 * number], sizeof(half));
    return floatFromHalf(half);
}

/// Noise of 16 bits whose high bytes are equal: with 8 bits it would be one code.
DeepImage deepNoise(uint32_t width, uint32_t height) {
    std::mt19937 random(width * 1000 + height);
    DeepImage image{ .width = width, .height = height, .codes = {} };
    for (size_t i = 0; i < size_t{ 4 } * width * height; ++i)
        image.codes.push_back(static_cast<uint16_t>(0x8000 + random() % 256));
    return image;
}

// The means of a level, in double: of light where the codes are colours.
TEST(MipMaps, DeepPicturesKeepTheirBitsInEveryLevel) {
    for (const auto& [width, height] : { std::pair(8u, 4u), { 7u, 5u }, { 1u, 3u } }) {
        const DeepImage base = deepNoise(width, height);
        for (const bool isColor : { false, true }) {
            const Image image = withMipMaps(base, isColor);
            EXPECT_EQ(image.format, Format::RGBA16F);
            ASSERT_EQ(image.levels, backend::fullMipCount(width, height));
            const auto exact = [&](size_t i) {
                const double share = base.codes[i] / 65535.0;
                return isColor && i % 4 < 3 ? linearFromSrgb(share) : share;
            };
            for (size_t i = 0; i < base.codes.size(); ++i)
                EXPECT_NEAR(halfAt(image, 0, i), exact(i), exact(i) / 2048) << "half a step of a half";
            for (size_t c = 0; c < 4; ++c) { // the smallest level of an image of even sizes is the mean of all
                if (width != 8) break;
                double sum = 0;
                for (size_t i = c; i < base.codes.size(); i += 4) sum += exact(i);
                EXPECT_NEAR(halfAt(image, image.levels - 1, c), sum / 32, 2.5e-4) << c;
            }
        }
    }
}

TEST(MipMaps, DeepPicturesStartWithTheFirstLevelThatIsSmallEnough) {
    const DeepImage base = deepNoise(16, 8);
    const Image whole = withMipMaps(base, true), part = withMipMaps(base, true, 4);
    EXPECT_EQ(uint2(part.width, part.height), uint2(4, 2));
    EXPECT_TRUE(std::equal(part.data.begin(), part.data.end(),
                           whole.data.begin() + static_cast<std::ptrdiff_t>(whole.levelOffset(2)), whole.data.end()));
}

} // namespace
} // namespace filament_core::assets::test
