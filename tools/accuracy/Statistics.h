// SPDX-License-Identifier: Apache-2.0
/// Statistics: medians of samples taken in turns, and their confidence intervals.
///   Source  percentile bootstrap: Efron and Tibshirani 1993, "An Introduction to the Bootstrap", chapter 13.
///   Thread  any; pure: the same samples give the same bits.
///   Fails   never: without samples every figure is 0.
#pragma once

#include <span>
#include <vector>

namespace filament_core::accuracy {

/// A median and its 95 % confidence interval.
struct Estimate {
    double median = 0, low = 0, high = 0;
};

Estimate estimate(std::span<const double> values);

/// The median of a[i] / b[i], both taken in round i: a machine that slows down for a while slows down both.
Estimate estimateRatio(std::span<const double> a, std::span<const double> b);

} // namespace filament_core::accuracy
