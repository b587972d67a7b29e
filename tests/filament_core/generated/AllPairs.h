// SPDX-License-Identifier: Apache-2.0
/// allPairs: few rows of choices in which every value of a factor meets every value of each other factor.
///   How     greedy, after Cohen, Dalal, Fredman and Patton 1997, "The AETG System": a row begins with a pair that no
///           row has yet, and each further factor, in an order of chance, takes the value that makes the most new
///           pairs.
///   Size    for n values of the two largest factors, n^2 rows and a few more; a row for each single value if there is
///           one factor.
///   Thread  any; pure: the same seed gives the same rows.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::test {

/// Numerical Recipes' quick generator, upper bits.
class Chance {
public:
    explicit Chance(uint32_t seed) : mState(seed * 2654435761u + 1) {}
    /// In [0, count); 0 for none.
    uint32_t below(uint32_t count) {
        mState = mState * 1664525u + 1013904223u;
        return count ? (mState >> 8) % count : 0;
    }
    /// In [low, high).
    float within(float low, float high) { return low + (high - low) * static_cast<float>(below(1 << 20)) / (1 << 20); }

private:
    uint32_t mState;
};

/// One value of each factor.
using PairRow = std::vector<uint32_t>;

/// `counts`: how many values each factor has, > 0.
std::vector<PairRow> allPairs(std::span<const uint32_t> counts, uint32_t seed);

/// The pairs of values that no row has.
size_t missingPairs(std::span<const uint32_t> counts, std::span<const PairRow> rows);

} // namespace filament_core::test
