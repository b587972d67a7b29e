// SPDX-License-Identifier: Apache-2.0
/// toleranceBound: what most places do not exceed, judged by some of them.
///   Method  the least of the measured values that bounds kBoundShare of all places with kBoundConfidence, whatever
///           their distribution: Wilks 1941, "Determination of Sample Sizes for Setting Tolerance Limits". Of 256
///           values it is the seventh largest.
///   In      values of places that were drawn independently of each other.
///   Out     nothing for fewer than 59 values: their largest would promise too much.
///   Thread  any; pure.
#pragma once

#include <optional>
#include <vector>

namespace filament_core::bake {

inline constexpr double kBoundShare = 0.95, kBoundConfidence = 0.95;

std::optional<double> toleranceBound(std::vector<double> values);

} // namespace filament_core::bake
