// SPDX-License-Identifier: Apache-2.0
#include "base/Hash.h"

#include <cstring>

namespace filament_core {
namespace {

constexpr uint64_t kSecretA = 0x9E3779B97F4A7C15ull; // 2^64 / golden ratio
constexpr uint64_t kSecretB = 0xD1B54A32D192ED03ull; // an odd constant with balanced bits

uint64_t fold(uint64_t a, uint64_t b) {
    const __uint128_t product = static_cast<__uint128_t>(a) * b;
    return static_cast<uint64_t>(product) ^ static_cast<uint64_t>(product >> 64);
}

uint64_t load(const std::byte* from, size_t count) {
    uint64_t word = 0;
    std::memcpy(&word, from, count);
    return word;
}

} // namespace

uint64_t hashCombine(uint64_t a, uint64_t b) { return fold(a ^ kSecretA, b ^ kSecretB ^ (a << 1)); }

uint64_t hashBytes(std::span<const std::byte> bytes, uint64_t seed) {
    uint64_t state = seed ^ kSecretA;
    const std::byte* at = bytes.data();
    size_t left = bytes.size();
    for (; left >= 16; left -= 16, at += 16) {
        state = fold(load(at, 8) ^ kSecretB, load(at + 8, 8) ^ state);
    }
    const size_t first = left < 8 ? left : 8;
    const uint64_t low = first ? load(at, first) : 0;
    const uint64_t high = left > 8 ? load(at + 8, left - 8) : 0;
    return fold(fold(low ^ kSecretB, high ^ state), bytes.size() ^ kSecretA);
}

} // namespace filament_core
