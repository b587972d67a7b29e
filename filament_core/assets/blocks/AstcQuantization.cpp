// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/blocks/AstcQuantization.h"

#include <algorithm>
#include <string_view>

namespace filament_core::assets::blocks {
namespace {

/// Five trits in 8 bits.
constexpr std::array<uint8_t, 5> unpackedTrits(uint32_t t) {
    const auto bit = [](uint32_t v, uint32_t i) { return v >> i & 1; };
    std::array<uint32_t, 5> trits{};
    uint32_t c = t & 31;
    if ((t >> 2 & 7) == 7) {
        c = (t >> 5 & 7) << 2 | (t & 3);
        trits[4] = trits[3] = 2;
    } else if ((t >> 5 & 3) == 3) {
        trits[4] = 2, trits[3] = bit(t, 7);
    } else {
        trits[4] = bit(t, 7), trits[3] = t >> 5 & 3;
    }
    if ((c & 3) == 3) {
        trits[2] = 2, trits[1] = bit(c, 4), trits[0] = bit(c, 3) << 1 | (bit(c, 2) & ~bit(c, 3));
    } else if ((c >> 2 & 3) == 3) {
        trits[2] = trits[1] = 2, trits[0] = c & 3;
    } else {
        trits[2] = bit(c, 4), trits[1] = c >> 2 & 3, trits[0] = bit(c, 1) << 1 | (bit(c, 0) & ~bit(c, 1));
    }
    std::array<uint8_t, 5> out{};
    for (size_t i = 0; i < 5; ++i) out[i] = static_cast<uint8_t>(trits[i] & 3);
    return out;
}

/// Three quints in 7 bits.
constexpr std::array<uint8_t, 3> unpackedQuints(uint32_t q) {
    const auto bit = [](uint32_t v, uint32_t i) { return v >> i & 1; };
    std::array<uint32_t, 3> quints{};
    if ((q >> 1 & 3) == 3 && (q >> 5 & 3) == 0) {
        quints[2] = bit(q, 0) << 2 | (bit(q, 4) & ~bit(q, 0)) << 1 | (bit(q, 3) & ~bit(q, 0));
        quints[1] = quints[0] = 4;
    } else {
        uint32_t c = q & 31;
        if ((q >> 1 & 3) == 3) {
            quints[2] = 4;
            c = (q >> 3 & 3) << 3 | (~(q >> 5) & 3) << 1 | bit(q, 0);
        } else {
            quints[2] = q >> 5 & 3;
        }
        if ((c & 7) == 5)
            quints[1] = 4, quints[0] = c >> 3 & 3;
        else
            quints[1] = c >> 3 & 3, quints[0] = c & 7;
    }
    return { static_cast<uint8_t>(quints[0]), static_cast<uint8_t>(quints[1]), static_cast<uint8_t>(quints[2]) };
}

constexpr auto kTrits = [] {
    std::array<std::array<uint8_t, 5>, 256> table{};
    for (uint32_t i = 0; i < 256; ++i) table[i] = unpackedTrits(i);
    return table;
}();
constexpr auto kQuints = [] {
    std::array<std::array<uint8_t, 3>, 128> table{};
    for (uint32_t i = 0; i < 128; ++i) table[i] = unpackedQuints(i);
    return table;
}();

/// Packs of numbers: their low bits, and between them the bits of all their trits or quints. `parts` is how many of
/// those follow each number.
template <size_t N, class Table>
void takePacks(uint32_t lowBits, std::array<uint8_t, N> const& parts, Table const& table, BlockBits bits,
               std::span<uint8_t> numbers) {
    for (size_t at = 0; at < numbers.size(); at += N) {
        std::array<uint32_t, N> low;
        uint32_t packed = 0, taken = 0;
        for (size_t i = 0; i < N; ++i) {
            low[i] = bits.take(lowBits);
            packed |= bits.take(parts[i]) << taken;
            taken += parts[i];
        }
        for (size_t i = 0; i < std::min(N, numbers.size() - at); ++i)
            numbers[at + i] = static_cast<uint8_t>(uint32_t{ table[packed][i] } << lowBits | low[i]);
    }
}

/// Tables "unquantization parameters": the pattern of B from its highest bit ('b' is the second bit of the number, '0'
/// a zero) and C, by range.
struct Unquantization {
    uint8_t range;
    std::string_view pattern;
    uint16_t factor;
};
constexpr std::array<Unquantization, 11> kOfColors{ { { 4, "000000000", 204 },
                                                      { 6, "000000000", 113 },
                                                      { 7, "b000b0bb0", 93 },
                                                      { 9, "b0000bb00", 54 },
                                                      { 10, "cb000cbcb", 44 },
                                                      { 12, "cb0000cbc", 26 },
                                                      { 13, "dcb000dcb", 22 },
                                                      { 15, "dcb0000dc", 13 },
                                                      { 16, "edcb000ed", 11 },
                                                      { 18, "edcb0000e", 6 },
                                                      { 19, "fedcb000f", 5 } } };
constexpr std::array<Unquantization, 5> kOfWeights{
    { { 4, "0000000", 50 }, { 6, "0000000", 28 }, { 7, "b000b0b", 23 }, { 9, "b0000b0", 13 }, { 10, "cb000cb", 11 } }
};

/// ((D * C + B) ^ A), its lowest bit the highest, as the specification says; `width` is that of the pattern.
uint32_t unquantized(Unquantization const& how, uint32_t number, uint32_t lowBits, uint32_t width) {
    uint32_t b = 0;
    for (const char letter : how.pattern) b = b << 1 | (letter == '0' ? 0 : number >> (letter - 'a') & 1);
    const uint32_t a = number & 1 ? (1u << width) - 1 : 0;
    const uint32_t t = ((number >> lowBits) * how.factor + b) ^ a;
    return (a & 1u << (width - 2)) | t >> 2;
}

/// `value` of `bits` bits, repeated to `width`.
uint32_t repeated(uint32_t value, uint32_t bits, uint32_t width) {
    uint32_t result = 0;
    for (auto shift = static_cast<int>(width - bits);; shift -= static_cast<int>(bits)) {
        result |= shift >= 0 ? value << shift : value >> -shift;
        if (shift <= 0) return result;
    }
}

uint32_t levelsOf(AstcRange range) { return (range.trits ? 3u : range.quints ? 5u : 1u) << range.bits; }

std::array<uint8_t, 256> colorsOf(uint32_t index) {
    const AstcRange range = kAstcRanges[index];
    const auto* const how = std::find_if(kOfColors.begin(), kOfColors.end(),
                                         [index](Unquantization const& entry) { return entry.range == index; });
    std::array<uint8_t, 256> colors{};
    for (uint32_t i = 0; i < levelsOf(range); ++i) {
        colors[i] = static_cast<uint8_t>(how == kOfColors.end() ? repeated(i, range.bits, 8)
                                                                : unquantized(*how, i, range.bits, 9));
    }
    return colors;
}

std::array<uint8_t, 32> weightsOf(uint32_t index) {
    constexpr std::array<uint8_t, 3> kOfTrit{ 0, 32, 63 };
    constexpr std::array<uint8_t, 5> kOfQuint{ 0, 16, 32, 47, 63 };
    const AstcRange range = kAstcRanges[index];
    const auto* const how = std::find_if(kOfWeights.begin(), kOfWeights.end(),
                                         [index](Unquantization const& entry) { return entry.range == index; });
    std::array<uint8_t, 32> weights{};
    for (uint32_t i = 0; i < levelsOf(range); ++i) {
        uint32_t weight = 0;
        if (how != kOfWeights.end())
            weight = unquantized(*how, i, range.bits, 7);
        else if (range.bits)
            weight = repeated(i, range.bits, 6);
        else
            weight = range.trits ? kOfTrit[i] : kOfQuint[i];
        weights[i] = static_cast<uint8_t>(weight > 32 ? weight + 1 : weight);
    }
    return weights;
}

} // namespace

uint32_t astcSequenceBits(AstcRange range, uint32_t count) {
    return range.bits * count + (range.trits ? (8 * count + 4) / 5 : 0) + (range.quints ? (7 * count + 2) / 3 : 0);
}

void takeAstcSequence(AstcRange range, BlockBits bits, std::span<uint8_t> numbers) {
    if (range.trits) return takePacks(range.bits, std::array<uint8_t, 5>{ 2, 2, 1, 2, 1 }, kTrits, bits, numbers);
    if (range.quints) return takePacks(range.bits, std::array<uint8_t, 3>{ 3, 2, 2 }, kQuints, bits, numbers);
    for (uint8_t& number : numbers) number = static_cast<uint8_t>(bits.take(range.bits));
}

std::array<uint8_t, 256> const& astcColorsOf(uint32_t rangeIndex) {
    static const auto kTables = [] {
        std::array<std::array<uint8_t, 256>, kAstcRanges.size()> tables{};
        for (uint32_t i = kAstcRangeOf6; i < tables.size(); ++i) tables[i] = colorsOf(i);
        return tables;
    }();
    return kTables[rangeIndex];
}

std::array<uint8_t, 32> const& astcWeightsOf(uint32_t rangeIndex) {
    static const auto kTables = [] {
        std::array<std::array<uint8_t, 32>, kAstcRangeOf32 + 1> tables{};
        for (uint32_t i = 0; i < tables.size(); ++i) tables[i] = weightsOf(i);
        return tables;
    }();
    return kTables[rangeIndex];
}

} // namespace filament_core::assets::blocks
