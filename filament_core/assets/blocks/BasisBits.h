// SPDX-License-Identifier: Apache-2.0
/// BasisBits, BasisHuffman: the bits and the prefix codes of BasisLZ. KTX 2.0 Specification, appendix "BasisLZ/ETC1S
/// Bitstream", section "Compressed Huffman Tables"; codes are numbered as in RFC 1951, 3.2.2.
///   In      untrusted bytes. Behind the last one are zeros, and hasEnded() is then true: a caller checks once, at the
///           end of a loop whose length does not depend on the bits.
///   Thread  one for each reader; a table is read-only once it is read.
///   Limits  16383 symbols, codes of 16 bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::assets::blocks {

/// The lowest bit of each byte comes first.
class BasisBits {
public:
    explicit BasisBits(std::span<const std::byte> bytes) : mBytes(bytes) {}

    uint32_t take(uint32_t count) { ///< up to 16
        const uint32_t bits = peek(count);
        skip(count);
        return bits;
    }
    uint32_t peek(uint32_t count) { ///< up to 16
        while (mCount < count) refill();
        return static_cast<uint32_t>(mBits & ((uint64_t{ 1 } << count) - 1));
    }
    void skip(uint32_t count) { mBits >>= count, mCount -= count; } ///< what was peeked at

    /// More bits were taken than there are.
    bool hasEnded() const { return mMissing * 8 > mCount; }

    /// Numbers in groups of `width` bits, lowest first, each behind which a bit says whether another follows.
    uint32_t takeVariable(uint32_t width);

private:
    void refill() {
        const uint64_t byte = mAt < mBytes.size() ? std::to_integer<uint64_t>(mBytes[mAt]) : 0;
        if (mAt >= mBytes.size()) ++mMissing;
        ++mAt;
        mBits |= byte << mCount;
        mCount += 8;
    }

    std::span<const std::byte> mBytes;
    size_t mAt = 0;
    uint64_t mBits = 0, mMissing = 0;
    uint32_t mCount = 0;
};

class BasisHuffman {
public:
    /// Returns whether it is a table: its codes are complete, or there is at most one.
    bool read(BasisBits& bits);
    /// Returns whether lengths, by symbol, are those of such a table; 0: the symbol has no code.
    bool build(std::span<const uint8_t> lengths);

    /// A symbol; kNoSymbol if the bits are none.
    uint32_t take(BasisBits& bits) const;

    static constexpr uint32_t kNoSymbol = ~0u, kMaxLength = 16, kMaxSymbols = 16383;

private:
    static constexpr uint32_t kShortBits = 10;
    struct Short {
        uint16_t symbol = 0;
        uint8_t length = 0; ///< 0: longer, or none
    };

    std::vector<uint16_t> mSymbols;                                    ///< in the order of their codes
    std::array<uint32_t, kMaxLength + 2> mFirstCode{}, mFirstSymbol{}; ///< by length
    std::vector<Short> mShort;                                         ///< by the next bits
};

} // namespace filament_core::assets::blocks
