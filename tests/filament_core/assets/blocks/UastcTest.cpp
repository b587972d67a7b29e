// SPDX-License-Identifier: Apache-2.0
// Blocks of every mode of UASTC, written here bit by bit from the specification's layout.
#include "filament_core/assets/blocks/Uastc.h"
#include "filament_core/assets/blocks/AstcPartition.h"
#include "filament_core/assets/blocks/AstcQuantization.h"
#include "tests/filament_core/assets/blocks/BlockWriter.h"

#include <gmock/gmock.h>

namespace filament_core::assets {
namespace {

using blocks::kUastcModes;
using blocks::Texel8;
using blocks::UastcChannels;
using blocks::UastcMode;
using test::BlockWriter;

/// What is written; numbers are quantised.
struct UastcContents {
    uint32_t pattern = 0, planeChannel = 0;
    std::array<uint8_t, 18> ends{};
    std::array<std::array<uint8_t, 2>, 16> weights{};
};

uint32_t endsOf(UastcMode const& mode) {
    return mode.subsets * (mode.channels == UastcChannels::Rgb ? 6 : mode.channels == UastcChannels::Rgba ? 8 : 4);
}

/// The partition that the specification's seed makes, texel by texel.
std::array<uint32_t, 16> subsetsOf(uint32_t mode, uint32_t pattern) {
    std::array<uint32_t, 16> subsets{};
    if (kUastcModes[mode].subsets == 1) return subsets;
    const uint32_t seed = mode == 7   ? blocks::kUastcSeedsOfMode7[pattern]
                          : mode == 3 ? blocks::kUastcSeedsOfThree[pattern]
                                      : blocks::kUastcSeedsOfTwo[pattern];
    for (uint32_t i = 0; i < 16; ++i)
        subsets[i] = blocks::AstcPartition(kUastcModes[mode].subsets, seed, true).at(i % 4, i / 4);
    return subsets;
}

/// The first texel of a subset: its weights have their highest bit left out.
bool isAnchor(std::array<uint32_t, 16> const& subsets, uint32_t texel) {
    for (uint32_t i = 0; i < texel; ++i) {
        if (subsets[i] == subsets[texel]) return false;
    }
    return true;
}

void putEnds(UastcMode const& mode, UastcContents const& contents, BlockWriter& block) {
    const blocks::AstcRange range = blocks::kAstcRanges[mode.colorRange];
    const uint32_t count = endsOf(mode), group = range.trits ? 5 : 3, base = range.trits ? 3 : 5;
    for (uint32_t at = 0; (range.trits || range.quints) && at < count; at += group) {
        const uint32_t size = std::min(group, count - at);
        uint32_t packed = 0;
        for (uint32_t i = size; i-- > 0;) packed = packed * base + (contents.ends[at + i] >> range.bits);
        constexpr std::array<uint32_t, 6> kTritBits{ 0, 2, 4, 5, 7, 8 };
        constexpr std::array<uint32_t, 4> kQuintBits{ 0, 3, 5, 7 };
        block.put(packed, range.trits ? kTritBits[size] : kQuintBits[size]);
    }
    for (uint32_t i = 0; i < count; ++i) block.put(contents.ends[i] & ((1u << range.bits) - 1), range.bits);
}

BlockWriter writeUastc(uint32_t index, UastcContents const& contents, uint32_t hints) {
    UastcMode const& mode = kUastcModes[index];
    BlockWriter block;
    block.put(mode.code, mode.codeBits).put(hints, mode.hintBits);
    if (mode.planes == 2 && mode.channels != UastcChannels::LuminanceAlpha) block.put(contents.planeChannel, 2);
    if (mode.subsets > 1) block.put(contents.pattern, mode.subsets == 3 ? 4 : 5);
    putEnds(mode, contents, block);
    const auto subsets = subsetsOf(index, contents.pattern);
    for (uint32_t i = 0; i < 16; ++i) {
        for (uint32_t plane = 0; plane < mode.planes; ++plane)
            block.put(contents.weights[i][plane], mode.weightBits - isAnchor(subsets, i));
    }
    return block;
}

/// The texel in real numbers.
std::array<double, 4> exactTexel(uint32_t index, UastcContents const& contents, uint32_t texel) {
    UastcMode const& mode = kUastcModes[index];
    const uint32_t each = endsOf(mode) / mode.subsets, first = subsetsOf(index, contents.pattern)[texel] * each;
    constexpr std::array<uint32_t, 6> kRangeOfBits{ 0, 0, 2, 5, 8, 11 };
    auto const& weights = blocks::astcWeightsOf(kRangeOfBits[mode.weightBits]);
    std::array<double, 4> color{};
    for (uint32_t c = 0; c < 4; ++c) {
        if (mode.channels == UastcChannels::Rgb && c == 3) {
            color[c] = 255;
            continue;
        }
        const uint32_t pair = mode.channels == UastcChannels::LuminanceAlpha ? c / 3 : c;
        auto const& colors = blocks::astcColorsOf(mode.colorRange);
        const double low = colors[contents.ends[first + 2 * pair]], high = colors[contents.ends[first + 2 * pair + 1]];
        const uint32_t channel = mode.channels == UastcChannels::LuminanceAlpha ? 3 : contents.planeChannel;
        const uint32_t plane = mode.planes == 2 && c == channel;
        color[c] = low + (high - low) * weights[contents.weights[texel][plane]] / 64;
    }
    return color;
}

UastcContents randomContents(uint32_t index, uint32_t pattern, std::mt19937& random) {
    UastcMode const& mode = kUastcModes[index];
    UastcContents contents{ .pattern = pattern, .planeChannel = static_cast<uint32_t>(random() % 4) };
    const blocks::AstcRange range = blocks::kAstcRanges[mode.colorRange];
    const uint32_t levels = (range.trits ? 3u : range.quints ? 5u : 1u) << range.bits;
    for (uint32_t i = 0; i < endsOf(mode); ++i) contents.ends[i] = static_cast<uint8_t>(random() % levels);
    const auto subsets = subsetsOf(index, pattern);
    for (uint32_t i = 0; i < 16; ++i) {
        for (uint8_t& weight : contents.weights[i])
            weight = static_cast<uint8_t>(random() % (1u << (mode.weightBits - isAnchor(subsets, i))));
    }
    return contents;
}

uint32_t patternsOf(uint32_t index) {
    if (kUastcModes[index].subsets == 1) return 1;
    return index == 7 ? 19 : index == 3 ? 11 : 30;
}

TEST(Uastc, EveryModeAndPatternHasTheTexelsThatWereWritten) {
    std::mt19937 random(1);
    for (uint32_t index = 0; index < kUastcModes.size(); ++index) {
        if (index == blocks::kUastcSolidMode) continue;
        for (uint32_t turn = 0; turn < 2 * patternsOf(index) + 8; ++turn) {
            const UastcContents contents = randomContents(index, turn % patternsOf(index), random);
            const BlockWriter block = writeUastc(index, contents, static_cast<uint32_t>(random()));
            ASSERT_LE(block.at, 128u);
            const auto texels = test::decodedBlock(BlockKind::Uastc, block.bytes);
            for (uint32_t i = 0; i < 16; ++i) {
                const std::array<double, 4> exact = exactTexel(index, contents, i);
                // sums of 16 bits are rounded, and cut off to their highest 8
                for (size_t c = 0; c < 4; ++c) {
                    const std::array<uint8_t, 4> seen{ texels[i].r, texels[i].g, texels[i].b, texels[i].a };
                    ASSERT_NEAR(seen[c], exact[c] * 257 / 256 - 0.5, 0.51)
                            << "mode " << index << " texel " << i << " channel " << c;
                }
            }
        }
    }
}

TEST(Uastc, ASolidBlockHasItsColour) {
    BlockWriter block;
    block.put(kUastcModes[blocks::kUastcSolidMode].code, 5).put(0x40302010, 32);
    EXPECT_THAT(test::decodedBlock(BlockKind::Uastc, block.bytes), testing::Each(Texel8{ 0x10, 0x20, 0x30, 0x40 }));
}

TEST(Uastc, ReservedModesAndPatternsAreMagenta) {
    std::mt19937 random(2);
    const Texel8 magenta{ 255, 0, 255, 255 };
    BlockWriter reserved;
    reserved.put(0x45, 7);
    EXPECT_THAT(test::decodedBlock(BlockKind::Uastc, reserved.bytes), testing::Each(magenta));
    for (const uint32_t index : { 2u, 3u, 4u, 7u, 9u, 16u }) {
        UastcMode const& mode = kUastcModes[index];
        const uint32_t bits = index == 3 ? 4 : 5;
        for (uint32_t pattern = 0; pattern < 1u << bits; ++pattern) {
            BlockWriter block;
            block.put(mode.code, mode.codeBits).put(0, mode.hintBits).put(pattern, bits);
            const bool isMagenta = test::decodedBlock(BlockKind::Uastc, block.bytes)[5] == magenta;
            EXPECT_EQ(isMagenta, pattern >= patternsOf(index)) << index << ", " << pattern;
        }
    }
}

TEST(Uastc, EveryNameOfAModeIsReadAndOnlyThose) {
    uint32_t reserved = 0;
    for (uint32_t code = 0; code < 128; ++code) {
        uint32_t matches = 0;
        for (UastcMode const& mode : kUastcModes) matches += (code & ((1u << mode.codeBits) - 1)) == mode.code;
        EXPECT_LE(matches, 1u) << code;
        reserved += matches == 0;
    }
    EXPECT_EQ(reserved, 1u) << "one of 128 is kept for later";
}

TEST(Uastc, SrgbColoursAreInterpolatedFromTheMiddleOfTheirSteps) {
    UastcContents contents;
    contents.ends = { 10, 11, 10, 11, 10, 11 };
    for (auto& weights : contents.weights) weights = { 1, 0 }; // a third: weight 21
    const auto block = writeUastc(1, contents, 0).bytes;
    EXPECT_EQ(test::decodedBlock(BlockKind::Uastc, block, false)[5].r, (10 * 257 * 43 + 11 * 257 * 21 + 32) / 64 / 256);
    EXPECT_EQ(test::decodedBlock(BlockKind::Uastc, block, true)[5].r,
              ((10 * 256 + 128) * 43 + (11 * 256 + 128) * 21 + 32) / 64 / 256);
}

} // namespace
} // namespace filament_core::assets
