// SPDX-License-Identifier: Apache-2.0
#include "base/Statistics.h"

#include <algorithm>
#include <cmath>

namespace filament_core {
namespace {

double quantileOfSorted(std::span<const double> sorted, double p) {
    if (sorted.empty()) return 0;
    const double at = std::clamp(p, 0.0, 1.0) * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<size_t>(std::floor(at));
    const size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

} // namespace

double median(std::vector<double> values) {
    if (values.empty()) return 0;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return values.size() % 2 ? *middle : (*std::max_element(values.begin(), middle) + *middle) / 2;
}

double quantile(std::vector<double> values, double p) {
    std::sort(values.begin(), values.end());
    return quantileOfSorted(values, p);
}

Quartiles quartiles(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return { quantileOfSorted(values, 0.25), quantileOfSorted(values, 0.5), quantileOfSorted(values, 0.75) };
}

std::vector<double> pairedRatios(std::span<const double> a, std::span<const double> b) {
    std::vector<double> ratios;
    for (size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        if (b[i] != 0) ratios.push_back(a[i] / b[i]);
    return ratios;
}

} // namespace filament_core
