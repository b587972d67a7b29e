// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/blocks/Uastc.h"

#include "filament_core/assets/blocks/AstcColors.h"
#include "filament_core/assets/blocks/AstcPartition.h"
#include "filament_core/assets/blocks/AstcQuantization.h"
#include "filament_core/assets/blocks/BlockTexels.h"

#include <algorithm>
#include <span>

namespace filament_core::assets::blocks {
namespace {

constexpr uint32_t kNoMode = kUastcModes.size();

/// The mode of each value of the seven lowest bits.
constexpr auto kModeOfCode = [] {
    std::array<uint8_t, 128> modes{};
    for (uint32_t code = 0; code < modes.size(); ++code) {
        modes[code] = kNoMode;
        for (uint8_t i = 0; i < kUastcModes.size(); ++i) {
            if ((code & ((1u << kUastcModes[i].codeBits) - 1)) == kUastcModes[i].code) modes[code] = i;
        }
    }
    return modes;
}();

/// Subsets of the texels, and for each subset its first texel, whose weight has one bit less.
struct UastcPattern {
    std::array<uint8_t, 16> subsets{};
    std::array<bool, 16> isAnchor{ true };
};

constexpr UastcPattern uastcPattern(uint32_t subsets, uint32_t seed) {
    UastcPattern pattern;
    pattern.isAnchor[0] = false;
    const AstcPartition partition(subsets, seed, true);
    std::array<bool, 4> isFound{};
    for (uint32_t i = 0; i < 16; ++i) {
        const uint32_t subset = partition.at(i & 3, i >> 2);
        pattern.subsets[i] = static_cast<uint8_t>(subset);
        pattern.isAnchor[i] = !isFound[subset];
        isFound[subset] = true;
    }
    return pattern;
}

template <size_t N>
constexpr std::array<UastcPattern, N> patternsOf(uint32_t subsets, std::array<uint16_t, N> const& seeds) {
    std::array<UastcPattern, N> patterns;
    for (size_t i = 0; i < N; ++i) patterns[i] = uastcPattern(subsets, seeds[i]);
    return patterns;
}
constexpr auto kPatternsOfTwo = patternsOf(2, kUastcSeedsOfTwo);
constexpr auto kPatternsOfThree = patternsOf(3, kUastcSeedsOfThree);
constexpr auto kPatternsOfMode7 = patternsOf(2, kUastcSeedsOfMode7);
constexpr UastcPattern kWholeBlock{};

/// Null: there is no such pattern.
const UastcPattern* takePattern(uint32_t mode, BlockBits& bits) {
    const auto from = [&](auto const& patterns, uint32_t width) -> const UastcPattern* {
        const uint32_t index = bits.take(width);
        return index < patterns.size() ? &patterns[index] : nullptr;
    };
    if (kUastcModes[mode].subsets == 1) return &kWholeBlock;
    if (kUastcModes[mode].subsets == 3) return from(kPatternsOfThree, 4);
    return mode == 7 ? from(kPatternsOfMode7, 5) : from(kPatternsOfTwo, 5);
}

/// Groups of trits or quints as one number to the base 3 or 5: their high parts, then the low bits of all.
std::array<uint8_t, 18> takeUastcSequence(AstcRange range, uint32_t count, BlockBits& bits) {
    std::array<uint8_t, 18> numbers{};
    const uint32_t base = range.trits ? 3 : range.quints ? 5 : 1, most = range.trits ? 5 : 3;
    for (uint32_t at = 0; base > 1 && at < count; at += most) {
        const uint32_t group = std::min(most, count - at);
        uint32_t packed = bits.take(range.trits ? (8 * group + 4) / 5 : (7 * group + 2) / 3);
        for (uint32_t i = 0; i < group; ++i, packed /= base) numbers[at + i] = static_cast<uint8_t>(packed % base);
    }
    for (uint32_t i = 0; i < count; ++i)
        numbers[i] = static_cast<uint8_t>(uint32_t{ numbers[i] } << range.bits | bits.take(range.bits));
    return numbers;
}

AstcEnds endsFromNumbers(UastcChannels channels, const uint8_t* v) {
    if (channels == UastcChannels::LuminanceAlpha) return { { v[0], v[0], v[0], v[2] }, { v[1], v[1], v[1], v[3] } };
    if (channels == UastcChannels::Rgb) return { { v[0], v[2], v[4], 255 }, { v[1], v[3], v[5], 255 } };
    return { { v[0], v[2], v[4], v[6] }, { v[1], v[3], v[5], v[7] } };
}

std::array<AstcEnds, 3> takeUastcEnds(UastcMode const& mode, BlockBits& bits) {
    const uint32_t each = mode.channels == UastcChannels::Rgb ? 6 : mode.channels == UastcChannels::Rgba ? 8 : 4;
    auto numbers = takeUastcSequence(kAstcRanges[mode.colorRange], each * mode.subsets, bits);
    std::array<uint8_t, 256> const& colors = astcColorsOf(mode.colorRange);
    for (uint8_t& number : numbers) number = colors[number];
    std::array<AstcEnds, 3> ends;
    for (uint32_t i = 0; i < mode.subsets; ++i) ends[i] = endsFromNumbers(mode.channels, &numbers[i * each]);
    return ends;
}

Texel8 solidTexel(BlockBits& bits) {
    std::array<uint8_t, 4> codes;
    for (uint8_t& code : codes) code = static_cast<uint8_t>(bits.take(8));
    return { codes[0], codes[1], codes[2], codes[3] };
}

/// Ranges of 2, 4, 8, 16 and 32 levels.
std::array<uint8_t, 32> const& weightsOfBits(uint32_t bits) {
    constexpr std::array<uint8_t, 6> kRanges{ 0, 0, 2, 5, 8, 11 };
    return astcWeightsOf(kRanges[bits]);
}

} // namespace

void decodeUastc(const std::byte* block, bool isSrgb, Texel8* texels) {
    BlockBits bits(block);
    const uint32_t index = kModeOfCode[bits.at(0, 7)];
    if (index == kNoMode) return static_cast<void>(std::fill_n(texels, 16, kAstcError));
    UastcMode const& mode = kUastcModes[index];
    bits.skip(mode.codeBits);
    if (index == kUastcSolidMode) return static_cast<void>(std::fill_n(texels, 16, solidTexel(bits)));
    bits.skip(mode.hintBits);
    uint32_t planeChannel = 4; // none
    if (mode.planes == 2) planeChannel = mode.channels == UastcChannels::LuminanceAlpha ? 3 : bits.take(2);
    const UastcPattern* pattern = takePattern(index, bits);
    if (!pattern) return static_cast<void>(std::fill_n(texels, 16, kAstcError));
    const std::array<AstcEnds, 3> ends = takeUastcEnds(mode, bits);
    std::array<uint8_t, 32> const& weights = weightsOfBits(mode.weightBits);
    for (uint32_t i = 0; i < 16; ++i) {
        const uint32_t width = mode.weightBits - (pattern->isAnchor[i] ? 1 : 0);
        std::array<uint32_t, 4> shares;
        shares.fill(weights[bits.take(width)]);
        if (planeChannel < 4) shares[planeChannel] = weights[bits.take(width)];
        texels[i] = astcTexel(ends[pattern->subsets[i]], shares, isSrgb);
    }
}

} // namespace filament_core::assets::blocks
