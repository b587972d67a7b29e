// SPDX-License-Identifier: Apache-2.0
// ETC1 and ETC2: Khronos Data Format Specification 1.3, chapters 21 and 22.
#include "filament_core/assets/blocks/BlockTexels.h"

#include <algorithm>
#include <array>

namespace filament_core::assets::blocks {
namespace {

struct IntColor {
    int32_t r = 0, g = 0, b = 0;
};

/// Sums of a colour and a modifier of all channels, clamped.
Texel8 modified(IntColor const& color, int32_t by) {
    return { clampedTo8(color.r + by), clampedTo8(color.g + by), clampedTo8(color.b + by), 255 };
}

/// Table "distances".
constexpr std::array<int32_t, 8> kDistances{ 3, 6, 11, 16, 23, 32, 41, 64 };

/// A block: bits are numbered as in the specification, 63 is the highest of the first byte.
struct EtcBits {
    uint64_t bits = 0;

    uint32_t at(uint32_t highest, uint32_t lowest) const {
        return static_cast<uint32_t>(bits >> lowest) & ((1u << (highest - lowest + 1)) - 1);
    }
    bool isSet(uint32_t bit) const { return (bits >> bit & 1) != 0; }
    /// The pixel index of a texel: 0 to 3. Texels are numbered by columns.
    uint32_t index(uint32_t x, uint32_t y) const {
        const uint32_t texel = 4 * x + y;
        return static_cast<uint32_t>(bits >> (16 + texel) & 1) << 1 | static_cast<uint32_t>(bits >> texel & 1);
    }
};

int32_t from4(uint32_t value) { return static_cast<int32_t>(value * 17); }
int32_t from5(uint32_t value) { return static_cast<int32_t>(value << 3 | value >> 2); }
int32_t from6(uint32_t value) { return static_cast<int32_t>(value << 2 | value >> 4); }
int32_t from7(uint32_t value) { return static_cast<int32_t>(value << 1 | value >> 6); }

constexpr uint32_t kTransparentIndex = 2; ///< where a block is not opaque

/// `hasHoles`: index 2 is transparent.
void paint(EtcBits block, std::array<Texel8, 4> const& colors, bool hasHoles, Texel8* texels) {
    for (uint32_t y = 0; y < 4; ++y) {
        for (uint32_t x = 0; x < 4; ++x) {
            const uint32_t index = block.index(x, y);
            texels[4 * y + x] = hasHoles && index == kTransparentIndex ? Texel8{ 0, 0, 0, 0 } : colors[index];
        }
    }
}

/// Two halves of one colour each, beside or above each other.
void paintHalves(EtcBits block, std::array<IntColor, 2> const& bases, bool hasHoles, Texel8* texels) {
    std::array<std::array<Texel8, 4>, 2> colors;
    for (uint32_t half = 0; half < 2; ++half) {
        auto const& sizes = kEtcIntensities[half ? block.at(36, 34) : block.at(39, 37)];
        const int32_t small = hasHoles ? 0 : sizes[0], large = sizes[1];
        colors[half] = { modified(bases[half], small), modified(bases[half], large), modified(bases[half], -small),
                         modified(bases[half], -large) };
    }
    const bool isStacked = block.isSet(32);
    for (uint32_t y = 0; y < 4; ++y) {
        for (uint32_t x = 0; x < 4; ++x) {
            const uint32_t index = block.index(x, y);
            texels[4 * y + x] = hasHoles && index == kTransparentIndex ? Texel8{ 0, 0, 0, 0 }
                                                                       : colors[(isStacked ? y : x) / 2][index];
        }
    }
}

void paintT(EtcBits block, bool hasHoles, Texel8* texels) {
    const IntColor first{ from4(block.at(60, 59) << 2 | block.at(57, 56)), from4(block.at(55, 52)),
                          from4(block.at(51, 48)) };
    const IntColor second{ from4(block.at(47, 44)), from4(block.at(43, 40)), from4(block.at(39, 36)) };
    const int32_t distance = kDistances[block.at(35, 34) << 1 | block.at(32, 32)];
    paint(block, { modified(first, 0), modified(second, distance), modified(second, 0), modified(second, -distance) },
          hasHoles, texels);
}

void paintH(EtcBits block, bool hasHoles, Texel8* texels) {
    const IntColor first{ from4(block.at(62, 59)), from4(block.at(58, 56) << 1 | block.at(52, 52)),
                          from4(block.at(51, 51) << 3 | block.at(49, 47)) };
    const IntColor second{ from4(block.at(46, 43)), from4(block.at(42, 39)), from4(block.at(38, 35)) };
    const auto number = [](IntColor const& color) { return color.r << 16 | color.g << 8 | color.b; };
    const uint32_t order = number(first) >= number(second) ? 1 : 0; // the third bit is in the order of the colours
    const int32_t distance = kDistances[block.at(34, 34) << 2 | block.at(32, 32) << 1 | order];
    paint(block,
          { modified(first, distance), modified(first, -distance), modified(second, distance),
            modified(second, -distance) },
          hasHoles, texels);
}

void paintPlane(EtcBits block, Texel8* texels) {
    const IntColor origin{ from6(block.at(62, 57)), from7(block.at(56, 56) << 6 | block.at(54, 49)),
                           from6(block.at(48, 48) << 5 | block.at(44, 43) << 3 | block.at(41, 39)) };
    const IntColor right{ from6(block.at(38, 34) << 1 | block.at(32, 32)), from7(block.at(31, 25)),
                          from6(block.at(24, 19)) };
    const IntColor below{ from6(block.at(18, 13)), from7(block.at(12, 6)), from6(block.at(5, 0)) };
    for (int32_t y = 0; y < 4; ++y) {
        for (int32_t x = 0; x < 4; ++x) {
            const auto channel = [&](int32_t o, int32_t h, int32_t v) {
                return clampedTo8((x * (h - o) + y * (v - o) + 4 * o + 2) >> 2);
            };
            texels[4 * y + x] = { channel(origin.r, right.r, below.r), channel(origin.g, right.g, below.g),
                                  channel(origin.b, right.b, below.b), 255 };
        }
    }
}

/// A 5-bit value and a signed difference of 3 bits; outside 0 to 31 it is no colour, but names another mode.
int32_t sumAt(EtcBits block, uint32_t lowest) {
    const auto difference = static_cast<int32_t>(block.at(lowest + 2, lowest));
    return static_cast<int32_t>(block.at(lowest + 7, lowest + 3)) + (difference ^ 4) - 4;
}

bool isOutside(int32_t sum) { return sum < 0 || sum > 31; }

void decodeDifferential(EtcBits block, bool hasHoles, Texel8* texels) {
    const int32_t red = sumAt(block, 56), green = sumAt(block, 48), blue = sumAt(block, 40);
    if (isOutside(red)) return paintT(block, hasHoles, texels);
    if (isOutside(green)) return paintH(block, hasHoles, texels);
    if (isOutside(blue)) return paintPlane(block, texels);
    const auto second = [](int32_t sum) { return from5(static_cast<uint32_t>(sum)); };
    paintHalves(block,
                { IntColor{ from5(block.at(63, 59)), from5(block.at(55, 51)), from5(block.at(47, 43)) },
                  IntColor{ second(red), second(green), second(blue) } },
                hasHoles, texels);
}

} // namespace

void decodeEtc2Rgb(const std::byte* bytes, Texel8* texels) {
    const EtcBits block{ loadBig(bytes) };
    if (block.isSet(33)) return decodeDifferential(block, false, texels);
    paintHalves(block,
                { IntColor{ from4(block.at(63, 60)), from4(block.at(55, 52)), from4(block.at(47, 44)) },
                  IntColor{ from4(block.at(59, 56)), from4(block.at(51, 48)), from4(block.at(43, 40)) } },
                false, texels);
}

void decodeEtc2RgbA1(const std::byte* bytes, Texel8* texels) {
    const EtcBits block{ loadBig(bytes) };
    decodeDifferential(block, !block.isSet(33), texels);
}

void decodeEtc2Rgba(const std::byte* bytes, Texel8* texels) {
    decodeEtc2Rgb(bytes + 8, texels);
    std::array<uint8_t, 16> alphas;
    decodeEacAlpha(bytes, alphas.data());
    for (uint32_t i = 0; i < 16; ++i) texels[i].a = alphas[i];
}

} // namespace filament_core::assets::blocks
