// SPDX-License-Identifier: Apache-2.0
/// Focus: how blurred a lens shows what lies at a distance, and how far away what is visible lies.
///   Formula a thin lens of focal length f and f-number N that is focused at s images a point at d as a disc with the
///           diameter f^2 |d - s| / (N d (s - f)): Potmesil and Chakravarty 1981, "A Lens and Aperture Camera Model for
///           Synthetic Image Generation". The sensor is 24 mm high, and f follows from the field of view.
///   Thread  any; pure.   Memory: the arena.   Fails: never.
#pragma once

#include "filament_core/prepare/FramePacket.h"
#include "filament_core/prepare/ViewConstants.h"
#include "jobsystem/JobSystem.h"

namespace filament_core::prepare {

/// Of a view `height` pixels high. Distances nearer than the focal length are focused as if they were just beyond it.
Focus focusOf(Camera const& camera, DepthOfField const& depthOfField, uint32_t height);

/// In pixels; < 0 for what is nearer than the focus. `distance` along the view, > 0; infinity is fine.
double blurRadius(Focus const& focus, double distance);

/// Along the view, of the boxes of what is visible.
struct VisibleDistances {
    double nearest = HUGE_VAL, farthest = 0;
};
VisibleDistances visibleDistances(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene,
                                  ViewPacket const& view, ViewSpace const& space);

} // namespace filament_core::prepare
