// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/PanelLayout.h"

#include <algorithm>
#include <cmath>

namespace filament_core::view {

PanelLayout layOutPanels(uint2 size, float scale, bool showsPanels) {
    const float2 whole(size);
    const float wanted = (kLeftColumn + kRightColumn) * scale, most = std::floor(whole.x * 2 / 3);
    const float shrink = std::min(1.0f, most / wanted), least = kLeastColumn * scale;
    float left = std::floor(kLeftColumn * scale * shrink), right = std::floor(kRightColumn * scale * shrink);
    if (left < least || right < least) {
        left = 0;
        right = std::min(kRightColumn * scale, most) < least ? 0 : std::floor(std::min(kRightColumn * scale, most));
    }
    if (!showsPanels) left = right = 0;
    return { .left = { .position = { 0, 0 }, .size = { left, left > 0 ? whole.y : 0 } },
             .right = { .position = { whole.x - right, 0 }, .size = { right, right > 0 ? whole.y : 0 } },
             .picture = { .position = { left, 0 }, .size = { whole.x - left - right, whole.y } } };
}

} // namespace filament_core::view
