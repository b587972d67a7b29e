// SPDX-License-Identifier: Apache-2.0
// ASTC: every range of numbers, every end mode, and blocks that are errors. Random blocks of every size are compared
// with a device in tests/backend/gles/BlockSamplingTest.cpp.
#include "filament_core/assets/blocks/AstcColors.h"
#include "filament_core/assets/blocks/AstcPartition.h"
#include "filament_core/assets/blocks/AstcQuantization.h"
#include "tests/filament_core/assets/blocks/BlockWriter.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

namespace filament_core::assets {
namespace {

using blocks::AstcRange;
using blocks::kAstcRanges;
using blocks::Texel8;
using test::BlockWriter;
using testing::Each;

constexpr Texel8 kMagenta{ 255, 0, 255, 255 };

uint32_t levelsOf(AstcRange range) { return (range.trits ? 3u : range.quints ? 5u : 1u) << range.bits; }

TEST(AstcQuantization, RangesGoFrom2To256Levels) {
    constexpr std::array<uint32_t, 21> kLevels{ 2,  3,  4,  5,  6,  8,  10,  12,  16,  20, 24,
                                                32, 40, 48, 64, 80, 96, 128, 160, 192, 256 };
    for (size_t i = 0; i < kLevels.size(); ++i) EXPECT_EQ(levelsOf(kAstcRanges[i]), kLevels[i]);
}

/// The numbers of a range stand for values that are as evenly spaced as integers allow, both ends included.
TEST(AstcQuantization, ColoursAndWeightsAreEvenlySpaced) {
    for (uint32_t i = blocks::kAstcRangeOf6; i < kAstcRanges.size(); ++i) {
        const uint32_t levels = levelsOf(kAstcRanges[i]);
        std::set<int> colors;
        for (uint32_t n = 0; n < levels; ++n) colors.insert(blocks::astcColorsOf(i)[n]);
        ASSERT_EQ(colors.size(), levels) << i;
        uint32_t n = 0;
        for (const int color : colors) EXPECT_NEAR(color, 255.0 * n++ / (levels - 1), 1.25) << levels;
    }
    for (uint32_t i = 0; i <= blocks::kAstcRangeOf32; ++i) {
        const uint32_t levels = levelsOf(kAstcRanges[i]);
        std::set<int> weights;
        for (uint32_t n = 0; n < levels; ++n) weights.insert(blocks::astcWeightsOf(i)[n]);
        ASSERT_EQ(weights.size(), levels) << i;
        uint32_t n = 0;
        for (const int weight : weights) EXPECT_NEAR(weight, 64.0 * n++ / (levels - 1), 1.35) << levels;
    }
}

/// The specification's tables have more codes than numbers; each number is there, and each pack is read in order.
TEST(AstcQuantization, EveryTripleOfQuintsAndTupleOfTritsHasACode) {
    for (const bool isTrit : { true, false }) {
        const AstcRange range{ isTrit, !isTrit, 0 };
        const uint32_t count = isTrit ? 5 : 3, bits = isTrit ? 8 : 7;
        std::set<uint32_t> tuples;
        for (uint32_t code = 0; code < 1u << bits; ++code) {
            std::array<uint8_t, 5> numbers{};
            blocks::takeAstcSequence(range, blocks::BlockBits(code, 0), std::span(numbers).first(count));
            uint32_t tuple = 0;
            for (uint32_t i = 0; i < count; ++i) {
                ASSERT_LT(numbers[i], isTrit ? 3 : 5) << code;
                tuple = tuple * 5 + numbers[i];
            }
            tuples.insert(tuple);
        }
        EXPECT_EQ(tuples.size(), isTrit ? 243u : 125u);
    }
}

TEST(AstcQuantization, SequencesAreAsLongAsTheSpecificationSays) {
    EXPECT_EQ(blocks::astcSequenceBits(kAstcRanges[4], 5), 5u + 8u);
    EXPECT_EQ(blocks::astcSequenceBits(kAstcRanges[4], 1), 1u + 2u);
    EXPECT_EQ(blocks::astcSequenceBits(kAstcRanges[6], 3), 3u + 7u);
    EXPECT_EQ(blocks::astcSequenceBits(kAstcRanges[6], 2), 2u + 5u);
    EXPECT_EQ(blocks::astcSequenceBits(kAstcRanges[20], 18), 144u);
}

/// 4 x 4 weights of two bits, one partition: the finest range fits up to six ends.
BlockWriter oneByOne(uint32_t mode, std::initializer_list<uint32_t> ends, uint32_t weight) {
    BlockWriter block;
    block.put(0b00001000010, 11).put(0, 2).put(mode, 4); // width 4, height 4, weights 0 to 3
    for (const uint32_t end : ends) block.put(end, 8);
    for (uint32_t i = 0; i < 16; ++i) // from the top down
        block.putAt(127 - 2 * i, weight & 1, 1).putAt(126 - 2 * i, weight >> 1, 1);
    return block;
}

Texel8 decodedOne(uint32_t mode, std::initializer_list<uint32_t> ends, uint32_t weight) {
    const auto texels = test::decodedBlock(BlockKind::Astc, oneByOne(mode, ends, weight).bytes);
    EXPECT_THAT(texels, Each(texels[0]));
    return texels[0];
}

TEST(Astc, TheEndsOfEveryModeAreItsFormulas) {
    EXPECT_EQ(decodedOne(0, { 10, 200 }, 0), (Texel8{ 10, 10, 10, 255 }));
    EXPECT_EQ(decodedOne(0, { 10, 200 }, 3), (Texel8{ 200, 200, 200, 255 }));
    EXPECT_EQ(decodedOne(1, { 40, 0xC0 | 5 }, 0), (Texel8{ 202, 202, 202, 255 })); // 40 / 4 + 192
    EXPECT_EQ(decodedOne(1, { 40, 0xC0 | 5 }, 3), (Texel8{ 207, 207, 207, 255 }));
    EXPECT_EQ(decodedOne(4, { 1, 2, 3, 4 }, 0), (Texel8{ 1, 1, 1, 3 }));
    EXPECT_EQ(decodedOne(4, { 1, 2, 3, 4 }, 3), (Texel8{ 2, 2, 2, 4 }));
    EXPECT_EQ(decodedOne(5, { 100, 0x80 | 6, 20, 0x7E }, 0), (Texel8{ 178, 178, 178, 10 }));
    EXPECT_EQ(decodedOne(5, { 100, 0x80 | 6, 20, 0x7E }, 3), (Texel8{ 181, 181, 181, 9 })) << "offsets 3 and -1";
    EXPECT_EQ(decodedOne(6, { 100, 50, 200, 128 }, 0), (Texel8{ 50, 25, 100, 255 }));
    EXPECT_EQ(decodedOne(6, { 100, 50, 200, 128 }, 3), (Texel8{ 100, 50, 200, 255 }));
    EXPECT_EQ(decodedOne(8, { 1, 2, 3, 4, 5, 6 }, 0), (Texel8{ 1, 3, 5, 255 }));
    EXPECT_EQ(decodedOne(8, { 1, 2, 3, 4, 5, 6 }, 3), (Texel8{ 2, 4, 6, 255 }));
    EXPECT_EQ(decodedOne(8, { 20, 2, 30, 4, 50, 6 }, 0), (Texel8{ 4, 5, 6, 255 })) << "contracted to blue";
    EXPECT_EQ(decodedOne(8, { 20, 2, 30, 4, 50, 6 }, 3), (Texel8{ 35, 40, 50, 255 }));
    EXPECT_EQ(decodedOne(9, { 20, 6, 40, 8, 60, 10 }, 0), (Texel8{ 10, 20, 30, 255 }));
    EXPECT_EQ(decodedOne(9, { 20, 6, 40, 8, 60, 10 }, 3), (Texel8{ 13, 24, 35, 255 }));
    EXPECT_EQ(decodedOne(9, { 20, 0x7E, 40, 0x7E, 60, 0x7E }, 3), (Texel8{ 20, 25, 30, 255 })) << "contracted to blue";
    EXPECT_EQ(decodedOne(10, { 100, 50, 200, 128, 7, 9 }, 0), (Texel8{ 50, 25, 100, 7 }));
    EXPECT_EQ(decodedOne(10, { 100, 50, 200, 128, 7, 9 }, 3), (Texel8{ 100, 50, 200, 9 }));
    EXPECT_EQ(decodedOne(12, { 1, 2, 3, 4, 5, 6, 7, 8 }, 0), (Texel8{ 1, 3, 5, 7 }));
    EXPECT_EQ(decodedOne(12, { 20, 2, 30, 4, 50, 6, 7, 8 }, 0), (Texel8{ 4, 5, 6, 8 })) << "contracted to blue";
    EXPECT_EQ(decodedOne(13, { 20, 6, 40, 8, 60, 10, 80, 4 }, 3), (Texel8{ 13, 24, 35, 42 }));
}

TEST(Astc, HdrEndsAreErrorsOfThisProfile) {
    for (const uint32_t mode : { 2u, 3u, 7u, 11u, 14u, 15u })
        EXPECT_EQ(decodedOne(mode, { 1, 2, 3, 4, 5, 6 }, 0), kMagenta);
}

TEST(Astc, ABlockOfOneColourHasItsHighestBits) {
    const auto solid = [](uint32_t header, std::array<uint32_t, 4> const& extent) {
        BlockWriter block;
        block.put(header, 12);
        for (const uint32_t e : extent) block.put(e, 13);
        for (const uint32_t color : { 0x1234u, 0x5678u, 0x9ABCu, 0xDEFFu }) block.put(color, 16);
        return test::decodedBlock(BlockKind::Astc, block.bytes);
    };
    const Texel8 color{ 0x12, 0x56, 0x9A, 0xDE };
    EXPECT_THAT(solid(0xDFC, { 0x1FFF, 0x1FFF, 0x1FFF, 0x1FFF }), Each(color));
    EXPECT_THAT(solid(0xDFC, { 1, 2, 3, 4 }), Each(color));
    EXPECT_THAT(solid(0xDFC, { 2, 2, 3, 4 }), Each(kMagenta)) << "an extent without texels";
    EXPECT_THAT(solid(0xDFC, { 1, 2, 5, 4 }), Each(kMagenta));
    EXPECT_THAT(solid(0xFFC, { 1, 2, 3, 4 }), Each(kMagenta)) << "HDR";
    EXPECT_THAT(solid(0x1FC, { 1, 2, 3, 4 }), Each(kMagenta)) << "reserved bits";
}

TEST(Astc, GridsThatAreLargerThanTheirBlockAreErrors) {
    const BlockWriter wide = BlockWriter().put(0b00000000110, 11).put(0, 2).put(0, 4); // 8 x 2 weights of two bits
    std::array<Texel8, 64> texels;
    decodeBlocks({ BlockKind::Astc, 8, 8 }, false, wide.bytes, 8, 8, std::as_writable_bytes(std::span(texels)));
    EXPECT_THAT(texels, Each(Texel8{ 0, 0, 0, 255 }));
    EXPECT_THAT(test::decodedBlock(BlockKind::Astc, wide.bytes), Each(kMagenta));
    EXPECT_THAT(test::decodedBlock(BlockKind::Astc, BlockWriter().put(0, 11).bytes), Each(kMagenta)) << "reserved";
}

TEST(Astc, EveryPartitionPatternUsesOnlyItsPartitions) {
    for (uint32_t count = 2; count <= 4; ++count) {
        uint32_t whole = 0;
        for (uint32_t seed = 0; seed < 1024; ++seed) {
            std::set<uint32_t> used;
            const blocks::AstcPartition partition(count, seed, false);
            for (uint32_t i = 0; i < 64; ++i) used.insert(partition.at(i % 8, i / 8));
            EXPECT_LT(*used.rbegin(), count);
            whole += used.size() == count;
        }
        EXPECT_GT(whole, 400u) << count;
    }
}

} // namespace
} // namespace filament_core::assets
