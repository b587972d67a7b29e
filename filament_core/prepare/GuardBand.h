// SPDX-License-Identifier: Apache-2.0
/// GuardBand: how many pixels a view draws around its picture, to be cut off before exposure, lens and tone mapper.
///   In      what the view asks for, and what is in the scene, in view or not: it decides how large the view is drawn.
///   Thread  the app thread, between changes of the scene.   Memory: none.   Fails: never.
#pragma once

#include "base/math/Math.h"

#include <filament/View.h>

#include <cstdint>

namespace filament::scene {
struct SceneData;
}

namespace filament::prepare {

/// Whether an effect that comes before the cut may read pixels beside the picture.
bool looksBesidePicture(scene::SceneData const& scene, Quality const& quality, Effects const& effects);

/// Of all views whose effects look beside the picture, and are not drawn with depths that somebody asks for: how many
/// pixels are drawn besides on each side, if `drawn` are those of the picture and `size` those that it shows.
uint32_t guardBand(uint2 drawn, uint2 size, Effects const& effects, Quality const& quality, DebugView debugView);

} // namespace filament::prepare
