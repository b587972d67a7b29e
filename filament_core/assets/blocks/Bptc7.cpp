// SPDX-License-Identifier: Apache-2.0
// BC7: Khronos Data Format Specification 1.3, chapter 20.
#include "filament_core/assets/blocks/BlockTexels.h"
#include "filament_core/assets/blocks/BptcPartitions.h"

#include <algorithm>
#include <utility>

namespace filament_core::assets::blocks {
namespace {

/// Table "mode-dependent BPTC parameters". All but `subsets` are counts of bits.
struct Bc7Mode {
    uint8_t subsets, partition, rotation, selection, color, alpha, endpointP, sharedP, index, secondIndex;
};
constexpr std::array<Bc7Mode, 8> kBc7Modes{ {
        { 3, 4, 0, 0, 4, 0, 1, 0, 3, 0 },
        { 2, 6, 0, 0, 6, 0, 0, 1, 3, 0 },
        { 3, 6, 0, 0, 5, 0, 0, 0, 2, 0 },
        { 2, 6, 0, 0, 7, 0, 1, 0, 2, 0 },
        { 1, 0, 2, 1, 5, 6, 0, 0, 2, 3 },
        { 1, 0, 2, 0, 7, 8, 0, 0, 2, 2 },
        { 1, 0, 0, 0, 7, 7, 1, 0, 4, 0 },
        { 2, 6, 0, 0, 5, 5, 1, 0, 2, 0 },
} };

/// By end: two of each subset.
using Bc7Ends = std::array<std::array<uint32_t, 4>, 6>;

/// The value in the high bits of a byte, and its highest bits again below.
uint32_t expandedTo8(uint32_t value, uint32_t bits) {
    value <<= 8 - bits;
    return value | value >> bits;
}

/// Adds the lowest bit of each value, which channels share, and sometimes both ends of a subset.
void takeLowBits(Bc7Mode const& mode, BlockBits& bits, Bc7Ends& ends) {
    for (uint32_t e = 0; e < mode.subsets * 2u; e += mode.sharedP ? 2 : 1) {
        const uint32_t low = bits.take(1);
        for (uint32_t& value : ends[e]) value = value << 1 | low;
        if (!mode.sharedP) continue;
        for (uint32_t& value : ends[e + 1]) value = value << 1 | low;
    }
}

Bc7Ends takeBc7Ends(Bc7Mode const& mode, BlockBits& bits) {
    Bc7Ends ends{};
    const uint32_t count = mode.subsets * 2u;
    for (size_t c = 0; c < 4; ++c) {
        const uint32_t width = c < 3 ? mode.color : mode.alpha;
        for (uint32_t e = 0; e < count; ++e) ends[e][c] = bits.take(width);
    }
    const uint32_t lowBits = mode.endpointP | mode.sharedP;
    if (lowBits) takeLowBits(mode, bits, ends);
    for (uint32_t e = 0; e < count; ++e) {
        for (size_t c = 0; c < 3; ++c) ends[e][c] = expandedTo8(ends[e][c], mode.color + lowBits);
        ends[e][3] = mode.alpha ? expandedTo8(ends[e][3], mode.alpha + lowBits) : 255;
    }
    return ends;
}

struct SubsetsOfTexels {
    uint32_t pattern = 0;                ///< two bits a texel
    std::array<uint8_t, 3> anchors{ 0 }; ///< texel 0 where there are fewer
};

SubsetsOfTexels subsetsOf(uint32_t subsets, uint32_t partition) {
    if (subsets == 2) return { kTwoSubsets[partition], { 0, kAnchorOfTwo[partition], 0 } };
    if (subsets == 3)
        return { kThreeSubsets[partition], { 0, kSecondAnchorOfThree[partition], kThirdAnchorOfThree[partition] } };
    return {};
}

using TexelIndices = std::array<uint8_t, 16>;

/// The index of an anchor has its highest bit left out.
TexelIndices takeBc7Indices(uint32_t width, std::array<uint8_t, 3> const& anchors, BlockBits& bits) {
    TexelIndices indices;
    for (uint32_t i = 0; i < 16; ++i) {
        const bool isAnchor = i == anchors[0] || i == anchors[1] || i == anchors[2];
        indices[i] = static_cast<uint8_t>(bits.take(isAnchor ? width - 1 : width));
    }
    return indices;
}

uint8_t between(uint32_t first, uint32_t second, uint32_t weight) {
    return static_cast<uint8_t>((first * (64 - weight) + second * weight + 32) >> 6);
}

void rotate(Texel8& texel, uint32_t rotation) {
    if (rotation == 1) std::swap(texel.a, texel.r);
    if (rotation == 2) std::swap(texel.a, texel.g);
    if (rotation == 3) std::swap(texel.a, texel.b);
}

} // namespace

void decodeBc7(const std::byte* block, Texel8* texels) {
    BlockBits bits(block);
    const auto code = static_cast<uint32_t>(std::countr_zero(bits.at(0, 8) | 0x100));
    if (code == kBc7Modes.size()) { // reserved
        std::fill_n(texels, 16, Texel8{ 0, 0, 0, 0 });
        return;
    }
    Bc7Mode const& mode = kBc7Modes[code];
    bits.skip(code + 1);
    const SubsetsOfTexels subsets = subsetsOf(mode.subsets, bits.take(mode.partition));
    const uint32_t rotation = bits.take(mode.rotation);
    const bool isSwapped = bits.take(mode.selection) != 0;
    const Bc7Ends ends = takeBc7Ends(mode, bits);
    TexelIndices colorIndices = takeBc7Indices(mode.index, subsets.anchors, bits), alphaIndices = colorIndices;
    const uint8_t *colorWeights = bptcWeights(mode.index), *alphaWeights = colorWeights;
    if (mode.secondIndex) {
        alphaIndices = takeBc7Indices(mode.secondIndex, {}, bits);
        alphaWeights = bptcWeights(mode.secondIndex);
    }
    if (isSwapped) std::swap(colorIndices, alphaIndices), std::swap(colorWeights, alphaWeights);
    for (uint32_t i = 0; i < 16; ++i) {
        const uint32_t subset = subsets.pattern >> (2 * i) & 3;
        auto const &first = ends[2 * subset], &second = ends[2 * subset + 1];
        const uint32_t weight = colorWeights[colorIndices[i]];
        texels[i] = { between(first[0], second[0], weight), between(first[1], second[1], weight),
                      between(first[2], second[2], weight),
                      between(first[3], second[3], alphaWeights[alphaIndices[i]]) };
        rotate(texels[i], rotation);
    }
}

} // namespace filament_core::assets::blocks
