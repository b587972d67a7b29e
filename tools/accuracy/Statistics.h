// SPDX-License-Identifier: Apache-2.0
/// Statistics: medians of samples taken in turns, and how sure they are.
///   Source  percentile bootstrap: Efron and Tibshirani 1993, "An Introduction to the Bootstrap", chapter 13.
///   Thread  any; pure: the same samples give the same bits.
///   Fails   never: of no samples every figure is 0.
#pragma once

#include <span>
#include <vector>

namespace filament::accuracy {

/// A median and the interval that holds it with 95 % confidence.
struct Estimate {
    double median = 0, low = 0, high = 0;
};

double median(std::span<const double> values);
Estimate estimate(std::span<const double> values);

/// Of a[i] / b[i], both taken in round i: a machine that slows down for a while slows down both.
Estimate estimateRatio(std::span<const double> a, std::span<const double> b);

} // namespace filament::accuracy
