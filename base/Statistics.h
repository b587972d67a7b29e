// SPDX-License-Identifier: Apache-2.0
/// Statistics: order statistics of samples, and ratios of samples that were taken in the same round.
///   Thread  any; pure: the same samples give the same bits.
///   Fails   never: without samples every figure is 0.
///   Source  quantiles by linear interpolation between order statistics: Hyndman and Fan 1996, "Sample quantiles in
///           statistical packages", definition 7.
#pragma once

#include <span>
#include <vector>

namespace filament_core {

/// The middle value, or the mean of the two middle ones.
double median(std::vector<double> values);

/// The value below which the fraction `p` in [0, 1] of the values lies.
double quantile(std::vector<double> values, double p);

struct Quartiles {
    double first = 0, median = 0, third = 0;
};

Quartiles quartiles(std::vector<double> values);

/// a[i] / b[i] for every round i that both have. A machine that slows down for a while slows down both, so the ratio
/// within a round is steadier than the ratio of the medians. Rounds with b[i] == 0 are left out.
std::vector<double> pairedRatios(std::span<const double> a, std::span<const double> b);

} // namespace filament_core
