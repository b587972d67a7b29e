// SPDX-License-Identifier: Apache-2.0
/// The colours of daylight: CIE 15:2004, section 3.1.
///   Thread  any; pure.   Fails: never.
#pragma once

#include <filament_core/Math.h>

namespace filament_core::color {

/// CIE 1931 x, y of a phase of daylight; `kelvin` in [4000, 25000].
double2 daylightChromaticity(double kelvin);

} // namespace filament_core::color
