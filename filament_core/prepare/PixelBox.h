// SPDX-License-Identifier: Apache-2.0
/// PixelBox: what a box covers on the screen.
///   Thread  any; pure.   Memory: none.   Fails: never.
#pragma once

#include "base/math/Math.h"

namespace filament_core::prepare {

/// In pixels, and possibly outside of the view.
struct PixelBox {
    float2 least{ 0.0f }, most{ 0.0f };
};

PixelBox unionOf(PixelBox a, PixelBox b);

/// All of the view if some of the box is beside or behind the camera.
PixelBox projectedBox(float4x4 const& clipFromWorld, float3 center, float3 halfExtent, uint2 view);

} // namespace filament_core::prepare
