// SPDX-License-Identifier: Apache-2.0
/// Bounding boxes as centre and half extent, and their transformation.
#pragma once

#include "base/math/Math.h"

namespace filament_core {

/// A closed box; a half extent of zero is a point.
struct CenteredBox {
    float3 center{ 0.0f };
    float3 halfExtent{ 0.0f };
};

inline CenteredBox boxFromMinMax(float3 minimum, float3 maximum) {
    return { (minimum + maximum) * 0.5f, (maximum - minimum) * 0.5f };
}

/// Half extent of the smallest axis-aligned box around a transformed box. Arvo 1990, "Transforming axis-aligned
/// bounding boxes", Graphics Gems.
inline float3 transformedHalfExtent(double4x4 const& transform, float3 halfExtent) {
    double3 result(0.0);
    for (int column = 0; column < 3; ++column) {
        result += glm::abs(double3(transform[column])) * static_cast<double>(halfExtent[column]);
    }
    return float3(result);
}

} // namespace filament_core
