// SPDX-License-Identifier: Apache-2.0
/// BlockFormat: the block-compressed texture formats that are read, and their sizes.
///   Each block holds a small rectangle of texels in 8 or 16 bytes; blocks follow in rows from the top left. An image
///   whose size is no multiple of that of a block has the texels that stick out, and they are dropped.
///   Thread  any; pure.
#pragma once

#include <array>
#include <cstdint>

namespace filament_core::assets {

enum class BlockKind : uint8_t {
    Bc1Rgb, ///< alpha is 1
    Bc1Rgba,
    Bc2,
    Bc3,
    Bc4,
    Bc4Signed,
    Bc5,
    Bc5Signed,
    Bc6,
    Bc6Signed,
    Bc7,
    Etc2Rgb, ///< also ETC1
    Etc2RgbA1,
    Etc2Rgba,
    EacR,
    EacRSigned,
    EacRg,
    EacRgSigned,
    Astc,  ///< the LDR profile, of any block size
    Uastc, ///< LDR 4x4
};

struct BlockFormat {
    BlockKind kind = BlockKind::Bc7;
    uint8_t blockWidth = 4, blockHeight = 4; ///< other than 4: Astc only, 4 to 12

    friend bool operator==(BlockFormat const&, BlockFormat const&) = default;
};

/// Width and height of the blocks of two-dimensional ASTC, in the order of the formats of Vulkan and OpenGL ES.
inline constexpr std::array<std::array<uint8_t, 2>, 14> kAstcBlockSizes{ {
        { 4, 4 },
        { 5, 4 },
        { 5, 5 },
        { 6, 5 },
        { 6, 6 },
        { 8, 5 },
        { 8, 6 },
        { 8, 8 },
        { 10, 5 },
        { 10, 6 },
        { 10, 8 },
        { 10, 10 },
        { 12, 10 },
        { 12, 12 },
} };

/// 8 or 16.
uint32_t bytesPerBlock(BlockKind kind);

/// Whether texels are decoded to halves, because 8 bits would lose some: BC6, EAC of 11 bits, what has a sign.
bool hasHalfTexels(BlockKind kind);

/// Bytes of an image; 0 for an empty one. Sides up to 2^30.
uint64_t bytesOfBlocks(BlockFormat format, uint32_t width, uint32_t height);

} // namespace filament_core::assets
