// SPDX-License-Identifier: Apache-2.0
/// ScatteringMedium: how light flies through a MediumSample and how it turns.
///   Method  the colour that chooses the length of a flight is chosen in proportion to what the path carries; the
///           balance heuristic over the colours (Veach 1997, section 9.2.2) makes the estimate that of all three.
///   Thread  pure functions. Memory: none.
#pragma once

#include "tools/reference/Surface.h"

namespace filament_core::reference {

struct Flight {
    double distance = 0;   ///< to the event; if it scatters
    bool scatters = false; ///< otherwise the light reaches the surface
    double3 weight{ 1.0 }; ///< of what the path carries
};

/// `carried`: throughput of the path, not black. `farthest`: distance of the surface. u in (0, 1).
Flight sampleFlight(MediumSample const& medium, double3 carried, double farthest, double2 u);

/// Henyey and Greenstein 1941, per steradian. `cosine`: of the angle between the directions in which light travels
/// before and after.
double phaseHenyeyGreenstein(double cosine, double anisotropy);
/// A direction in proportion to it.
double3 turned(double3 direction, double anisotropy, double2 u);

} // namespace filament_core::reference
