// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/Distribution.h"

#include "base/Assert.h"

#include <algorithm>
#include <cmath>

namespace filament_core::reference {

Distribution::Distribution(std::span<const double> weights) : mCumulative(weights.size() + 1) {
    FILAMENT_ASSERT(!weights.empty(), "a distribution chooses among one thing at least");
    for (size_t i = 0; i < weights.size(); ++i) {
        FILAMENT_ASSERT(weights[i] >= 0 && std::isfinite(weights[i]), "weights of a distribution are finite and >= 0");
        mCumulative[i + 1] = mCumulative[i] + weights[i];
    }
    const double total = mCumulative.back();
    for (size_t i = 1; i < mCumulative.size(); ++i) {
        mCumulative[i] =
                total > 0 ? mCumulative[i] / total : static_cast<double>(i) / static_cast<double>(weights.size());
    }
    mCumulative.back() = 1;
}

Picked Distribution::pick(double u) const {
    // The first sum above u. Items of weight zero end where they begin, and are skipped.
    const auto above = std::upper_bound(mCumulative.begin() + 1, mCumulative.end() - 1, u);
    const auto index = static_cast<uint32_t>(above - mCumulative.begin()) - 1;
    const double share = probability(index);
    // The position within the item's share is uniform, too, and saves the caller a number.
    const double inside = share > 0 ? (u - mCumulative[index]) / share : 0;
    return { index, share, std::clamp(inside, 0.0, 1 - 0x1p-53) };
}

} // namespace filament_core::reference
