// SPDX-License-Identifier: Apache-2.0
// BC4 and BC5: Khronos Data Format Specification 1.3, chapter 19.
#include "base/math/Half.h"
#include "filament_core/assets/blocks/BlockTexels.h"

#include <algorithm>
#include <array>

namespace filament_core::assets::blocks {
namespace {

constexpr uint32_t kIndexBits = 3;

/// Calls value(i, 7) or value(i, 5) for the interpolated entries, i parts of the second end among 7 or 5 parts.
template <class T, class Value>
std::array<T, 8> entriesBetween(T first, T second, bool hasSix, T least, T most, Value const& value) {
    std::array<T, 8> entries{ first, second };
    const int parts = hasSix ? 7 : 5;
    for (int i = 1; i < parts; ++i) entries[static_cast<size_t>(i) + 1] = value(i, parts);
    if (!hasSix) entries[6] = least, entries[7] = most;
    return entries;
}

void halvesOfChannel(const std::byte* block, uint16_t* halves) {
    constexpr int kMost = 127; // -128 is -1 as well
    const auto endOf = [](std::byte byte) { return std::max<int>(static_cast<int8_t>(byte), -kMost); };
    const int first = endOf(block[0]), second = endOf(block[1]);
    const bool hasSix = static_cast<int8_t>(block[0]) > static_cast<int8_t>(block[1]);
    const auto half = [](int numerator, int parts) {
        return halfFromFloat(static_cast<float>(numerator) / static_cast<float>(parts * kMost));
    };
    const auto entries =
            entriesBetween<uint16_t>(half(first, 1), half(second, 1), hasSix, half(-kMost, 1), half(kMost, 1),
                                     [&](int i, int parts) { return half((parts - i) * first + i * second, parts); });
    uint64_t indices = loadLittle(block + 2, 6);
    for (uint32_t i = 0; i < 16; ++i, indices >>= kIndexBits) halves[i] = entries[indices & 7];
}

} // namespace

void decodeChannel(const std::byte* block, uint8_t* codes) {
    const int first = std::to_integer<int>(block[0]), second = std::to_integer<int>(block[1]);
    const auto entries = entriesBetween<uint8_t>(
            static_cast<uint8_t>(first), static_cast<uint8_t>(second), first > second, 0, 255, [&](int i, int parts) {
                return static_cast<uint8_t>((2 * ((parts - i) * first + i * second) + parts) / (2 * parts)); // rounded
            });
    uint64_t indices = loadLittle(block + 2, 6);
    for (uint32_t i = 0; i < 16; ++i, indices >>= kIndexBits) codes[i] = entries[indices & 7];
}

void decodeBc4(const std::byte* block, Texel8* texels) {
    std::array<uint8_t, 16> red;
    decodeChannel(block, red.data());
    for (uint32_t i = 0; i < 16; ++i) texels[i] = { red[i], 0, 0, 255 };
}

void decodeBc5(const std::byte* block, Texel8* texels) {
    std::array<uint8_t, 16> red, green;
    decodeChannel(block, red.data());
    decodeChannel(block + 8, green.data());
    for (uint32_t i = 0; i < 16; ++i) texels[i] = { red[i], green[i], 0, 255 };
}

void decodeBc4Signed(const std::byte* block, TexelHalf* texels) {
    std::array<uint16_t, 16> red;
    halvesOfChannel(block, red.data());
    for (uint32_t i = 0; i < 16; ++i) texels[i] = { red[i], 0, 0, TexelHalf::kOne };
}

void decodeBc5Signed(const std::byte* block, TexelHalf* texels) {
    std::array<uint16_t, 16> red, green;
    halvesOfChannel(block, red.data());
    halvesOfChannel(block + 8, green.data());
    for (uint32_t i = 0; i < 16; ++i) texels[i] = { red[i], green[i], 0, TexelHalf::kOne };
}

} // namespace filament_core::assets::blocks
