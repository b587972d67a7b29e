// SPDX-License-Identifier: Apache-2.0
/// What the decoders of single blocks share: texels, and the bits of a block. Each decoder writes the texels of one
/// block, row by row, for any bytes.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace filament_core::assets::blocks {

struct Texel8 {
    uint8_t r = 0, g = 0, b = 0, a = 255;
    friend bool operator==(Texel8 const&, Texel8 const&) = default;
};

/// Bits of half floats.
struct TexelHalf {
    static constexpr uint16_t kOne = 0x3C00;
    uint16_t r = 0, g = 0, b = 0, a = kOne;
    friend bool operator==(TexelHalf const&, TexelHalf const&) = default;
};

inline constexpr uint32_t kMaxBlockTexels = 12 * 12;

/// `count` bytes, lowest first.
inline uint64_t loadLittle(const std::byte* bytes, uint32_t count = 8) {
    uint64_t value = 0;
    for (uint32_t i = 0; i < count; ++i) value |= uint64_t{ std::to_integer<uint8_t>(bytes[i]) } << (8 * i);
    return value;
}

/// 8 bytes, highest first.
inline uint64_t loadBig(const std::byte* bytes) {
    uint64_t value = 0;
    for (uint32_t i = 0; i < 8; ++i) value = value << 8 | std::to_integer<uint8_t>(bytes[i]);
    return value;
}

inline uint8_t clampedTo8(int32_t value) { return static_cast<uint8_t>(value < 0 ? 0 : value > 255 ? 255 : value); }

/// Intensity modifiers of ETC1 and its descendants: the small and the large one of each table.
inline constexpr std::array<std::array<int16_t, 2>, 8> kEtcIntensities{
    { { 2, 8 }, { 5, 17 }, { 9, 29 }, { 13, 42 }, { 18, 60 }, { 24, 80 }, { 33, 106 }, { 47, 183 } }
};

/// 128 bits, taken from the lowest one. Behind the last one are zeros.
class BlockBits {
public:
    BlockBits() = default;
    explicit BlockBits(const std::byte* block) : mLow(loadLittle(block)), mHigh(loadLittle(block + 8)) {}
    BlockBits(uint64_t low, uint64_t high) : mLow(low), mHigh(high) {}

    uint32_t take(uint32_t count) { ///< up to 32
        const auto taken = static_cast<uint32_t>(mLow & ((uint64_t{ 1 } << count) - 1));
        skip(count);
        return taken;
    }
    void skip(uint32_t count) { *this = from(count); }

    /// The bits from `first` on.
    BlockBits from(uint32_t first) const {
        if (first == 0) return *this;
        if (first >= 128) return {};
        if (first >= 64) return { mHigh >> (first - 64), 0 };
        return { mLow >> first | mHigh << (64 - first), mHigh >> first };
    }
    uint32_t at(uint32_t first, uint32_t count) const { return from(first).take(count); }

    /// The lowest `count` of them.
    BlockBits firstOf(uint32_t count) const {
        if (count >= 128) return *this;
        if (count >= 64) return { mLow, mHigh & ((uint64_t{ 1 } << (count - 64)) - 1) };
        return { mLow & ((uint64_t{ 1 } << count) - 1), 0 };
    }
    /// The last one first.
    BlockBits reversed() const { return { reversed(mHigh), reversed(mLow) }; }

private:
    static uint64_t reversed(uint64_t v) {
        v = (v >> 1 & 0x5555555555555555) | (v & 0x5555555555555555) << 1;
        v = (v >> 2 & 0x3333333333333333) | (v & 0x3333333333333333) << 2;
        v = (v >> 4 & 0x0F0F0F0F0F0F0F0F) | (v & 0x0F0F0F0F0F0F0F0F) << 4;
        v = (v >> 8 & 0x00FF00FF00FF00FF) | (v & 0x00FF00FF00FF00FF) << 8;
        v = (v >> 16 & 0x0000FFFF0000FFFF) | (v & 0x0000FFFF0000FFFF) << 16;
        return v >> 32 | v << 32;
    }

    uint64_t mLow = 0, mHigh = 0;
};

// S3tc.cpp, Rgtc.cpp: BC1 to BC5. KDF 1.3, chapters 18 and 19
void decodeBc1Rgb(const std::byte* block, Texel8* texels);
void decodeBc1Rgba(const std::byte* block, Texel8* texels);
void decodeBc2(const std::byte* block, Texel8* texels);
void decodeBc3(const std::byte* block, Texel8* texels);
/// 16 codes of 8 bits: a channel of BC4 and BC5, and the alpha of BC3.
void decodeChannel(const std::byte* block, uint8_t* codes);
void decodeBc4(const std::byte* block, Texel8* texels);
void decodeBc5(const std::byte* block, Texel8* texels);
void decodeBc4Signed(const std::byte* block, TexelHalf* texels);
void decodeBc5Signed(const std::byte* block, TexelHalf* texels);

// Bptc6.cpp, Bptc7.cpp. Chapter 20
void decodeBc6(const std::byte* block, TexelHalf* texels);
void decodeBc6Signed(const std::byte* block, TexelHalf* texels);
void decodeBc7(const std::byte* block, Texel8* texels);

// Etc2.cpp, Eac.cpp. Chapters 21 and 22
void decodeEtc2Rgb(const std::byte* block, Texel8* texels);
void decodeEtc2RgbA1(const std::byte* block, Texel8* texels);
void decodeEtc2Rgba(const std::byte* block, Texel8* texels);
void decodeEacR(const std::byte* block, TexelHalf* texels);
void decodeEacRSigned(const std::byte* block, TexelHalf* texels);
void decodeEacRg(const std::byte* block, TexelHalf* texels);
void decodeEacRgSigned(const std::byte* block, TexelHalf* texels);
/// 16 codes of alpha.
void decodeEacAlpha(const std::byte* block, uint8_t* codes);

// Astc.cpp, Uastc.cpp. Chapter 23
void decodeAstc(const std::byte* block, uint32_t blockWidth, uint32_t blockHeight, bool isSrgb, Texel8* texels);
void decodeUastc(const std::byte* block, bool isSrgb, Texel8* texels);

} // namespace filament_core::assets::blocks
