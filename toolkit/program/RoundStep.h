// SPDX-License-Identifier: Apache-2.0
/// RoundStep: steps that people read easily: those between the ticks of a plot, or of a drag that snaps.
///   Thread  any.
#pragma once

#include "base/math/Elementary.h"

#include <cmath>

namespace filament_core {

/// The smallest of 1, 2 and 5 times a power of ten that is at least `least`, so less than 2.5 times as much.
/// `least` > 0, finite.
inline double roundStep(double least) {
    const double decade = elementary::pow(10.0, std::floor(elementary::log10(least)));
    for (const double factor : { 1.0, 2.0, 5.0 })
        if (factor * decade >= least) return factor * decade;
    return 10 * decade;
}

} // namespace filament_core
