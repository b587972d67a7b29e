// SPDX-License-Identifier: Apache-2.0
/// AstcQuantization: numbers of ASTC that are stored as trits, quints and bits, and what they stand for. Khronos Data
/// Format Specification 1.3, sections "Integer Sequence Encoding", "Endpoint Unquantization", "Weight Unquantization".
///   Thread  any; pure.
#pragma once

#include "filament_core/assets/blocks/BlockTexels.h"

#include <array>
#include <cstdint>
#include <span>

namespace filament_core::assets::blocks {

/// A range 0 to levels - 1: one trit or quint, or none, and bits below it.
struct AstcRange {
    uint8_t trits, quints, bits; ///< `trits` and `quints` are 0 or 1
};

/// From 2 levels to 256.
inline constexpr std::array<AstcRange, 21> kAstcRanges{ {
        { 0, 0, 1 }, { 1, 0, 0 }, { 0, 0, 2 }, { 0, 1, 0 }, { 1, 0, 1 }, { 0, 0, 3 }, { 0, 1, 1 },
        { 1, 0, 2 }, { 0, 0, 4 }, { 0, 1, 2 }, { 1, 0, 3 }, { 0, 0, 5 }, { 0, 1, 3 }, { 1, 0, 4 },
        { 0, 0, 6 }, { 0, 1, 4 }, { 1, 0, 5 }, { 0, 0, 7 }, { 0, 1, 5 }, { 1, 0, 6 }, { 0, 0, 8 },
} };
inline constexpr uint32_t kAstcRangeOf6 = 4, kAstcRangeOf32 = 11;

/// Bits of a sequence of `count` numbers.
uint32_t astcSequenceBits(AstcRange range, uint32_t count);

/// `bits` are those of the sequence, and zeros behind them.
void takeAstcSequence(AstcRange range, BlockBits bits, std::span<uint8_t> numbers);

/// What each number of a range stands for: of the ends of colours 0 to 255, from 6 levels on, by index in kAstcRanges
/// ...
std::array<uint8_t, 256> const& astcColorsOf(uint32_t rangeIndex);
/// ... and of weights 0 to 64, up to 32 levels.
std::array<uint8_t, 32> const& astcWeightsOf(uint32_t rangeIndex);

} // namespace filament_core::assets::blocks
