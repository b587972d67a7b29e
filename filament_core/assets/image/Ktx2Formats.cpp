// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/Ktx2Formats.h"

#include "base/math/Half.h"
#include "base/math/SharedExponent.h"
#include "filament_core/assets/blocks/BlockTexels.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>

namespace filament_core::assets {
namespace {

/// A format without blocks: its channels from the lowest bit up, "r8g8b8".
struct PlainFormat {
    uint16_t unorm, snorm, sfloat, srgb; ///< VkFormats of this layout; 0: there is none
    std::string_view layout;
};
constexpr std::array<PlainFormat, 25> kPlainFormats{ {
        { 1, 0, 0, 0, "g4r4" },           { 2, 0, 0, 0, "a4b4g4r4" },      { 3, 0, 0, 0, "a4r4g4b4" },
        { 4, 0, 0, 0, "b5g6r5" },         { 5, 0, 0, 0, "r5g6b5" },        { 6, 0, 0, 0, "a1b5g5r5" },
        { 7, 0, 0, 0, "a1r5g5b5" },       { 8, 0, 0, 0, "b5g5r5a1" },      { 9, 10, 0, 15, "r8" },
        { 16, 17, 0, 22, "r8g8" },        { 23, 24, 0, 29, "r8g8b8" },     { 30, 31, 0, 36, "b8g8r8" },
        { 37, 38, 0, 43, "r8g8b8a8" },    { 44, 45, 0, 50, "b8g8r8a8" },   { 51, 52, 0, 57, "r8g8b8a8" },
        { 58, 59, 0, 0, "b10g10r10a2" },  { 64, 65, 0, 0, "r10g10b10a2" }, { 70, 71, 76, 0, "r16" },
        { 77, 78, 83, 0, "r16g16" },      { 84, 85, 90, 0, "r16g16b16" },  { 91, 92, 97, 0, "r16g16b16a16" },
        { 0, 0, 100, 0, "r32" },          { 0, 0, 103, 0, "r32g32" },      { 0, 0, 106, 0, "r32g32b32" },
        { 0, 0, 109, 0, "r32g32b32a32" },
} };
constexpr uint32_t kB10G11R11 = 122, kE5B9G9R9 = 123;

void readLayout(std::string_view layout, Ktx2Format& format) {
    uint8_t first = 0;
    for (size_t at = 0; at < layout.size();) {
        const size_t channel = std::string_view("rgba").find(layout[at++]);
        uint8_t bits = 0;
        for (; at < layout.size() && layout[at] <= '9'; ++at)
            bits = static_cast<uint8_t>(bits * 10 + (layout[at] - '0'));
        format.channels[channel] = { first, bits };
        first = static_cast<uint8_t>(first + bits);
    }
    format.texelBytes = first / 8;
}

std::optional<Ktx2Format> plainFormat(uint32_t vkFormat) {
    Ktx2Format format;
    if (vkFormat == kB10G11R11 || vkFormat == kE5B9G9R9) {
        format.texelBytes = 4;
        format.numbers = vkFormat == kE5B9G9R9 ? Ktx2Numbers::Shared : Ktx2Numbers::Packed;
        return format;
    }
    for (PlainFormat const& plain : kPlainFormats) {
        if (vkFormat != plain.unorm && vkFormat != plain.snorm && vkFormat != plain.sfloat && vkFormat != plain.srgb)
            continue;
        readLayout(plain.layout, format);
        format.isSrgb = vkFormat == plain.srgb;
        if (vkFormat == plain.snorm) format.numbers = Ktx2Numbers::Signed;
        if (vkFormat == plain.sfloat) format.numbers = Ktx2Numbers::Floats;
        return format;
    }
    return std::nullopt;
}

/// VkFormats 131 to 156, in order; those of sRGB follow the ones of numbers.
std::optional<Ktx2Format> blockFormat(uint32_t vkFormat) {
    using enum BlockKind;
    constexpr std::array kKinds{ Bc1Rgb,   Bc1Rgb, Bc1Rgba,    Bc1Rgba, Bc2,        Bc2,       Bc3,
                                 Bc3,      Bc4,    Bc4Signed,  Bc5,     Bc5Signed,  Bc6,       Bc6Signed,
                                 Bc7,      Bc7,    Etc2Rgb,    Etc2Rgb, Etc2RgbA1,  Etc2RgbA1, Etc2Rgba,
                                 Etc2Rgba, EacR,   EacRSigned, EacRg,   EacRgSigned };
    constexpr std::array kSrgbFormats{ 132, 134, 136, 138, 146, 148, 150, 152 };
    constexpr uint32_t kFirst = 131, kFirstAstc = kFirst + kKinds.size();
    static_assert(kFirstAstc == 157, "VK_FORMAT_ASTC_4x4_UNORM_BLOCK");
    Ktx2Format format;
    if (vkFormat >= kFirst && vkFormat < kFirstAstc) {
        format.block = BlockFormat{ kKinds[vkFormat - kFirst] };
        format.isSrgb = std::ranges::find(kSrgbFormats, static_cast<int>(vkFormat)) != kSrgbFormats.end();
        return format;
    }
    if (vkFormat < kFirstAstc || vkFormat >= kFirstAstc + 2 * kAstcBlockSizes.size()) return std::nullopt;
    auto const& size = kAstcBlockSizes[(vkFormat - kFirstAstc) / 2];
    format.block = BlockFormat{ Astc, size[0], size[1] };
    format.isSrgb = (vkFormat - kFirstAstc) % 2 == 1;
    return format;
}

uint64_t bitsOf(const std::byte* texel, Ktx2Channel channel) {
    const uint64_t bytes = blocks::loadLittle(texel + channel.first / 8, (channel.first % 8 + channel.bits + 7u) / 8);
    return bytes >> channel.first % 8 & ((uint64_t{ 1 } << channel.bits) - 1);
}

float signedShare(uint64_t value, uint32_t bits) {
    const auto most = static_cast<float>((uint64_t{ 1 } << (bits - 1)) - 1);
    const int64_t sign = int64_t{ 1 } << (bits - 1);
    return std::max(static_cast<float>((static_cast<int64_t>(value) ^ sign) - sign) / most, -1.0f);
}

float floatOf(Ktx2Numbers numbers, uint64_t value, uint32_t bits) {
    if (numbers == Ktx2Numbers::Codes)
        return static_cast<float>(value) / static_cast<float>((uint64_t{ 1 } << bits) - 1);
    if (numbers == Ktx2Numbers::Signed) return signedShare(value, bits);
    const float number = bits == 16 ? floatFromHalf(static_cast<uint16_t>(value))
                                    : std::bit_cast<float>(static_cast<uint32_t>(value));
    if (std::isinf(number)) return std::copysign(kMaxHalf, number);
    return std::isnan(number) ? 0.0f : number;
}

std::array<float, 4> floatsOf(Ktx2Format const& format, const std::byte* texel) {
    std::array<float, 4> floats{ 0, 0, 0, 1 };
    if (format.numbers == Ktx2Numbers::Shared || format.numbers == Ktx2Numbers::Packed) {
        const auto bits = static_cast<uint32_t>(blocks::loadLittle(texel, 4));
        const float3 color = format.numbers == Ktx2Numbers::Shared ? unpackRgb9E5(bits) : unpackR11G11B10F(bits);
        for (int c = 0; c < 3; ++c) floats[static_cast<size_t>(c)] = std::isfinite(color[c]) ? color[c] : kMaxHalf;
        return floats;
    }
    for (size_t c = 0; c < 4; ++c) {
        const Ktx2Channel channel = format.channels[c];
        if (channel.bits) floats[c] = floatOf(format.numbers, bitsOf(texel, channel), channel.bits);
    }
    return floats;
}

} // namespace

bool Ktx2Format::hasCodesOf8() const {
    if (block) return !hasHalfTexels(block->kind);
    return numbers == Ktx2Numbers::Codes &&
           std::all_of(channels.begin(), channels.end(), [](Ktx2Channel channel) { return channel.bits <= 8; });
}

std::optional<Ktx2Format> ktx2Format(uint32_t vkFormat) {
    if (vkFormat == 0) return std::nullopt;
    const std::optional<Ktx2Format> plain = plainFormat(vkFormat);
    return plain ? plain : blockFormat(vkFormat);
}

void decodeCodes(Ktx2Format const& format, std::span<const std::byte> bytes, std::span<std::byte> texels) {
    const size_t count = texels.size() / 4;
    for (size_t c = 0; c < 4; ++c) {
        const Ktx2Channel channel = format.channels[c];
        const std::byte fallback = c == 3 ? std::byte{ 255 } : std::byte{ 0 };
        const auto most = static_cast<uint32_t>((uint64_t{ 1 } << channel.bits) - 1);
        for (size_t i = 0; i < count; ++i) {
            std::byte& to = texels[4 * i + c];
            if (channel.bits == 8 && channel.first % 8 == 0) {
                to = bytes[i * format.texelBytes + channel.first / 8];
            } else if (channel.bits) { // rounded
                const auto value = static_cast<uint32_t>(bitsOf(&bytes[i * format.texelBytes], channel));
                to = static_cast<std::byte>((value * 255 * 2 + most) / (2 * most));
            } else {
                to = fallback;
            }
        }
    }
}

void decodeFloats(Ktx2Format const& format, std::span<const std::byte> bytes, bool isFull,
                  std::span<std::byte> texels) {
    const size_t size = isFull ? sizeof(float) : sizeof(uint16_t), count = texels.size() / (4 * size);
    for (size_t i = 0; i < count; ++i) {
        const std::array<float, 4> floats = floatsOf(format, &bytes[i * format.texelBytes]);
        std::byte* const to = &texels[i * 4 * size];
        for (size_t c = 0; c < 4; ++c) {
            const float value = std::isinf(floats[c]) ? std::copysign(3.4028235e38f, floats[c]) : floats[c];
            if (isFull) {
                std::memcpy(to + c * size, &value, size);
            } else {
                const uint16_t half = halfFromFloat(value);
                std::memcpy(to + c * size, &half, size);
            }
        }
    }
}

void widenHalves(std::span<const std::byte> halves, std::span<std::byte> floats) {
    for (size_t i = 0; i < halves.size() / 2; ++i) {
        uint16_t half;
        std::memcpy(&half, &halves[2 * i], sizeof(half));
        const float value = floatFromHalf(half);
        std::memcpy(&floats[4 * i], &value, sizeof(value));
    }
}

} // namespace filament_core::assets
