// SPDX-License-Identifier: Apache-2.0
/// acesReference: the Academy Color Encoding System 1.0.3 for a Rec. 709 display of 100 cd/m^2 in a dim surround: its
/// reference rendering transform (RRT) and output transform (ODT) as its transforms in CTL define them, in double
/// precision.
///   In      linear Rec. 709, scene-referred: 0.18 is middle grey. Any finite values.
///   Out     linear Rec. 709 of the display, [0, 1], before the transfer function.
///   Thread  any.   Fails: never.   Cost: about 2 microseconds; tone tables bake it.
#pragma once

#include <filament_core/Math.h>

namespace filament_core {

double3 acesReference(double3 light);

} // namespace filament_core
