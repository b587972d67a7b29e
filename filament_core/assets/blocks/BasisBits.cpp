// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/blocks/BasisBits.h"

#include <algorithm>

namespace filament_core::assets::blocks {
namespace {

uint32_t reversedBits(uint32_t code, uint32_t length) {
    uint32_t reversed = 0;
    for (uint32_t i = 0; i < length; ++i) reversed |= (code >> i & 1) << (length - 1 - i);
    return reversed;
}

/// A symbol of the table of lengths: a run. What it repeats, and how often.
struct LengthRun {
    uint32_t bits, least;
    bool isOfZeros;
};
constexpr uint32_t kFirstRun = 17, kLengthSymbols = 21;
constexpr std::array<LengthRun, 4> kLengthRuns{ { { 3, 3, true }, { 7, 11, true }, { 2, 3, false }, { 7, 7, false } } };

/// Fills `lengths`. Returns whether they are complete and no more.
bool takeLengths(BasisHuffman const& table, BasisBits& bits, std::span<uint8_t> lengths) {
    for (size_t at = 0; at < lengths.size();) {
        const uint32_t symbol = table.take(bits);
        if (symbol >= kLengthSymbols || bits.hasEnded()) return false;
        if (symbol < kFirstRun) {
            lengths[at++] = static_cast<uint8_t>(symbol);
            continue;
        }
        LengthRun const& run = kLengthRuns[symbol - kFirstRun];
        const uint32_t count = bits.take(run.bits) + run.least;
        const uint8_t repeated = run.isOfZeros || at == 0 ? uint8_t{ 0 } : lengths[at - 1];
        if (count > lengths.size() - at || (!run.isOfZeros && repeated == 0)) return false;
        std::fill_n(lengths.begin() + static_cast<ptrdiff_t>(at), count, repeated);
        at += count;
    }
    return true;
}

} // namespace

uint32_t BasisBits::takeVariable(uint32_t width) {
    uint32_t value = 0;
    for (uint32_t shift = 0; shift < 32; shift += width) {
        const uint32_t group = take(width + 1);
        value |= (group & ((1u << width) - 1)) << shift;
        if (group >> width == 0) break;
    }
    return value;
}

bool BasisHuffman::read(BasisBits& bits) {
    constexpr std::array<uint8_t, kLengthSymbols> kOrder{ 17, 18, 19, 20, 0,  8, 7,  9, 6,  10, 5,
                                                          11, 4,  12, 3,  13, 2, 14, 1, 15, 16 };
    const uint32_t symbols = bits.take(14), lengthSymbols = bits.take(5);
    if (symbols == 0) return build({}) && !bits.hasEnded();
    if (lengthSymbols < 1 || lengthSymbols > kLengthSymbols) return false;
    std::array<uint8_t, kLengthSymbols> lengthsOfLengths{};
    for (uint32_t i = 0; i < lengthSymbols; ++i) lengthsOfLengths[kOrder[i]] = static_cast<uint8_t>(bits.take(3));
    BasisHuffman ofLengths;
    if (!ofLengths.build(lengthsOfLengths)) return false;
    std::vector<uint8_t> lengths(symbols);
    return takeLengths(ofLengths, bits, lengths) && build(lengths) && !bits.hasEnded();
}

bool BasisHuffman::build(std::span<const uint8_t> lengths) {
    std::array<uint32_t, kMaxLength + 2> counts{};
    for (const uint8_t length : lengths) ++counts[length];
    counts[0] = 0;
    uint64_t room = 0;
    for (uint32_t length = 1; length <= kMaxLength; ++length) {
        mFirstCode[length + 1] = (mFirstCode[length] + counts[length]) << 1;
        mFirstSymbol[length + 1] = mFirstSymbol[length] + counts[length];
        room += uint64_t{ counts[length] } << (kMaxLength - length);
    }
    const uint32_t used = mFirstSymbol[kMaxLength + 1];
    if (room > 1u << kMaxLength || (room < 1u << kMaxLength && used > 1)) return false;
    mSymbols.resize(used);
    mShort.assign(size_t{ 1 } << kShortBits, {});
    std::array<uint32_t, kMaxLength + 2> next = mFirstSymbol;
    for (size_t symbol = 0; symbol < lengths.size(); ++symbol) {
        const uint32_t length = lengths[symbol];
        if (length == 0) continue;
        const uint32_t at = next[length]++;
        mSymbols[at] = static_cast<uint16_t>(symbol);
        if (length > kShortBits) continue;
        const uint32_t code = reversedBits(mFirstCode[length] + at - mFirstSymbol[length], length);
        for (size_t i = code; i < mShort.size(); i += size_t{ 1 } << length)
            mShort[i] = { static_cast<uint16_t>(symbol), static_cast<uint8_t>(length) };
    }
    return true;
}

uint32_t BasisHuffman::take(BasisBits& bits) const {
    if (mShort.empty()) return kNoSymbol;
    const Short known = mShort[bits.peek(kShortBits)];
    if (known.length) {
        bits.skip(known.length);
        return known.symbol;
    }
    const uint32_t all = bits.peek(kMaxLength);
    uint32_t code = 0;
    for (uint32_t length = 1; length <= kMaxLength; ++length) {
        code = code << 1 | (all >> (length - 1) & 1);
        const uint32_t index = mFirstSymbol[length] + code - mFirstCode[length];
        if (code >= mFirstCode[length] && index < mFirstSymbol[length + 1]) {
            bits.skip(length);
            return mSymbols[index];
        }
    }
    return kNoSymbol;
}

} // namespace filament_core::assets::blocks
