// SPDX-License-Identifier: Apache-2.0
/// Where the last picture shows what a pixel of this one shows.
///   Thread  any; pure.   Memory: none.   Fails: never.
#pragma once

#include "filament_core/passes/FrameContext.h"

namespace filament::passes {

/// From pixels and depths of this frame, in homogeneous coordinates.
double4x4 worldFromPixel(FrameContext const& context);

/// The same to coordinates of the texture of the last picture, whose upper left part `end` the picture fills.
float4x4 lastFromPixel(FrameContext const& context, double2 end);

} // namespace filament::passes
