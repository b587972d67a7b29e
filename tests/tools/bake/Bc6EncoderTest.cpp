// SPDX-License-Identifier: Apache-2.0
// Blocks of BC6H and BC4, read by the decoder that reads them in models.
#include "tools/bake/Bc6Encoder.h"

#include "base/math/Half.h"
#include "filament_core/assets/blocks/BlockDecoder.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <random>

namespace filament_core::bake {
namespace {

using assets::BlockKind;
using Halves = std::vector<std::byte>;

void put(Halves& halves, std::array<float, 3> color) {
    for (const float value : { color[0], color[1], color[2], 1.0f }) {
        const uint16_t code = halfFromFloat(value);
        const auto bytes = std::as_bytes(std::span(&code, 1));
        halves.insert(halves.end(), bytes.begin(), bytes.end());
    }
}

float channel(Halves const& halves, size_t texel, size_t c) {
    uint16_t code;
    std::memcpy(&code, &halves[texel * 8 + c * 2], sizeof(code));
    return floatFromHalf(code);
}

Halves decoded(std::span<const std::byte> blocks, uint32_t width, uint32_t height) {
    Halves halves(size_t(width) * height * 8);
    assets::decodeBlocks({ BlockKind::Bc6 }, false, blocks, width, height, halves);
    return halves;
}

/// Root mean square of the errors of channels, each over the mean of its texel.
double relativeError(Halves const& given, Halves const& stored) {
    double squares = 0, count = 0;
    for (size_t i = 0; i < given.size() / 8; ++i) {
        const double mean = (double(channel(given, i, 0)) + channel(given, i, 1) + channel(given, i, 2)) / 3;
        for (size_t c = 0; c < 3; ++c) {
            const double off = (double(channel(stored, i, c)) - channel(given, i, c)) / mean;
            squares += off * off, ++count;
        }
    }
    return std::sqrt(squares / count);
}

TEST(Bc6Encoder, ABlockOfOneColourIsOffByLessThanAStepOfNineBits) {
    std::minstd_rand random(3);
    std::uniform_real_distribution<float> exponent(-12, 13);
    for (int i = 0; i < 300; ++i) {
        const std::array color{ std::exp2(exponent(random)), std::exp2(exponent(random)), std::exp2(exponent(random)) };
        Halves given;
        for (int t = 0; t < 16; ++t) put(given, color);
        const Halves stored = decoded(encodeBc6(given, 4, 4), 4, 4);
        for (size_t t = 0; t < 16; ++t) {
            for (size_t c = 0; c < 3; ++c) EXPECT_NEAR(channel(stored, t, c) / color[c], 1, 1.0 / 512);
        }
    }
}

// A line has 16 places: even errors of a fifteenth of the range of a block have a root mean square of that over
// sqrt(12); the ends are off by 2^-9 of their light.
TEST(Bc6Encoder, SmoothLightIsOffByAPartOfTheRangeOfItsBlocks) {
    constexpr uint32_t kSide = 64;
    const double range = std::exp(3 * 0.02 + 3 * 0.1) - 1; // of three texels in x and y
    Halves given;
    for (uint32_t y = 0; y < kSide; ++y) {
        for (uint32_t x = 0; x < kSide; ++x) {
            const float light = std::exp(0.02f * float(x) + 0.1f * float(y));
            put(given, { light, 0.8f * light, 0.5f * light });
        }
    }
    const std::vector<std::byte> blocks = encodeBc6(given, kSide, kSide);
    EXPECT_EQ(blocks.size(), kSide * kSide);
    EXPECT_LT(relativeError(given, decoded(blocks, kSide, kSide)), range / 15 / std::sqrt(12.0) + 1.0 / 512);
}

// Edges of shadows, colours of two lights, and noise of one percent.
TEST(Bc6Encoder, EdgesAndNoiseAreOffByAFewPercent) {
    constexpr uint32_t kWidth = 61, kHeight = 42; // no multiples of a block
    std::minstd_rand random(5);
    std::normal_distribution<float> noise(1, 0.01f);
    Halves given;
    for (uint32_t y = 0; y < kHeight; ++y) {
        for (uint32_t x = 0; x < kWidth; ++x) {
            const float sun = x * 3 > y * 2 + 20 ? 4000.0f : 20.0f, lamp = 300 / (1 + 0.1f * float(y));
            put(given, { (sun + lamp) * noise(random), (0.9f * sun + 0.6f * lamp) * noise(random),
                         (0.8f * sun + 0.2f * lamp) * noise(random) });
        }
    }
    const Halves stored = decoded(encodeBc6(given, kWidth, kHeight), kWidth, kHeight);
    EXPECT_LT(relativeError(given, stored), 0.05);
    EXPECT_EQ(encodeBc6(given, kWidth, kHeight).size(), 16u * 11 * 16);
}

TEST(Bc6Encoder, AnyCodesGiveFiniteLight) {
    std::minstd_rand random(9);
    Halves given;
    for (int i = 0; i < 64 * 64 * 4; ++i) {
        const auto code = static_cast<uint16_t>(random() & 0x7FFF); // infinities and NaN among them
        const auto bytes = std::as_bytes(std::span(&code, 1));
        given.insert(given.end(), bytes.begin(), bytes.end());
    }
    const Halves stored = decoded(encodeBc6(given, 64, 64), 64, 64);
    for (size_t i = 0; i < 64 * 64; ++i) {
        for (size_t c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(channel(stored, i, c)));
    }
}

// Eight places between the least and the largest code of a block.
TEST(Bc4Encoder, ACodeIsOffByHalfOfASeventhOfTheRange) {
    std::minstd_rand random(2);
    for (int i = 0; i < 200; ++i) {
        std::vector<std::byte> given, stored(64);
        const int low = int(random() % 256), high = low + int(random() % uint32_t(256 - low));
        for (int t = 0; t < 16; ++t)
            given.push_back(static_cast<std::byte>(low + int(random() % uint32_t(high - low + 1))));
        assets::decodeBlocks({ BlockKind::Bc4 }, false, encodeBc4(given, 4, 4), 4, 4, stored);
        for (size_t t = 0; t < 16; ++t)
            EXPECT_NEAR(std::to_integer<int>(stored[4 * t]), std::to_integer<int>(given[t]),
                        (high - low) / 14.0 + 0.51);
    }
}

} // namespace
} // namespace filament_core::bake
