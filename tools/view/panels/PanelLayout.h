// SPDX-License-Identifier: Apache-2.0
/// PanelLayout: where the columns of panels are, and the part of the image between them.
///   In      the size of the interface and its scale; sizes below are pixels at scale 1.
///   Limits  on narrow windows both columns shrink alike, so that a third of the width stays free; below kLeastColumn
///           pixels each, only one column is left, then none.
///   Thread  any; pure.
#pragma once

#include <filament_core/Math.h>

namespace filament_core::view {

inline constexpr float kLeftColumn = 330, kRightColumn = 400, kLeastColumn = 180;
inline constexpr float kLeftShare = 0.55f; ///< of the left column's height: the tree; the rest: what is selected

struct PanelRect {
    float2 position{ 0 }, size{ 0 }; ///< pixels; a size of 0: not there
    bool isThere() const { return size.x > 0 && size.y > 0; }
    float2 end() const { return position + size; }
};

struct PanelLayout {
    PanelRect left{}, right{}, picture{};
};

PanelLayout layOutPanels(uint2 size, float scale, bool showsPanels = true);

} // namespace filament_core::view
