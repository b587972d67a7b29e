// SPDX-License-Identifier: Apache-2.0
#include "base/math/Frustum.h"

namespace filament_core {

Frustum frustumFromClip(float4x4 const& clipFromWorld) {
    const float4x4 rows = glm::transpose(clipFromWorld);
    Frustum frustum{ { rows[3] + rows[0], rows[3] - rows[0], rows[3] + rows[1], rows[3] - rows[1],
                       rows[3] - rows[2] } };
    for (float4& plane : frustum.planes) plane /= glm::length(float3(plane));
    return frustum;
}

} // namespace filament_core
