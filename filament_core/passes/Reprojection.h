// SPDX-License-Identifier: Apache-2.0
/// What pixels and their depths say: where they are, and where the scene colour history shows it.
///   Thread  any; pure.   Memory: none.   Fails: never.
#pragma once

#include "filament_core/passes/FrameContext.h"

namespace filament_core::passes {

/// From pixels and depths of this frame, in homogeneous coordinates.
double4x4 worldFromPixel(FrameContext const& context);

/// The same to coordinates of the texture of the scene colour history, whose upper left part `end` it fills.
float4x4 lastFromPixel(FrameContext const& context, double2 end);

/// Whether the projection is parallel.
bool isParallel(float4x4 const& clipFromView);
/// 1 / distance = depth * x + y, for a perspective projection.
float2 inverseOfDepth(float4x4 const& clipFromView);
/// distance = depth * x + y, for a parallel one.
float2 distanceOfDepth(float4x4 const& clipFromView);

} // namespace filament_core::passes
