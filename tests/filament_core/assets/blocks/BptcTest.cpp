// SPDX-License-Identifier: Apache-2.0
// BC6 and BC7. The partitions are checked against devices (tests/backend/create/BlockDecodingTest.cpp); here a second,
// slow reading of the mode tables writes blocks of every mode whose colours are known.
#include "base/math/Half.h"
#include "tests/filament_core/assets/blocks/BlockWriter.h"

#include <gmock/gmock.h>

namespace filament_core::assets {
namespace {

using blocks::Texel8;
using blocks::TexelHalf;
using test::BlockWriter;

/// Microsoft's table of BC7 modes: subsets, partition bits, colour and alpha bits, and whether there are lowest bits
/// for each end, or for each subset.
struct Bc7Row {
    uint32_t subsets, partition, color, alpha;
    bool hasLowOfEnds, hasLowOfSubsets;
};
constexpr std::array<Bc7Row, 8> kBc7Rows{ { { 3, 4, 4, 0, true, false },
                                            { 2, 6, 6, 0, false, true },
                                            { 3, 6, 5, 0, false, false },
                                            { 2, 6, 7, 0, true, false },
                                            { 1, 0, 5, 6, false, false },
                                            { 1, 0, 7, 8, false, false },
                                            { 1, 0, 7, 7, true, false },
                                            { 2, 6, 5, 5, true, false } } };

/// A block whose ends are all the same colour, so that partition and indices do not matter.
BlockWriter solidBc7(uint32_t mode, uint32_t rotation, std::array<uint32_t, 4> const& color, std::mt19937& random) {
    Bc7Row const& row = kBc7Rows[mode];
    BlockWriter block;
    block.put(1u << mode, mode + 1).put(random(), row.partition);
    if (mode == 4) block.put(rotation, 2).put(random(), 1);
    if (mode == 5) block.put(rotation, 2);
    const bool hasLow = row.hasLowOfEnds || row.hasLowOfSubsets;
    for (uint32_t c = 0; c < 4; ++c) {
        for (uint32_t e = 0; e < 2 * row.subsets; ++e)
            block.put(hasLow ? color[c] >> 1 : color[c], c < 3 ? row.color : row.alpha);
    }
    const uint32_t lows = row.hasLowOfEnds ? 2 * row.subsets : row.hasLowOfSubsets ? row.subsets : 0;
    for (uint32_t i = 0; i < lows; ++i) block.put(color[0] & 1, 1);
    while (block.at < 128) block.put(random(), 1);
    return block;
}

uint8_t widened(uint32_t value, uint32_t bits) { // the highest bits again below: within half a step of value / most
    return static_cast<uint8_t>(value << (8 - bits) | value >> (2 * bits - 8));
}

TEST(Bc7, BlocksOfOneColourInEveryModeHaveThatColour) {
    std::mt19937 random(1);
    for (uint32_t mode = 0; mode < 8; ++mode) {
        for (uint32_t turn = 0; turn < 64; ++turn) {
            Bc7Row const& row = kBc7Rows[mode];
            const bool hasLow = row.hasLowOfEnds || row.hasLowOfSubsets;
            const uint32_t colorBits = row.color + hasLow, alphaBits = row.alpha + hasLow,
                           low = static_cast<uint32_t>(random() & 1);
            std::array<uint32_t, 4> color;
            for (uint32_t c = 0; c < 4; ++c) {
                color[c] = static_cast<uint32_t>(random()) & ((1u << (c < 3 ? colorBits : alphaBits)) - 1);
                if (hasLow) color[c] = (color[c] & ~1u) | low;
            }
            const uint32_t rotation = mode == 4 || mode == 5 ? turn % 4 : 0;
            Texel8 expected{ widened(color[0], colorBits), widened(color[1], colorBits), widened(color[2], colorBits),
                             row.alpha ? widened(color[3], alphaBits) : uint8_t{ 255 } };
            if (rotation == 1) std::swap(expected.r, expected.a);
            if (rotation == 2) std::swap(expected.g, expected.a);
            if (rotation == 3) std::swap(expected.b, expected.a);
            const auto texels = test::decodedBlock(BlockKind::Bc7, solidBc7(mode, rotation, color, random).bytes);
            EXPECT_THAT(texels, testing::Each(expected)) << "mode " << mode;
        }
    }
}

TEST(Bc7, IndicesStepThroughTheWeightsOfTheSpecification) {
    // mode 6: 4 bits an index; black to white
    BlockWriter block;
    block.put(1u << 6, 7);
    for (int c = 0; c < 4; ++c) block.put(0, 7).put(127, 7);
    block.put(0, 1).put(1, 1); // lowest bits
    block.put(0, 3);
    for (uint32_t i = 1; i < 16; ++i) block.put(i, 4);
    const auto texels = test::decodedBlock(BlockKind::Bc7, block.bytes);
    constexpr std::array<int, 16> kWeights{ 0, 4, 9, 13, 17, 21, 26, 30, 34, 38, 43, 47, 51, 55, 60, 64 };
    for (size_t i = 0; i < 16; ++i) EXPECT_EQ(texels[i].g, (255 * kWeights[i] + 32) / 64) << i;
}

TEST(Bc7, Mode4ReadsColoursWithTheOtherIndicesIfItsBitSaysSo) {
    for (const bool isSwapped : { false, true }) {
        BlockWriter block;
        block.put(1u << 4, 5).put(0, 2).put(isSwapped, 1);
        for (int c = 0; c < 3; ++c) block.put(0, 5).put(31, 5);
        block.put(0, 6).put(63, 6);
        block.put(1, 1); // of two bits: weight 21
        for (int i = 1; i < 16; ++i) block.put(1, 2);
        block.put(1, 2); // of three bits: weight 9
        for (int i = 1; i < 16; ++i) block.put(1, 3);
        const uint8_t ofTwo = (255 * 21 + 32) / 64, ofThree = (255 * 9 + 32) / 64;
        const Texel8 expected =
                isSwapped ? Texel8{ ofThree, ofThree, ofThree, ofTwo } : Texel8{ ofTwo, ofTwo, ofTwo, ofThree };
        EXPECT_THAT(test::decodedBlock(BlockKind::Bc7, block.bytes), testing::Each(expected));
    }
}

TEST(Bc7, AReservedModeIsTransparentBlack) {
    std::mt19937 random(2);
    auto block = test::randomBlock(random);
    block[0] = std::byte{ 0 };
    EXPECT_THAT(test::decodedBlock(BlockKind::Bc7, block), testing::Each(Texel8{ 0, 0, 0, 0 }));
}

TEST(Bc6, Mode11HasTheHalvesOfItsTenBits) {
    for (const uint32_t code : { 0u, 1u, 2u, 300u, 511u, 512u, 1022u, 1023u }) {
        BlockWriter block;
        block.put(0b00011, 5);
        for (int end = 0; end < 2; ++end) block.put(code, 10).put(1023 - code, 10).put(code, 10);
        const uint32_t wide = code == 0 ? 0 : code == 1023 ? 0xFFFF : (code << 16 | 0x8000) >> 10;
        const uint32_t other = code == 1023 ? 0 : code == 0 ? 0xFFFF : ((1023 - code) << 16 | 0x8000) >> 10;
        const TexelHalf expected{ static_cast<uint16_t>(wide * 31 / 64), static_cast<uint16_t>(other * 31 / 64),
                                  static_cast<uint16_t>(wide * 31 / 64), 0x3C00 };
        EXPECT_THAT(test::decodedBlock<TexelHalf>(BlockKind::Bc6, block.bytes), testing::Each(expected)) << code;
    }
}

TEST(Bc6, SignedColoursAreSymmetric) {
    for (const int code : { 0, 1, 200, 510, 511 }) {
        std::array<TexelHalf, 2> seen;
        for (const int sign : { 1, -1 }) {
            BlockWriter block;
            block.put(0b00011, 5);
            for (int i = 0; i < 6; ++i) block.put(static_cast<uint32_t>(sign * code) & 1023, 10);
            seen[sign < 0] = test::decodedBlock<TexelHalf>(BlockKind::Bc6Signed, block.bytes)[5];
        }
        EXPECT_EQ(floatFromHalf(seen[0].r), -floatFromHalf(seen[1].r)) << code;
        EXPECT_EQ(floatFromHalf(seen[0].r) == 0, code == 0);
        EXPECT_EQ(seen[0].r == 0x7BFF, code == 511) << "the largest half, as 31/32 of infinity";
    }
}

TEST(Bc6, DifferencesOfZeroRepeatTheFirstColour) {
    // mode 14: 16 bits and differences of 4; the upper six bits follow the difference, the highest one first
    BlockWriter block;
    const uint32_t color = 0xABCD;
    block.put(0b01111, 5).put(color & 1023, 10).put(color & 1023, 10).put(color & 1023, 10);
    for (int c = 0; c < 3; ++c) {
        block.put(0, 4);
        for (uint32_t bit = 16; bit-- > 10;) block.put(color >> bit, 1);
    }
    const auto half = static_cast<uint16_t>(color * 31 / 64);
    EXPECT_THAT(test::decodedBlock<TexelHalf>(BlockKind::Bc6, block.bytes),
                testing::Each(TexelHalf{ half, half, half, 0x3C00 }));
}

TEST(Bc6, ReservedModesAreBlack) {
    std::mt19937 random(3);
    for (const uint32_t mode : { 0b10011u, 0b10111u, 0b11011u, 0b11111u }) {
        auto block = test::randomBlock(random);
        block[0] = static_cast<std::byte>((std::to_integer<uint32_t>(block[0]) & ~31u) | mode);
        for (const BlockKind kind : { BlockKind::Bc6, BlockKind::Bc6Signed })
            EXPECT_THAT(test::decodedBlock<TexelHalf>(kind, block), testing::Each(TexelHalf{ 0, 0, 0, 0x3C00 }));
    }
}

TEST(Bc6, NoBlockHasANumberThatIsNotFinite) {
    std::mt19937 random(4);
    for (int turn = 0; turn < 20000; ++turn) {
        const auto block = test::randomBlock(random);
        for (const BlockKind kind : { BlockKind::Bc6, BlockKind::Bc6Signed }) {
            for (TexelHalf const& texel : test::decodedBlock<TexelHalf>(kind, block))
                ASSERT_TRUE((texel.r & 0x7C00) != 0x7C00 && (texel.g & 0x7C00) != 0x7C00 &&
                            (texel.b & 0x7C00) != 0x7C00);
        }
    }
}

} // namespace
} // namespace filament_core::assets
