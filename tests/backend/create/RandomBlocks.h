// SPDX-License-Identifier: Apache-2.0
/// randomBlocks: blocks of every mode and partition of a format, with random ends and indices.
///   Thread  any; pure.
#pragma once

#include "tests/backend/create/Gpu.h"

#include <array>
#include <random>

namespace filament_core::backend {

/// The lowest bits of a block, which choose its mode.
struct BlockMode {
    uint32_t bits = 0;
    uint32_t count = 0;
};

inline BlockMode noMode(uint32_t) { return {}; }

/// The 14 modes in turn.
inline BlockMode modeOfBc6(uint32_t block) {
    constexpr std::array<uint32_t, 14> kModes{ 0b00000, 0b00001, 0b00010, 0b00110, 0b01010, 0b01110, 0b10010,
                                               0b10110, 0b11010, 0b11110, 0b00011, 0b00111, 0b01011, 0b01111 };
    return { kModes[block % kModes.size()], 5 };
}

/// 8 modes with 64 partitions each in turn; every ninth block is reserved.
inline BlockMode modeOfBc7(uint32_t block) {
    const uint32_t mode = block % 9, partition = block / 9 % 64;
    return { (mode < 8 ? 1u << mode : 0) | partition << (mode + 1), 14 };
}

inline Bytes randomBlocks(size_t blockBytes, uint64_t count, uint32_t seed, BlockMode (*modeOf)(uint32_t block)) {
    std::mt19937 random(seed);
    Bytes bytes(blockBytes * count);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
    for (uint32_t i = 0; i < count; ++i) {
        uint16_t bits;
        std::memcpy(&bits, &bytes[i * blockBytes], sizeof(bits));
        const BlockMode mode = modeOf(i);
        const uint32_t mask = (1u << mode.count) - 1;
        bits = static_cast<uint16_t>((bits & ~mask) | (mode.bits & mask));
        std::memcpy(&bytes[i * blockBytes], &bits, sizeof(bits));
    }
    return bytes;
}

} // namespace filament_core::backend
