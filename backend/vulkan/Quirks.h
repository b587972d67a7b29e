// SPDX-License-Identifier: Apache-2.0
/// Quirks: where a driver differs from what the specification lets us expect. One struct, one place that fills it, and
/// a removal note for each.
#pragma once

#include "backend/vulkan/VulkanApi.h"

namespace filament::backend::vulkan {

struct Quirks {
    /// lavapipe takes a timestamp when it has parsed the commands before it, not when they are done, so a pass that is
    /// still rasterising seems free. A full barrier in front makes it wait.
    /// Remove when a timer around a pass of 1000 ALU operations a pixel reads more than 1 ms without it (Mesa 22.3:
    /// 0.0).
    bool timestampsNeedBarrier = false;
};

inline Quirks quirksOf(VkDriverId driver) { return { .timestampsNeedBarrier = driver == VK_DRIVER_ID_MESA_LLVMPIPE }; }

} // namespace filament::backend::vulkan
