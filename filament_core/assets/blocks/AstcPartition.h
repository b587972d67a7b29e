// SPDX-License-Identifier: Apache-2.0
/// astcPartitionOf: which of up to four partitions a texel of a block is of. Khronos Data Format Specification 1.3,
/// section "Partition Pattern Generation".
#pragma once

#include <algorithm>
#include <cstdint>

namespace filament_core::assets::blocks {

/// Mixes the bits of a seed.
constexpr uint32_t astcHash(uint32_t p) {
    p ^= p >> 15, p -= p << 17, p += p << 7, p += p << 4, p ^= p >> 5;
    p += p << 16, p ^= p >> 7, p ^= p >> 3, p ^= p << 6, p ^= p >> 17;
    return p;
}

/// Planes of up to four directions, by number of partitions and seed: one for each block.
class AstcPartition {
public:
    /// `count`: 2 to 4; `seed`: 0 to 1023. `isSmall`: blocks of fewer than 31 texels.
    constexpr AstcPartition(uint32_t count, uint32_t seed, bool isSmall) : mCount(count), mScale(isSmall ? 2 : 1) {
        seed += (count - 1) * 1024;
        mNumber = astcHash(seed);
        const auto of3 = count == 3 ? 6u : 5u, of2 = seed & 2 ? 4u : 5u;
        const uint32_t shift1 = seed & 1 ? of2 : of3, shift2 = seed & 1 ? of3 : of2;
        for (uint32_t i = 0; i < 8; ++i) {
            const uint32_t nibble = mNumber >> (4 * i) & 15;
            mSeeds[i] = nibble * nibble >> (i & 1 ? shift2 : shift1);
        }
    }

    constexpr uint32_t at(uint32_t x, uint32_t y) const {
        x *= mScale, y *= mScale;
        const uint32_t a = (mSeeds[0] * x + mSeeds[1] * y + (mNumber >> 14)) & 63;
        const uint32_t b = (mSeeds[2] * x + mSeeds[3] * y + (mNumber >> 10)) & 63;
        const uint32_t c = mCount < 3 ? 0 : (mSeeds[4] * x + mSeeds[5] * y + (mNumber >> 6)) & 63;
        const uint32_t d = mCount < 4 ? 0 : (mSeeds[6] * x + mSeeds[7] * y + (mNumber >> 2)) & 63;
        if (a >= b && a >= c && a >= d) return 0;
        if (b >= c && b >= d) return 1;
        return c >= d ? 2 : 3;
    }

private:
    uint32_t mCount, mScale, mNumber = 0;
    uint32_t mSeeds[8]{};
};

} // namespace filament_core::assets::blocks
