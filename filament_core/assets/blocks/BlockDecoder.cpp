// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/blocks/BlockDecoder.h"

#include "base/Assert.h"
#include "filament_core/assets/blocks/BlockTexels.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace filament_core::assets {
namespace {

using blocks::Texel8;
using blocks::TexelHalf;

struct ImageSides {
    uint32_t width = 0, height = 0;
};

uint64_t blocksIn(uint32_t texels, uint32_t blockSide) { return (uint64_t{ texels } + blockSide - 1) / blockSide; }

/// `decode(block, texels)` writes the texels of one block. It is a template so that no call goes through a pointer.
template <class Texel, class Decode>
void decodeAll(BlockFormat format, const std::byte* bytes, ImageSides size, std::byte* pixels, Decode const& decode) {
    const uint32_t blockBytes = bytesPerBlock(format.kind);
    std::array<Texel, blocks::kMaxBlockTexels> texels;
    for (uint32_t y = 0; y < size.height; y += format.blockHeight) {
        const uint32_t rows = std::min<uint32_t>(format.blockHeight, size.height - y);
        for (uint32_t x = 0; x < size.width; x += format.blockWidth, bytes += blockBytes) {
            const uint32_t columns = std::min<uint32_t>(format.blockWidth, size.width - x);
            decode(bytes, texels.data());
            for (uint32_t row = 0; row < rows; ++row) {
                std::memcpy(pixels + (size_t{ y + row } * size.width + x) * sizeof(Texel),
                            &texels[size_t{ row } * format.blockWidth], columns * sizeof(Texel));
            }
        }
    }
}

void checkImage(BlockFormat format, std::span<const std::byte> bytes, ImageSides size,
                std::span<const std::byte> pixels) {
    const size_t texelBytes = hasHalfTexels(format.kind) ? sizeof(TexelHalf) : sizeof(Texel8);
    FILAMENT_ASSERT(bytes.size() == bytesOfBlocks(format, size.width, size.height),
                    "the blocks are those of the image");
    FILAMENT_ASSERT(pixels.size() == size_t{ size.width } * size.height * texelBytes, "there is room for every texel");
    FILAMENT_ASSERT(format.kind == BlockKind::Astc || (format.blockWidth == 4 && format.blockHeight == 4),
                    "blocks are 4 x 4 except those of ASTC");
    FILAMENT_ASSERT(std::min(format.blockWidth, format.blockHeight) >= 4 &&
                            std::max(format.blockWidth, format.blockHeight) <= 12,
                    "blocks of ASTC have 4 to 12 texels a side");
}

} // namespace

uint32_t bytesPerBlock(BlockKind kind) {
    switch (kind) {
    case BlockKind::Bc1Rgb:
    case BlockKind::Bc1Rgba:
    case BlockKind::Bc4:
    case BlockKind::Bc4Signed:
    case BlockKind::Etc2Rgb:
    case BlockKind::Etc2RgbA1:
    case BlockKind::EacR:
    case BlockKind::EacRSigned:
        return 8;
    default:
        return 16;
    }
}

bool hasHalfTexels(BlockKind kind) {
    switch (kind) {
    case BlockKind::Bc4Signed:
    case BlockKind::Bc5Signed:
    case BlockKind::Bc6:
    case BlockKind::Bc6Signed:
    case BlockKind::EacR:
    case BlockKind::EacRSigned:
    case BlockKind::EacRg:
    case BlockKind::EacRgSigned:
        return true;
    default:
        return false;
    }
}

uint64_t bytesOfBlocks(BlockFormat format, uint32_t width, uint32_t height) {
    return blocksIn(width, format.blockWidth) * blocksIn(height, format.blockHeight) * bytesPerBlock(format.kind);
}

void decodeBlocks(BlockFormat format, bool isSrgb, std::span<const std::byte> bytes, uint32_t width, uint32_t height,
                  std::span<std::byte> pixels) {
    checkImage(format, bytes, { width, height }, pixels);
    const auto as8 = [&](auto const& decode) {
        decodeAll<Texel8>(format, bytes.data(), { width, height }, pixels.data(), decode);
    };
    const auto asHalf = [&](auto const& decode) {
        decodeAll<TexelHalf>(format, bytes.data(), { width, height }, pixels.data(), decode);
    };
    switch (format.kind) {
    case BlockKind::Bc1Rgb:
        return as8([](auto from, auto to) { blocks::decodeBc1Rgb(from, to); });
    case BlockKind::Bc1Rgba:
        return as8([](auto from, auto to) { blocks::decodeBc1Rgba(from, to); });
    case BlockKind::Bc2:
        return as8([](auto from, auto to) { blocks::decodeBc2(from, to); });
    case BlockKind::Bc3:
        return as8([](auto from, auto to) { blocks::decodeBc3(from, to); });
    case BlockKind::Bc4:
        return as8([](auto from, auto to) { blocks::decodeBc4(from, to); });
    case BlockKind::Bc4Signed:
        return asHalf([](auto from, auto to) { blocks::decodeBc4Signed(from, to); });
    case BlockKind::Bc5:
        return as8([](auto from, auto to) { blocks::decodeBc5(from, to); });
    case BlockKind::Bc5Signed:
        return asHalf([](auto from, auto to) { blocks::decodeBc5Signed(from, to); });
    case BlockKind::Bc6:
        return asHalf([](auto from, auto to) { blocks::decodeBc6(from, to); });
    case BlockKind::Bc6Signed:
        return asHalf([](auto from, auto to) { blocks::decodeBc6Signed(from, to); });
    case BlockKind::Bc7:
        return as8([](auto from, auto to) { blocks::decodeBc7(from, to); });
    case BlockKind::Etc2Rgb:
        return as8([](auto from, auto to) { blocks::decodeEtc2Rgb(from, to); });
    case BlockKind::Etc2RgbA1:
        return as8([](auto from, auto to) { blocks::decodeEtc2RgbA1(from, to); });
    case BlockKind::Etc2Rgba:
        return as8([](auto from, auto to) { blocks::decodeEtc2Rgba(from, to); });
    case BlockKind::EacR:
        return asHalf([](auto from, auto to) { blocks::decodeEacR(from, to); });
    case BlockKind::EacRSigned:
        return asHalf([](auto from, auto to) { blocks::decodeEacRSigned(from, to); });
    case BlockKind::EacRg:
        return asHalf([](auto from, auto to) { blocks::decodeEacRg(from, to); });
    case BlockKind::EacRgSigned:
        return asHalf([](auto from, auto to) { blocks::decodeEacRgSigned(from, to); });
    case BlockKind::Astc:
        return as8([&](auto from, auto to) {
            blocks::decodeAstc(from, format.blockWidth, format.blockHeight, isSrgb, to);
        });
    case BlockKind::Uastc:
        return as8([isSrgb](auto from, auto to) { blocks::decodeUastc(from, isSrgb, to); });
    }
}

} // namespace filament_core::assets
