// SPDX-License-Identifier: Apache-2.0
// BC1, BC2 and BC3: Khronos Data Format Specification 1.3, chapter 18.
#include "filament_core/assets/blocks/BlockTexels.h"

#include <array>

namespace filament_core::assets::blocks {
namespace {

enum class FourthColor : uint8_t { Interpolated, Black, Transparent };

/// The nearest code to numerator / (parts * most), a mean of `parts` values that are at most `most`.
uint8_t nearestCode(uint32_t numerator, uint32_t parts, uint32_t most) {
    const uint32_t denominator = parts * most;
    return static_cast<uint8_t>((2 * 255 * numerator + denominator) / (2 * denominator));
}

/// Red, green or blue of the four colours.
std::array<uint8_t, 4> channelOfColors(uint32_t first, uint32_t second, uint32_t most, bool hasThirds) {
    std::array<uint8_t, 4> codes{ nearestCode(first, 1, most), nearestCode(second, 1, most), 0, 0 };
    if (hasThirds) {
        codes[2] = nearestCode(2 * first + second, 3, most);
        codes[3] = nearestCode(first + 2 * second, 3, most);
    } else {
        codes[2] = nearestCode(first + second, 2, most);
    }
    return codes;
}

void decodeColors(const std::byte* block, FourthColor fourth, Texel8* texels) {
    const auto bits = static_cast<uint32_t>(loadLittle(block, 4));
    const uint32_t first = bits & 0xFFFF, second = bits >> 16;
    const bool hasThirds = fourth == FourthColor::Interpolated || first > second;
    const auto red = channelOfColors(first >> 11, second >> 11, 31, hasThirds);
    const auto green = channelOfColors(first >> 5 & 63, second >> 5 & 63, 63, hasThirds);
    const auto blue = channelOfColors(first & 31, second & 31, 31, hasThirds);
    std::array<Texel8, 4> colors;
    for (size_t i = 0; i < 4; ++i) colors[i] = { red[i], green[i], blue[i], 255 };
    if (!hasThirds && fourth == FourthColor::Transparent) colors[3].a = 0;
    auto indices = static_cast<uint32_t>(loadLittle(block + 4, 4));
    for (uint32_t i = 0; i < 16; ++i, indices >>= 2) texels[i] = colors[indices & 3];
}

} // namespace

void decodeBc1Rgb(const std::byte* block, Texel8* texels) { decodeColors(block, FourthColor::Black, texels); }

void decodeBc1Rgba(const std::byte* block, Texel8* texels) { decodeColors(block, FourthColor::Transparent, texels); }

void decodeBc2(const std::byte* block, Texel8* texels) {
    decodeColors(block + 8, FourthColor::Interpolated, texels);
    uint64_t alphas = loadLittle(block);
    for (uint32_t i = 0; i < 16; ++i, alphas >>= 4) texels[i].a = static_cast<uint8_t>((alphas & 15) * 17);
}

void decodeBc3(const std::byte* block, Texel8* texels) {
    decodeColors(block + 8, FourthColor::Interpolated, texels);
    std::array<uint8_t, 16> alphas;
    decodeChannel(block, alphas.data());
    for (uint32_t i = 0; i < 16; ++i) texels[i].a = alphas[i];
}

} // namespace filament_core::assets::blocks
