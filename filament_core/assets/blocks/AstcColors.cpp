// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/blocks/AstcColors.h"

namespace filament_core::assets::blocks {
namespace {

using IntChannels = std::array<int32_t, 4>;

std::array<uint8_t, 4> clampedChannels(IntChannels const& color) {
    return { clampedTo8(color[0]), clampedTo8(color[1]), clampedTo8(color[2]), clampedTo8(color[3]) };
}

AstcEnds endsFrom(IntChannels const& first, IntChannels const& second) {
    return { clampedChannels(first), clampedChannels(second) };
}

/// Red and green, which are stored as twice their difference to blue.
IntChannels blueContracted(IntChannels const& color) {
    return { (color[0] + color[2]) >> 1, (color[1] + color[2]) >> 1, color[2], color[3] };
}

/// bit_transfer_signed: moves the highest bit of a difference to its base, and gives the difference its sign.
void transferBit(int32_t& difference, int32_t& base) {
    base = base >> 1 | (difference & 0x80);
    difference = difference >> 1 & 0x3F;
    if (difference & 0x20) difference -= 0x40;
}

/// Modes 8 and 12: the order of the sums says whether the colours are contracted.
AstcEnds directEnds(std::array<int32_t, 8> const& v) {
    const IntChannels first{ v[0], v[2], v[4], v[6] }, second{ v[1], v[3], v[5], v[7] };
    if (second[0] + second[1] + second[2] >= first[0] + first[1] + first[2]) return endsFrom(first, second);
    return endsFrom(blueContracted(second), blueContracted(first));
}

/// Modes 9 and 13: the sign of the differences does. Without alpha, its numbers are 255 and 0, already apart.
AstcEnds offsetEnds(std::array<int32_t, 8> v, bool hasAlpha) {
    for (size_t i = 0; i < (hasAlpha ? 8 : 6); i += 2) transferBit(v[i + 1], v[i]);
    const IntChannels base{ v[0], v[2], v[4], v[6] };
    const IntChannels sum{ v[0] + v[1], v[2] + v[3], v[4] + v[5], v[6] + v[7] };
    if (v[1] + v[3] + v[5] >= 0) return endsFrom(base, sum);
    return endsFrom(blueContracted(sum), blueContracted(base));
}

AstcEnds scaledEnds(std::array<int32_t, 8> const& v, int32_t firstAlpha, int32_t secondAlpha) {
    return endsFrom({ v[0] * v[3] >> 8, v[1] * v[3] >> 8, v[2] * v[3] >> 8, firstAlpha },
                    { v[0], v[1], v[2], secondAlpha });
}

} // namespace

AstcEnds astcEnds(uint32_t mode, const uint8_t* values) {
    std::array<int32_t, 8> v{ 0, 0, 0, 0, 0, 0, 255, 255 };
    for (uint32_t i = 0; i < endCountOf(mode); ++i) v[i] = values[i];
    switch (mode) {
    case 0: // luminance
        return endsFrom({ v[0], v[0], v[0], 255 }, { v[1], v[1], v[1], 255 });
    case 1: { // luminance, base and offset
        const int32_t first = v[0] >> 2 | (v[1] & 0xC0), second = first + (v[1] & 0x3F);
        return endsFrom({ first, first, first, 255 }, { second, second, second, 255 });
    }
    case 4: // luminance and alpha
        return endsFrom({ v[0], v[0], v[0], v[2] }, { v[1], v[1], v[1], v[3] });
    case 5: // luminance and alpha, base and offset
        transferBit(v[1], v[0]), transferBit(v[3], v[2]);
        return endsFrom({ v[0], v[0], v[0], v[2] }, { v[0] + v[1], v[0] + v[1], v[0] + v[1], v[2] + v[3] });
    case 6: // RGB, base and scale
        return scaledEnds(v, 255, 255);
    case 8:
    case 12: // RGB and RGBA
        return directEnds(v);
    case 9: // RGB, base and offset
        v[7] = 0;
        return offsetEnds(v, false);
    case 10: // RGB, base and scale, and two alphas
        return scaledEnds(v, v[4], v[5]);
    case 13: // RGBA, base and offset
        return offsetEnds(v, true);
    default:
        return {};
    }
}

} // namespace filament_core::assets::blocks
