// SPDX-License-Identifier: Apache-2.0
/// Placement: the transform of a renderable, as frames read it.
#pragma once

#include "base/math/Math.h"

#include <array>

namespace filament_core::scene {

/// worldFromObject as the shaders see it: the linear part rounded to float once, here, and the translation in double
/// precision, because the camera is subtracted first.
struct alignas(64) Placement {
    std::array<float3, 3> rows{}; ///< of the linear part
    float side = 1;               ///< 1 + the instance index; negative if it mirrors
    double3 translation{ 0.0 };
};
static_assert(sizeof(Placement) == 64, "one cache line a renderable");

} // namespace filament_core::scene
