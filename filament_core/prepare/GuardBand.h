// SPDX-License-Identifier: Apache-2.0
/// GuardBand: whether a view needs the pixels that it may draw around its image (Effects::guardBand), which are cut off
/// before exposure, lens and tone mapper.
///   In      what the view asks for, and what is in the scene, in view or not: it decides how large the view is drawn.
///   Thread  the app thread, between changes of the scene.   Memory: none.   Fails: never.
#pragma once

#include <filament_core/View.h>

namespace filament_core::scene {
struct SceneData;
}

namespace filament_core::prepare {

/// Whether an effect that comes before the cut may read off-screen pixels.
bool looksBesidePicture(scene::SceneData const& scene, Quality const& quality, Effects const& effects);

} // namespace filament_core::prepare
