// SPDX-License-Identifier: Apache-2.0
/// What the boxes of reflection probes and of irradiance grids have in common.
#pragma once

#include "base/Assert.h"

#include <filament_core/Math.h>

#include <cmath>

namespace filament_core::engine {

inline constexpr float kLargestLightBoxMeters = 1e9f; ///< sides and their products stay far from infinity

inline bool isRotation(float3x3 const& axes) {
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j <= i; ++j)
            if (!(std::abs(glm::dot(axes[i], axes[j]) - (i == j ? 1.0f : 0.0f)) < 1e-3f)) return false;
    }
    return true;
}

/// Fails where a ReflectionProbeDesc or an IrradianceGridDesc has a box that none can have.
template <class Desc>
void checkLightBox(Desc const& desc) {
    const double3 center = desc.centerWorld;
    const float3 half = desc.halfExtentMeters;
    const float shortest = glm::min(half.x, glm::min(half.y, half.z));
    const float longest = glm::max(half.x, glm::max(half.y, half.z));
    FILAMENT_ASSERT(std::isfinite(center.x) && std::isfinite(center.y) && std::isfinite(center.z),
                    "centerWorld is finite");
    FILAMENT_ASSERT(shortest > 0 && longest <= kLargestLightBoxMeters && !glm::any(glm::isnan(half)),
                    "halfExtentMeters is > 0 and at most 1e9");
    FILAMENT_ASSERT(isRotation(desc.worldFromBox), "worldFromBox holds three unit vectors at right angles");
    FILAMENT_ASSERT(desc.blendMeters >= 0 && desc.blendMeters <= kLargestLightBoxMeters,
                    "blendMeters is >= 0 and at most 1e9");
    FILAMENT_ASSERT(desc.intensity >= 0 && desc.intensity <= 1e9f, "intensity is >= 0 and at most 1e9");
}

} // namespace filament_core::engine
