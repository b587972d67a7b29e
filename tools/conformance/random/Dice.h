// SPDX-License-Identifier: Apache-2.0
/// Dice: random numbers that are the same on every machine and with every standard library, whose distributions and
/// std::shuffle are not.
///   Thread  one at a time; the same seed gives the same numbers.   Memory: 2.5 KB.   Fails: never.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <random>
#include <utility>

namespace filament_core::conformance {

class Dice {
public:
    explicit Dice(uint64_t seed) : mBits(seed) {}
    uint32_t below(size_t count) { return static_cast<uint32_t>((mBits() >> 32) % count); }
    bool chance(uint32_t percent) { return below(100) < percent; }
    template <class List>
    auto const& one(List const& list) {
        return list[below(std::size(list))];
    }
    template <class List>
    void shuffle(List& list) {
        for (size_t left = std::size(list); left > 1; --left) std::swap(list[left - 1], list[below(left)]);
    }

private:
    std::mt19937_64 mBits;
};

} // namespace filament_core::conformance
