// SPDX-License-Identifier: Apache-2.0
#include "tools/bake/Tolerance.h"

#include <algorithm>
#include <cmath>

namespace filament_core::bake {

// The k-th smallest of n values bounds a share p of all with the confidence P(B <= k - 1), B binomial of n and p: the
// largest, where it is 1 - p^n, and from there on downwards as long as it suffices.
std::optional<double> toleranceBound(std::vector<double> values) {
    const auto n = static_cast<double>(values.size());
    double logChance = n * std::log(kBoundShare); // that exactly `above` of the n lie in the upper part
    double missed = std::exp(logChance);
    if (values.empty() || 1 - missed < kBoundConfidence) return std::nullopt;
    size_t above = 0;
    while (above + 1 < values.size()) {
        logChance += std::log((n - double(above)) / double(above + 1) * (1 - kBoundShare) / kBoundShare);
        if (1 - missed - std::exp(logChance) < kBoundConfidence) break;
        missed += std::exp(logChance);
        ++above;
    }
    const auto at = values.end() - static_cast<ptrdiff_t>(above) - 1;
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

} // namespace filament_core::bake
