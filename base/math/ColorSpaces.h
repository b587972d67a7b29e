// SPDX-License-Identifier: Apache-2.0
/// Spaces of linear RGB by their primaries, and the matrices between them.
///   Values  CIE 1931 x and y; double precision, because colours pass several of these matrices.
///   Thread  any; pure.
#pragma once

#include "base/math/Math.h"

#include <optional>

namespace filament_core {

struct Chromaticities {
    double2 red, green, blue, white;
};

inline constexpr Chromaticities kRec709Chromaticities{
    { 0.64, 0.33 }, { 0.3, 0.6 }, { 0.15, 0.06 }, { 0.3127, 0.329 }
};

/// SMPTE RP 177: the primaries add up to white, whose Y is 1.
double3x3 xyzFromRgb(Chromaticities const& space);

/// Bradford's matrix of XYZ: how a colour looks under another white.
double3x3 whiteAdaptation(double2 from, double2 to);

/// White stays white. Nothing if the chromaticities span no space of colours, or one so thin that rounding counts.
std::optional<double3x3> rec709FromRgb(Chromaticities const& space);

/// Whether they are those of Rec. 709, each number within `tolerance`.
bool isRec709(Chromaticities const& space, double tolerance);

} // namespace filament_core
