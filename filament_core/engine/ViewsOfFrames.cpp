// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/ViewsOfFrames.h"

#include "base/Assert.h"
#include "filament_core/prepare/FrameSettings.h"

#include <cmath>

namespace filament_core::engine {

prepare::ViewInput wholeInputOf(View const& view, Effects effects, uint64_t contents) {
    effects.resolution.scale = float2(1);
    effects.guardBand.enabled = false;
    return prepare::viewInput(view, effects, contents);
}

void checkPlace(View const& view, uint2 target) {
    FILAMENT_ASSERT(view.size.x > 0 && view.size.y > 0, "a view has at least one pixel");
    if (!view.viewport) {
        FILAMENT_ASSERT(view.size == target,
                        "a view without a viewport has the size of its swap chain or render target");
        return;
    }
    const uint2 offset = view.viewport->offset;
    FILAMENT_ASSERT(offset.x <= target.x && view.size.x <= target.x - offset.x && offset.y <= target.y &&
                            view.size.y <= target.y - offset.y,
                    "a viewport lies in its target: offset + View::size is at most the target's size");
    const float4 clear = view.viewport->clearColor;
    FILAMENT_ASSERT(std::isfinite(clear.x + clear.y + clear.z + clear.w), "a viewport's clearColor is finite");
}

void checkNumbers(View const& view, Format target) {
    FILAMENT_ASSERT((view.aov != Aov::None) == (target == Format::RGBA32F),
                    "View::aov is drawn to a render target of RGBA32F, and nothing else is");
    FILAMENT_ASSERT(view.aov == Aov::None || view.debugView == DebugView::None,
                    "a view has either an aov or a debugView");
}

} // namespace filament_core::engine
