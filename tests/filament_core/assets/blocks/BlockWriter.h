// SPDX-License-Identifier: Apache-2.0
/// What the tests of block formats share: the bits of a block, written as the specifications count them, and one block
/// decoded.
#pragma once

#include "filament_core/assets/blocks/BlockDecoder.h"
#include "filament_core/assets/blocks/BlockTexels.h"

#include <array>
#include <cstring>
#include <ostream>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace filament_core::assets::test {

using BlockBytes = std::array<std::byte, 16>;

/// Bits from the lowest of the first byte on.
struct BlockWriter {
    BlockBytes bytes{};
    uint32_t at = 0;

    BlockWriter& put(uint64_t value, uint32_t bits) {
        for (uint32_t i = 0; i < bits && at < 128; ++i, ++at)
            bytes[at / 8] |= static_cast<std::byte>((value >> i & 1) << (at % 8));
        return *this;
    }
    /// Other bits stay.
    BlockWriter& putAt(uint32_t first, uint64_t value, uint32_t bits) {
        const uint32_t before = std::exchange(at, first);
        put(value, bits);
        at = before;
        return *this;
    }
};

inline BlockBytes randomBlock(std::mt19937& random) {
    BlockBytes block;
    for (std::byte& byte : block) byte = static_cast<std::byte>(random());
    return block;
}

/// The texels of one block of 4 x 4.
template <class Texel = blocks::Texel8>
std::array<Texel, 16> decodedBlock(BlockKind kind, std::span<const std::byte> block, bool isSrgb = false) {
    std::array<Texel, 16> texels;
    decodeBlocks({ kind }, isSrgb, block.first(bytesPerBlock(kind)), 4, 4, std::as_writable_bytes(std::span(texels)));
    return texels;
}

} // namespace filament_core::assets::test

namespace filament_core::assets::blocks {

inline void PrintTo(Texel8 const& texel, std::ostream* stream) {
    *stream << '(' << int{ texel.r } << ' ' << int{ texel.g } << ' ' << int{ texel.b } << ' ' << int{ texel.a } << ')';
}

} // namespace filament_core::assets::blocks
