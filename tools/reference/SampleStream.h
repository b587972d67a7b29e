// SPDX-License-Identifier: Apache-2.0
/// SampleStream: the random numbers of one path, a function of (seed, pixel, pass, sample, dimension) only.
///   Source  pairs of dimensions are Sobol' (0,2)-sequences, padded to any number of dimensions: Kollig and Keller
///           2002, "Efficient Multidimensional Sampling". Hashing shuffles each pair and scrambles it after Owen:
///           Burley 2020, "Practical Hash-based Owen Scrambling", with the permutation of Laine and Karras.
///   Error   the samples of a pass are evenly distributed; passes and pixels are independent of each other: the spread
///           of the passes' means gives an unbiased error.
///   Memory  none. Thread: a value.
#pragma once

#include <filament_core/Math.h>

#include <cstdint>

namespace filament_core::reference {

/// Steele, Lea and Flood 2014, "Fast Splittable Pseudorandom Number Generators": the finaliser of SplitMix64.
constexpr uint64_t mixBits(uint64_t x) {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
}

constexpr uint64_t hashOf(uint64_t a, uint64_t b) { return mixBits(a + 0x9e3779b97f4a7c15ull * (b + 1)); }

namespace sobol {

constexpr uint32_t reversed(uint32_t x) {
    x = (x << 16) | (x >> 16);
    x = ((x & 0x00FF00FFu) << 8) | ((x & 0xFF00FF00u) >> 8);
    x = ((x & 0x0F0F0F0Fu) << 4) | ((x & 0xF0F0F0F0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xCCCCCCCCu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xAAAAAAAAu) >> 1);
}

/// A bit depends only on itself and lower bits: applied to reversed bits this is Owen's scramble.
constexpr uint32_t permutedUpwards(uint32_t x, uint32_t seed) {
    x += seed;
    x ^= x * 0x6c50b47cu;
    x ^= x * 0xb82f1e52u;
    x ^= x * 0xc7afe638u;
    x ^= x * 0x8d22f6e6u;
    return x;
}

constexpr uint32_t scrambled(uint32_t x, uint32_t seed) { return reversed(permutedUpwards(reversed(x), seed)); }

/// The second dimension: Pascal's triangle modulo 2 as generator matrix.
constexpr uint32_t second(uint32_t index) {
    uint32_t result = 0;
    for (uint32_t column = 1u << 31; index != 0; index >>= 1, column ^= column >> 1) {
        if (index & 1) result ^= column;
    }
    return result;
}

/// The centre of one of 2^32 cells: in (0, 1), never 0 or 1.
constexpr double unitFromBits(uint32_t bits) { return (bits + 0.5) * 0x1p-32; }

} // namespace sobol

class SampleStream {
public:
    /// `stream` identifies pixel and pass; samples of one stream have indices 0, 1, 2, ...
    SampleStream(uint64_t stream, uint32_t index) : mStream(stream), mIndex(index) {}

    /// The two numbers of a pair of dimensions, in (0, 1).
    double2 pair(uint32_t dimension) const {
        const uint64_t shuffle = hashOf(mStream, dimension), scramble = mixBits(shuffle);
        const uint32_t index = sobol::scrambled(mIndex, static_cast<uint32_t>(shuffle >> 32));
        const uint32_t x = sobol::scrambled(sobol::reversed(index), static_cast<uint32_t>(scramble));
        const uint32_t y = sobol::scrambled(sobol::second(index), static_cast<uint32_t>(scramble >> 32));
        return { sobol::unitFromBits(x), sobol::unitFromBits(y) };
    }

private:
    uint64_t mStream;
    uint32_t mIndex;
};

} // namespace filament_core::reference
