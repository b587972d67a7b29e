// SPDX-License-Identifier: Apache-2.0
// BC1 to BC5: every palette against the real numbers of the specification.
#include "base/math/Half.h"
#include "tests/filament_core/assets/blocks/BlockWriter.h"

#include <gmock/gmock.h>

#include <cmath>

namespace filament_core::assets {
namespace {

using blocks::Texel8;
using blocks::TexelHalf;
using test::BlockBytes;
using test::BlockWriter;

/// Texel i has index i % 4.
BlockBytes colorBlock(uint32_t first, uint32_t second) {
    return BlockWriter().put(first, 16).put(second, 16).put(0xE4E4E4E4, 32).bytes;
}

/// Halves are rounded up.
uint8_t nearest(double share) { return static_cast<uint8_t>(std::floor(share * 255 + 0.5 + 1e-9)); }

TEST(Bc1, ColoursAreTheNearestCodesOfEveryPairOfEnds) {
    for (uint32_t first = 0; first < 32; ++first) {
        for (uint32_t second = 0; second < 32; ++second) {
            const auto texels =
                    test::decodedBlock(BlockKind::Bc1Rgba, colorBlock(first << 11 | first, second << 11 | second));
            const double a = first / 31.0, b = second / 31.0;
            const bool hasThirds = first > second;
            const std::array<double, 3> reds{ a, b, hasThirds ? (2 * a + b) / 3 : (a + b) / 2 };
            for (size_t i = 0; i < 3; ++i) EXPECT_EQ(texels[i], (Texel8{ nearest(reds[i]), 0, nearest(reds[i]), 255 }));
            EXPECT_EQ(texels[3], hasThirds ? (Texel8{ nearest((a + 2 * b) / 3), 0, nearest((a + 2 * b) / 3), 255 })
                                           : (Texel8{ 0, 0, 0, 0 }));
        }
    }
    for (uint32_t first = 0; first < 64; ++first) {
        for (uint32_t second = 0; second < 64; ++second) {
            const auto texels = test::decodedBlock(BlockKind::Bc1Rgb, colorBlock(first << 5, second << 5));
            const double a = first / 63.0, b = second / 63.0;
            EXPECT_EQ(texels[2].g, nearest(first > second ? (2 * a + b) / 3 : (a + b) / 2)) << first << " " << second;
            EXPECT_EQ(texels[3].a, 255) << "without alpha the fourth colour is black";
        }
    }
}

TEST(Bc2, AlphaIsExplicitAndColoursAlwaysHaveThirds) {
    BlockWriter block;
    block.put(0xFEDCBA9876543210, 64);
    const BlockBytes colors = colorBlock(0, 0xFFFF); // in the order that means black in BC1
    std::copy_n(colors.begin(), 8, block.bytes.begin() + 8);
    const auto texels = test::decodedBlock(BlockKind::Bc2, block.bytes);
    for (uint32_t i = 0; i < 16; ++i) EXPECT_EQ(texels[i].a, i * 17);
    EXPECT_EQ(texels[3], (Texel8{ 170, 170, 170, 51 }));
}

TEST(Bc4, EntriesAreTheNearestCodesOfEveryPairOfEnds) {
    for (uint32_t first = 0; first < 256; ++first) {
        for (uint32_t second = 0; second < 256; ++second) {
            BlockWriter block;
            block.put(first, 8).put(second, 8);
            for (uint32_t i = 0; i < 16; ++i) block.put(i % 8, 3);
            const auto texels = test::decodedBlock(BlockKind::Bc4, block.bytes);
            const int parts = first > second ? 7 : 5;
            for (int i = 2; i < parts + 1; ++i) {
                const double exact = ((parts - i + 1) * double(first) + (i - 1) * double(second)) / parts;
                ASSERT_EQ(texels[static_cast<size_t>(i)].r, std::floor(exact + 0.5))
                        << first << " " << second << " " << i;
            }
            ASSERT_TRUE(parts == 7 || (texels[6].r == 0 && texels[7].r == 255));
            ASSERT_TRUE(texels[0].r == first && texels[1].r == second && texels[9].g == 0);
        }
    }
}

TEST(Bc5, SignedEndsGoFromMinusOneToOne) {
    for (auto const& [first, second] :
         { std::pair{ 127, -127 }, { -128, 127 }, { -127, -128 }, { 0, 0 }, { 50, -20 } }) {
        BlockWriter block;
        block.put(static_cast<uint8_t>(first), 8).put(static_cast<uint8_t>(second), 8);
        for (uint32_t i = 0; i < 16; ++i) block.put(i % 8, 3);
        block.put(static_cast<uint8_t>(second), 8).put(static_cast<uint8_t>(first), 8);
        const auto texels = test::decodedBlock<TexelHalf>(BlockKind::Bc5Signed, block.bytes);
        const double a = std::max(first, -127) / 127.0, b = std::max(second, -127) / 127.0;
        const int parts = first > second ? 7 : 5;
        EXPECT_NEAR(floatFromHalf(texels[0].r), a, 5e-4);
        EXPECT_NEAR(floatFromHalf(texels[1].r), b, 5e-4);
        EXPECT_NEAR(floatFromHalf(texels[3].r), ((parts - 2) * a + 2 * b) / parts, 5e-4);
        EXPECT_EQ(floatFromHalf(texels[7].r), parts == 5 ? 1.0f : floatFromHalf(texels[7].r));
        EXPECT_NEAR(floatFromHalf(texels[4].g), b, 5e-4) << "all indices of green are 0";
        EXPECT_EQ(floatFromHalf(texels[4].b), 0.0f);
    }
}

TEST(BlockDecoder, TexelsThatStickOutOfAnImageAreDropped) {
    std::mt19937 random(1);
    std::vector<std::byte> bytes;
    for (int i = 0; i < 4; ++i) {
        const auto block = test::randomBlock(random);
        bytes.insert(bytes.end(), block.begin(), block.end());
    }
    std::vector<Texel8> whole(64), part(35);
    decodeBlocks({ BlockKind::Bc7 }, false, bytes, 8, 8, std::as_writable_bytes(std::span(whole)));
    decodeBlocks({ BlockKind::Bc7 }, false, bytes, 7, 5, std::as_writable_bytes(std::span(part)));
    for (size_t y = 0; y < 5; ++y) {
        for (size_t x = 0; x < 7; ++x) EXPECT_EQ(part[7 * y + x], whole[8 * y + x]) << x << ", " << y;
    }
}

TEST(BlockDecoder, SizesCountPartialBlocks) {
    EXPECT_EQ(bytesOfBlocks({ BlockKind::Bc1Rgb }, 1, 1), 8u);
    EXPECT_EQ(bytesOfBlocks({ BlockKind::Bc7 }, 5, 4), 32u);
    EXPECT_EQ(bytesOfBlocks({ BlockKind::Astc, 12, 10 }, 25, 10), 48u);
    EXPECT_EQ(bytesOfBlocks({ BlockKind::EacRg }, 1 << 30, 1 << 30), uint64_t{ 1 } << 60);
    EXPECT_EQ(bytesOfBlocks({ BlockKind::Bc7 }, 0, 4), 0u);
}

} // namespace
} // namespace filament_core::assets
