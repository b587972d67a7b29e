// SPDX-License-Identifier: Apache-2.0
#include "bench/threading/Statistics.h"

#include <algorithm>
#include <cmath>

namespace filament::bench {
namespace {

double quantileOfSorted(std::span<const double> sorted, double p) {
    if (sorted.empty()) return 0;
    const double at = std::clamp(p, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<size_t>(std::floor(at));
    const size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

std::vector<double> sorted(std::span<const double> values) {
    std::vector<double> copy(values.begin(), values.end());
    std::sort(copy.begin(), copy.end());
    return copy;
}

} // namespace

double quantile(std::span<const double> values, double p) { return quantileOfSorted(sorted(values), p); }

Quartiles quartiles(std::span<const double> values) {
    const std::vector<double> ascending = sorted(values);
    return { quantileOfSorted(ascending, 0.25), quantileOfSorted(ascending, 0.5), quantileOfSorted(ascending, 0.75) };
}

std::vector<double> pairedRatios(std::span<const double> a, std::span<const double> b) {
    std::vector<double> ratios;
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        if (b[i] != 0) ratios.push_back(a[i] / b[i]);
    return ratios;
}

} // namespace filament::bench
