// SPDX-License-Identifier: Apache-2.0
/// Distribution: picks one of N items in proportion to their weights, by inversion of the cumulative sum.
///   Source  Pharr, Jakob, Humphreys 2023, "Physically Based Rendering", 4th edition, sections A.2 and A.4.
///   In      weights >= 0 and finite. If all are zero, every item is equally likely.
///   Memory  8 bytes per weight. Thread: read-only after construction.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::reference {

struct Picked {
    uint32_t index = 0;
    double probability = 0; ///< of the picked index
    double remainder = 0;   ///< in [0, 1): the position of u within the item's share, again uniform
};

class Distribution {
public:
    Distribution() = default;
    explicit Distribution(std::span<const double> weights);

    /// u in [0, 1). The distribution must not be empty. Items of weight 0 are never picked, unless all weights are 0.
    Picked pick(double u) const;
    double probability(uint32_t index) const { return mCumulative[index + 1] - mCumulative[index]; }
    uint32_t size() const { return static_cast<uint32_t>(mCumulative.size()) - 1; }

private:
    std::vector<double> mCumulative; // size() + 1 values from 0 to 1
};

} // namespace filament_core::reference
