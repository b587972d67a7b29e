// SPDX-License-Identifier: Apache-2.0
/// AstcColors: the two ends of a partition's colours, and what lies between them. Khronos Data Format Specification
/// 1.3, chapter "ASTC", sections on endpoints and "Weight Application". Also for UASTC, which has the same arithmetic.
///   Thread  any; pure.
#pragma once

#include "filament_core/assets/blocks/BlockTexels.h"

#include <array>

namespace filament_core::assets::blocks {

/// Of blocks that are no texture: "Illegal Encodings".
inline constexpr Texel8 kAstcError{ 255, 0, 255, 255 };

struct AstcEnds {
    std::array<uint8_t, 4> first{}, second{};
};

/// Modes 0 to 15.
constexpr bool isHdrMode(uint32_t mode) {
    return mode == 2 || mode == 3 || mode == 7 || mode == 11 || mode == 14 || mode == 15;
}
/// How many numbers an LDR mode has: 2 to 8.
constexpr uint32_t endCountOf(uint32_t mode) { return 2 * (mode / 4 + 1); }

/// `values`: endCountOf(mode) of them.
AstcEnds astcEnds(uint32_t mode, const uint8_t* values);

/// `shares` of the second end in 64ths, by channel.
inline Texel8 astcTexel(AstcEnds const& ends, std::array<uint32_t, 4> const& shares, bool isSrgb) {
    const auto channel = [&](size_t c, bool isCode) {
        const uint32_t first = ends.first[c] * 256u + (isCode ? 128u : ends.first[c]);
        const uint32_t second = ends.second[c] * 256u + (isCode ? 128u : ends.second[c]);
        return static_cast<uint8_t>((first * (64 - shares[c]) + second * shares[c] + 32) >> 6 >> 8);
    };
    return { channel(0, isSrgb), channel(1, isSrgb), channel(2, isSrgb), channel(3, false) };
}

} // namespace filament_core::assets::blocks
