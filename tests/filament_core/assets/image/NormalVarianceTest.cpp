// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/NormalVariance.h"

#include "base/math/Half.h"
#include "base/math/Math.h"
#include "filament_core/assets/image/MipMaps.h"
#include "shaders/lib/LibCpp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <functional>
#include <random>

namespace filament_core::assets::test {
namespace {

using backend::Format;

using Slopes = std::function<double2(uint32_t x, uint32_t y)>;

/// A normal map with all levels, of a surface with these slopes.
Image normalMapOf(uint32_t width, uint32_t height, Slopes const& slopes) {
    Image image{ .width = width, .height = height, .data = {} };
    for (uint32_t y = 0; y < height; ++y) {
        for (uint32_t x = 0; x < width; ++x) {
            const double3 normal = glm::normalize(double3(slopes(x, y), 1));
            for (int c = 0; c < 3; ++c)
                image.data.push_back(static_cast<std::byte>(std::lround((normal[c] * 0.5 + 0.5) * 255)));
            image.data.push_back(std::byte{ 255 });
        }
    }
    return withMipMaps(std::move(image), false);
}

double2 even(uint32_t, uint32_t) { return double2(0.0); }

int widthAt(Image const& image, uint32_t level, size_t texel = 0) {
    return std::to_integer<int>(image.data[image.levelOffset(level) + texel * 4 + 3]);
}

double3 unitTexel(Image const& image, uint32_t x, uint32_t y) {
    std::byte const* codes = &image.data[(size_t{ y } * image.width + x) * 4];
    const auto number = [&](int c) { return std::to_integer<int>(codes[c]) / 127.5 - 1; };
    return glm::normalize(double3(number(0), number(1), number(2)));
}

TEST(NormalVariance, AnEvenMapHasNoneInAnyLevel) {
    for (const uint2 size : { uint2(1, 1), uint2(8, 8), uint2(7, 3), uint2(1, 16) }) {
        const Image image = withNormalVariance(normalMapOf(size.x, size.y, even));
        for (size_t i = 3; i < image.data.size(); i += 4)
            EXPECT_EQ(image.data[i], std::byte{ 0 }) << size.x << ' ' << i;
    }
}

TEST(NormalVariance, NormalsAreThoseOfThePlainMap) {
    const Image plain = normalMapOf(9, 6, [](uint32_t x, uint32_t y) { return double2(x % 3, y % 2); });
    const Image image = withNormalVariance(plain);
    ASSERT_EQ(image.data.size(), plain.data.size());
    for (size_t i = 0; i < plain.data.size(); ++i) {
        if (i % 4 != 3) {
            EXPECT_EQ(image.data[i], plain.data[i]) << i;
        }
    }
}

/// Every level, also those of odd sizes, holds the mean over the first level, not that of a rounded level.
TEST(NormalVariance, AreThoseOfTheMeanNormalOfTheFirstLevel) {
    std::mt19937 random(7);
    const auto rough = [&](uint32_t, uint32_t) {
        return double2(std::uniform_real_distribution(-0.7, 0.7)(random),
                       std::uniform_real_distribution(-0.2, 0.2)(random));
    };
    for (const uint2 size : { uint2(16, 16), uint2(8, 32), uint2(7, 5), uint2(13, 1) }) {
        const Image image = withNormalVariance(normalMapOf(size.x, size.y, rough));
        double3 sum(0.0);
        for (uint32_t y = 0; y < size.y; ++y)
            for (uint32_t x = 0; x < size.x; ++x) sum += unitTexel(image, x, y);
        const double length = glm::length(sum) / (size.x * size.y);
        const float expected = shader::lib::normalWidth(static_cast<float>(length));
        EXPECT_NEAR(widthAt(image, image.levels - 1), expected * 255, 0.5001) << size.x << " x " << size.y;
        EXPECT_EQ(widthAt(image, 0), 0);
        EXPECT_GT(widthAt(image, 1), 10);
    }
}

/// Slopes of +s and -s have the variance s^2 along one axis. A lobe has alpha^2 / 2 along each of two.
TEST(NormalVariance, SmallSlopesGiveALobeOfTheirVariance) {
    for (const double slope : { 0.05, 0.1, 0.2 }) {
        const Image image = withNormalVariance(
                normalMapOf(2, 2, [&](uint32_t x, uint32_t) { return double2(x ? slope : -slope, 0); }));
        EXPECT_NEAR(widthAt(image, 1), 255 * slope, 2.0 + 255 * slope * slope);
    }
}

TEST(NormalVariance, NormalsThatCancelOutAndThatAreNoneAreKnown) {
    Image opposed = normalMapOf(2, 1, even);
    const auto set = [&](size_t texel, uint8_t red, uint8_t green, uint8_t blue) {
        const std::array<uint8_t, 3> codes{ red, green, blue };
        std::memcpy(&opposed.data[texel * 4], codes.data(), 3);
    };
    set(0, 255, 128, 128), set(1, 0, 127, 127);
    EXPECT_EQ(widthAt(withNormalVariance(opposed), 1), 255);
    set(0, 128, 128, 128), set(1, 128, 128, 255);          // no normal counts as +z, as in normalFromTexel()
    EXPECT_LE(widthAt(withNormalVariance(opposed), 1), 1); // 128 is not quite 0
}

TEST(NormalVariance, DroppedLevelsCount) {
    const Slopes waves = [](uint32_t x, uint32_t y) { return double2(x % 2 ? 0.5 : -0.5, (y / 4) % 2 ? 0.3 : -0.3); };
    const Image whole = withNormalVariance(normalMapOf(16, 16, waves));
    const Image part = withNormalVariance(normalMapOf(16, 16, waves), 4);
    ASSERT_EQ(part.levels, 3u);
    const std::span rest = std::span(whole.data).subspan(whole.levelOffset(2));
    EXPECT_TRUE(std::ranges::equal(part.data, rest));
    EXPECT_GT(widthAt(part, 0), 50);
}

TEST(NormalVariance, DeepMapsHoldThemInHalves) {
    DeepImage deep{ .width = 2, .height = 1 };
    deep.codes = { 65535, 32768, 65535, 65535, 0, 32768, 65535, 65535 }; // (1, 0, 1) and (-1, 0, 1)
    const Image image = withNormalVariance(withMipMaps(deep, false));
    ASSERT_EQ(image.format, Format::RGBA16F);
    const auto alpha = [&](size_t texel) {
        uint16_t half = 0;
        std::memcpy(&half, &image.data[texel * 8 + 6], 2);
        return floatFromHalf(half);
    };
    EXPECT_EQ(alpha(0), 0);
    EXPECT_EQ(alpha(1), 0);
    EXPECT_NEAR(alpha(2), shader::lib::normalWidth(std::sqrt(0.5f)), 1e-3);
}

} // namespace
} // namespace filament_core::assets::test
