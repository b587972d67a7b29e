// SPDX-License-Identifier: Apache-2.0
/// Distribution: picks one of N things in proportion to their weights, by inversion of the cumulative sum.
///   Source  Pharr, Jakob, Humphreys 2023, "Physically Based Rendering", 4th edition, sections A.2 and A.4.
///   In      weights >= 0 and finite. When all are zero every thing is equally likely.
///   Memory  8 bytes a weight. Thread: read-only after construction.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace filament::reference {

struct Picked {
    uint32_t index = 0;
    double probability = 0; ///< of that index
    double remainder = 0;   ///< in [0, 1): where in the thing's share u fell, uniform again
};

class Distribution {
public:
    Distribution() = default;
    explicit Distribution(std::span<const double> weights);

    /// u in [0, 1). The distribution is not empty. Things of weight 0 are never picked, unless all are.
    Picked pick(double u) const;
    double probability(uint32_t index) const { return mCumulative[index + 1] - mCumulative[index]; }
    uint32_t size() const { return static_cast<uint32_t>(mCumulative.size()) - 1; }

private:
    std::vector<double> mCumulative; // size() + 1 values from 0 to 1
};

} // namespace filament::reference
