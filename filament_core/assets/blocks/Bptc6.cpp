// SPDX-License-Identifier: Apache-2.0
// BC6H: Khronos Data Format Specification 1.3, chapter 20.
#include "filament_core/assets/blocks/BlockTexels.h"
#include "filament_core/assets/blocks/BptcPartitions.h"

#include <algorithm>
#include <string_view>

namespace filament_core::assets::blocks {
namespace {

/// Some bits of a value, as they follow in the block.
struct Bc6Field {
    uint8_t channel, end;  ///< red, green, blue; w, x, y, z
    uint8_t lowest, count; ///< bits of the value
    bool isReversed;       ///< the highest bit comes first
};

struct Bc6Mode {
    bool isDelta = false;            ///< all ends but the first are differences to it
    uint8_t subsets = 0;             ///< 0: reserved
    uint8_t bits = 0;                ///< of the first end, and where there are no differences of all
    std::array<uint8_t, 3> widths{}; ///< of the others, by channel
    uint8_t fieldCount = 0;
    std::array<Bc6Field, 24> fields{};
};

constexpr uint8_t digitsAt(std::string_view text, size_t& at) {
    uint8_t value = 0;
    for (; at < text.size() && text[at] >= '0' && text[at] <= '9'; ++at)
        value = static_cast<uint8_t>(value * 10 + (text[at] - '0'));
    return value;
}

/// `layout` as the specification's table lists the bits behind the mode, from the lowest on: "rw9:0" are the bits of
/// red of end w from 0 to 9, "rw10:15" those from 15 to 10, and "gy4" is one bit.
constexpr Bc6Mode bc6Mode(bool isDelta, uint8_t subsets, uint8_t bits, std::array<uint8_t, 3> widths,
                          std::string_view layout) {
    Bc6Mode mode{ isDelta, subsets, bits, widths, 0, {} };
    for (size_t at = 0; at < layout.size(); ++at) {
        const char channel = layout[at], end = layout[at + 1];
        at += 2;
        const uint8_t first = digitsAt(layout, at);
        uint8_t last = first;
        if (at < layout.size() && layout[at] == ':') last = digitsAt(layout, ++at);
        mode.fields[mode.fieldCount++] = {
            .channel = static_cast<uint8_t>(channel == 'r'   ? 0
                                            : channel == 'g' ? 1
                                                             : 2),
            .end = static_cast<uint8_t>(end == 'w' ? 0 : end - 'w'),
            .lowest = std::min(first, last),
            .count = static_cast<uint8_t>((first > last ? first - last : last - first) + 1),
            .isReversed = last > first,
        };
    }
    return mode;
}

/// By the number in the two or five lowest bits.
constexpr std::array<Bc6Mode, 32> bc6Modes() {
    std::array<Bc6Mode, 32> modes{};
    modes[0b00000] = bc6Mode(true, 2, 10, { 5, 5, 5 },
                             "gy4 by4 bz4 rw9:0 gw9:0 bw9:0 rx4:0 gz4 gy3:0 gx4:0 bz0 gz3:0 bx4:0 bz1 by3:0 ry4:0 bz2 "
                             "rz4:0 bz3");
    modes[0b00001] =
            bc6Mode(true, 2, 7, { 6, 6, 6 },
                    "gy5 gz4 gz5 rw6:0 bz0 bz1 by4 gw6:0 by5 bz2 gy4 bw6:0 bz3 bz5 bz4 rx5:0 gy3:0 gx5:0 gz3:0 "
                    "bx5:0 by3:0 ry5:0 rz5:0");
    modes[0b00010] = bc6Mode(true, 2, 11, { 5, 4, 4 },
                             "rw9:0 gw9:0 bw9:0 rx4:0 rw10 gy3:0 gx3:0 gw10 bz0 gz3:0 bx3:0 bw10 bz1 by3:0 ry4:0 bz2 "
                             "rz4:0 bz3");
    modes[0b00110] = bc6Mode(true, 2, 11, { 4, 5, 4 },
                             "rw9:0 gw9:0 bw9:0 rx3:0 rw10 gz4 gy3:0 gx4:0 gw10 gz3:0 bx3:0 bw10 bz1 by3:0 ry3:0 bz0 "
                             "bz2 rz3:0 gy4 bz3");
    modes[0b01010] = bc6Mode(true, 2, 11, { 4, 4, 5 },
                             "rw9:0 gw9:0 bw9:0 rx3:0 rw10 by4 gy3:0 gx3:0 gw10 bz0 gz3:0 bx4:0 bw10 by3:0 ry3:0 bz1 "
                             "bz2 rz3:0 bz4 bz3");
    modes[0b01110] = bc6Mode(true, 2, 9, { 5, 5, 5 },
                             "rw8:0 by4 gw8:0 gy4 bw8:0 bz4 rx4:0 gz4 gy3:0 gx4:0 bz0 gz3:0 bx4:0 bz1 by3:0 ry4:0 bz2 "
                             "rz4:0 bz3");
    modes[0b10010] = bc6Mode(true, 2, 8, { 6, 5, 5 },
                             "rw7:0 gz4 by4 gw7:0 bz2 gy4 bw7:0 bz3 bz4 rx5:0 gy3:0 gx4:0 bz0 gz3:0 bx4:0 bz1 by3:0 "
                             "ry5:0 rz5:0");
    modes[0b10110] = bc6Mode(true, 2, 8, { 5, 6, 5 },
                             "rw7:0 bz0 by4 gw7:0 gy5 gy4 bw7:0 gz5 bz4 rx4:0 gz4 gy3:0 gx5:0 gz3:0 bx4:0 bz1 by3:0 "
                             "ry4:0 bz2 rz4:0 bz3");
    modes[0b11010] = bc6Mode(true, 2, 8, { 5, 5, 6 },
                             "rw7:0 bz1 by4 gw7:0 by5 gy4 bw7:0 bz5 bz4 rx4:0 gz4 gy3:0 gx4:0 bz0 gz3:0 bx5:0 by3:0 "
                             "ry4:0 bz2 rz4:0 bz3");
    modes[0b11110] =
            bc6Mode(false, 2, 6, { 6, 6, 6 },
                    "rw5:0 gz4 bz0 bz1 by4 gw5:0 gy5 by5 bz2 gy4 bw5:0 gz5 bz3 bz5 bz4 rx5:0 gy3:0 gx5:0 gz3:0 "
                    "bx5:0 by3:0 ry5:0 rz5:0");
    modes[0b00011] = bc6Mode(false, 1, 10, { 10, 10, 10 }, "rw9:0 gw9:0 bw9:0 rx9:0 gx9:0 bx9:0");
    modes[0b00111] = bc6Mode(true, 1, 11, { 9, 9, 9 }, "rw9:0 gw9:0 bw9:0 rx8:0 rw10 gx8:0 gw10 bx8:0 bw10");
    modes[0b01011] = bc6Mode(true, 1, 12, { 8, 8, 8 }, "rw9:0 gw9:0 bw9:0 rx7:0 rw10:11 gx7:0 gw10:11 bx7:0 bw10:11");
    modes[0b01111] = bc6Mode(true, 1, 16, { 4, 4, 4 }, "rw9:0 gw9:0 bw9:0 rx3:0 rw10:15 gx3:0 gw10:15 bx3:0 bw10:15");
    return modes;
}
constexpr std::array<Bc6Mode, 32> kBc6Modes = bc6Modes();

/// By end, then channel.
using Bc6Ends = std::array<std::array<int32_t, 3>, 4>;

int32_t signExtended(int32_t value, uint32_t bits) {
    const int32_t sign = 1 << (bits - 1);
    return ((value & ((1 << bits) - 1)) ^ sign) - sign;
}

Bc6Ends takeBc6Ends(Bc6Mode const& mode, BlockBits& bits) {
    Bc6Ends ends{};
    for (uint32_t i = 0; i < mode.fieldCount; ++i) {
        Bc6Field const& field = mode.fields[i];
        int32_t& value = ends[field.end][field.channel];
        if (!field.isReversed) {
            value |= static_cast<int32_t>(bits.take(field.count)) << field.lowest;
            continue;
        }
        for (int bit = field.lowest + field.count - 1; bit >= field.lowest; --bit)
            value |= static_cast<int32_t>(bits.take(1)) << bit;
    }
    return ends;
}

/// "If the mode has a transformed endpoint": differences become values.
void resolveEnds(Bc6Mode const& mode, bool isSigned, Bc6Ends& ends) {
    for (size_t c = 0; c < 3; ++c) {
        int32_t& base = ends[0][c];
        if (isSigned) base = signExtended(base, mode.bits);
        for (size_t e = 1; e < 2u * mode.subsets; ++e) {
            int32_t& value = ends[e][c];
            if (mode.isDelta || isSigned) value = signExtended(value, mode.widths[c]);
            if (!mode.isDelta) continue;
            value = (value + base) & ((1 << mode.bits) - 1);
            if (isSigned) value = signExtended(value, mode.bits);
        }
    }
}

/// To 16 bits, or 15 and a sign.
int32_t unquantizedBc6(int32_t value, uint32_t bits, bool isSigned) {
    if (!isSigned) {
        if (bits >= 15 || value == 0) return value;
        if (value == (1 << bits) - 1) return 0xFFFF;
        return ((value << 16) + 0x8000) >> bits;
    }
    if (bits >= 16 || value == 0) return std::max(value, -0x7FFF); // the least number would be minus infinity
    const int32_t size = value < 0 ? -value : value;
    const int32_t wide = size >= (1 << (bits - 1)) - 1 ? 0x7FFF : ((size << 15) + 0x4000) >> (bits - 1);
    return value < 0 ? -wide : wide;
}

uint16_t halfFrom(int32_t value, bool isSigned) {
    if (!isSigned) return static_cast<uint16_t>(value * 31 >> 6);
    if (value < 0) return static_cast<uint16_t>(0x8000 | -value * 31 >> 5);
    return static_cast<uint16_t>(value * 31 >> 5);
}

uint16_t halfBetween(int32_t first, int32_t second, int32_t weight, bool isSigned) {
    return halfFrom((first * (64 - weight) + second * weight + 32) >> 6, isSigned);
}

void decodeBc6Block(const std::byte* block, bool isSigned, TexelHalf* texels) {
    BlockBits bits(block);
    const uint32_t low = bits.at(0, 2);
    const uint32_t code = low < 2 ? low : bits.at(0, 5);
    Bc6Mode const& mode = kBc6Modes[code];
    if (mode.subsets == 0) {
        std::fill_n(texels, 16, TexelHalf{});
        return;
    }
    bits.skip(low < 2 ? 2 : 5);
    Bc6Ends ends = takeBc6Ends(mode, bits);
    resolveEnds(mode, isSigned, ends);
    for (auto& end : ends) {
        for (int32_t& value : end) value = unquantizedBc6(value, mode.bits, isSigned);
    }
    const uint32_t partition = mode.subsets == 2 ? bits.take(5) : 0;
    const uint32_t pattern = mode.subsets == 2 ? kTwoSubsets[partition] : 0;
    const uint32_t anchor = mode.subsets == 2 ? kAnchorOfTwo[partition] : 0;
    const uint32_t width = mode.subsets == 2 ? 3 : 4;
    for (uint32_t i = 0; i < 16; ++i) {
        const uint32_t index = bits.take(i == 0 || i == anchor ? width - 1 : width);
        const int32_t weight = bptcWeights(width)[index];
        const uint32_t subset = pattern >> (2 * i) & 3;
        auto const &first = ends[2 * subset], &second = ends[2 * subset + 1];
        texels[i] = { halfBetween(first[0], second[0], weight, isSigned),
                      halfBetween(first[1], second[1], weight, isSigned),
                      halfBetween(first[2], second[2], weight, isSigned), TexelHalf::kOne };
    }
}

} // namespace

void decodeBc6(const std::byte* block, TexelHalf* texels) { decodeBc6Block(block, false, texels); }

void decodeBc6Signed(const std::byte* block, TexelHalf* texels) { decodeBc6Block(block, true, texels); }

} // namespace filament_core::assets::blocks
