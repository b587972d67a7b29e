// SPDX-License-Identifier: Apache-2.0
// ETC2 and EAC: blocks of every mode with colours that follow from the specification's formulas. Random blocks are
// compared with a device in tests/backend/gles/BlockSamplingTest.cpp.
#include "base/math/Half.h"
#include "tests/filament_core/assets/blocks/BlockWriter.h"

#include <gmock/gmock.h>

namespace filament_core::assets {
namespace {

using blocks::Texel8;
using blocks::TexelHalf;

/// 64 bits as ETC stores them, the highest byte first.
std::array<std::byte, 8> etcBlock(uint64_t bits) {
    std::array<std::byte, 8> bytes;
    for (size_t i = 0; i < 8; ++i) bytes[i] = static_cast<std::byte>(bits >> (56 - 8 * i));
    return bytes;
}

/// `value` whose lowest bit is bit `lowest` of the block, numbered as in the specification.
uint64_t at(uint32_t lowest, uint64_t value) { return value << lowest; }

TEST(Etc2, TheHalvesOfAnIndividualBlockHaveColoursOf4Bits) {
    const uint64_t colors = at(60, 3) | at(56, 9) | at(52, 5) | at(48, 2) | at(44, 15) | at(40, 1);
    for (const bool isStacked : { false, true }) {
        const auto texels =
                test::decodedBlock(BlockKind::Etc2Rgb, etcBlock(colors | at(32, isStacked))); // tables 0, all +2
        const Texel8 first{ 3 * 17 + 2, 5 * 17 + 2, 255, 255 }, second{ 9 * 17 + 2, 2 * 17 + 2, 1 * 17 + 2, 255 };
        for (uint32_t i = 0; i < 16; ++i) EXPECT_EQ(texels[i], (isStacked ? i / 4 : i % 4) < 2 ? first : second) << i;
    }
}

TEST(Etc2, PixelIndicesChooseTheModifierByColumns) {
    // differential, grey 132, table 7; texel (x, y) is number 4 x + y: 0 to 3 in turn
    const uint64_t grey = at(59, 16) | at(51, 16) | at(43, 16) | at(37, 7) | at(34, 7) | at(33, 1);
    const auto texels = test::decodedBlock(BlockKind::Etc2Rgb, etcBlock(grey | at(16, 0xCCCC) | 0xAAAA));
    const std::array<uint8_t, 4> expected{ 132 + 47, 255, 132 - 47, 0 };
    for (uint32_t y = 0; y < 4; ++y) {
        for (uint32_t x = 0; x < 4; ++x) EXPECT_EQ(texels[4 * y + x].r, expected[y]) << x << ", " << y;
    }
}

TEST(Etc2, HolesOfPunchThroughBlocksAreTransparentBlack) {
    const uint64_t grey = at(59, 16) | at(51, 16) | at(43, 16) | at(37, 7) | at(34, 7);
    const uint64_t indices = at(16, 0xCCCC) | 0xAAAA;
    const auto holes = test::decodedBlock(BlockKind::Etc2RgbA1, etcBlock(grey | indices));
    EXPECT_EQ(holes[0], (Texel8{ 132, 132, 132, 255 })) << "the small modifier is 0";
    EXPECT_EQ(holes[8], (Texel8{ 0, 0, 0, 0 }));
    EXPECT_EQ(holes[12], (Texel8{ 0, 0, 0, 255 }));
    const auto opaque = test::decodedBlock(BlockKind::Etc2RgbA1, etcBlock(grey | indices | at(33, 1)));
    EXPECT_EQ(opaque[8], (Texel8{ 85, 85, 85, 255 }));
}

TEST(Etc2, APlanarBlockIsALinearRamp) {
    // blue overflows: 0 - 4 < 0. Origin 0; right 252; below 0, all of red
    const uint64_t bits = at(57, 0) | at(42, 1) | at(33, 1) | at(34, 31) | at(32, 1);
    const auto texels = test::decodedBlock(BlockKind::Etc2Rgb, etcBlock(bits));
    for (uint32_t i = 0; i < 16; ++i) EXPECT_EQ(texels[i].r, (i % 4 * 255 + 2) / 4) << i;
}

TEST(Etc2, AlphaOfEacIsAddedToTheColours) {
    std::array<std::byte, 16> block{};
    const auto alpha =
            etcBlock(at(56, 100) | at(52, 3) | at(48, 13) | at(45, 7)); // texel 0: 100 + 9 * 3, others - 1 * 3
    std::copy(alpha.begin(), alpha.end(), block.begin());
    const auto texels = test::decodedBlock(BlockKind::Etc2Rgba, block);
    EXPECT_EQ(texels[0].a, 127);
    EXPECT_EQ(texels[1].a, 97);
    EXPECT_EQ(texels[15].r, 2) << "an individual block of black, and the first modifier";
}

TEST(Eac, ElevenBitsAreHalvesOfTheirShare) {
    for (const int base : { 0, 1, 128, 255 }) {
        const auto one =
                etcBlock(at(56, static_cast<uint64_t>(base)) | at(52, 1) | at(48, 13) | at(45, 4)); // texel 0: + 0
        const auto texels = test::decodedBlock<TexelHalf>(BlockKind::EacR, one);
        EXPECT_NEAR(floatFromHalf(texels[0].r), (base * 8 + 4) / 2047.0, 5e-4);
        EXPECT_EQ(texels[0].g, 0);
        EXPECT_EQ(texels[0].a, 0x3C00);
    }
    for (const int base : { -128, -127, -1, 0, 5, 127 }) {
        const auto one = etcBlock(at(56, static_cast<uint8_t>(base)) | at(52, 0) | at(48, 13) | at(45, 4));
        std::array<std::byte, 16> both{};
        std::copy(one.begin(), one.end(), both.begin() + 8);
        const auto texels = test::decodedBlock<TexelHalf>(BlockKind::EacRgSigned, both);
        EXPECT_NEAR(floatFromHalf(texels[0].g), std::max(base, -127) * 8 / 1023.0, 5e-4) << base;
        EXPECT_NEAR(floatFromHalf(texels[1].g), std::max(std::max(base, -127) * 8 - 1, -1023) / 1023.0, 5e-4)
                << "a multiplier of 0 is an eighth";
    }
}

} // namespace
} // namespace filament_core::assets
