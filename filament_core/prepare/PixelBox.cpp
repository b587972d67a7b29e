// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PixelBox.h"

#include <cmath>
#include <cstdint>

namespace filament_core::prepare {

PixelBox unionOf(PixelBox a, PixelBox b) { return { glm::min(a.least, b.least), glm::max(a.most, b.most) }; }

PixelBox projectedBox(float4x4 const& clipFromWorld, float3 center, float3 halfExtent, uint2 view) {
    const float2 size(view);
    PixelBox box{ size, float2(0.0f) };
    for (uint32_t corner = 0; corner < 8; ++corner) {
        const float3 sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        const float4 clip = clipFromWorld * float4(center + sign * halfExtent, 1.0f);
        if (!(clip.w > 1e-4f)) return { float2(0.0f), size };
        const float2 pixel = (float2(clip) / clip.w * 0.5f + 0.5f) * size;
        if (!std::isfinite(pixel.x) || !std::isfinite(pixel.y)) return { float2(0.0f), size };
        box = unionOf(box, { pixel, pixel });
    }
    return box;
}

} // namespace filament_core::prepare
