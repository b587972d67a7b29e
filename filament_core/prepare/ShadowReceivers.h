// SPDX-License-Identifier: Apache-2.0
/// What shadows fall on in a view, and how far a scene extends in the space of a light.
///   Thread  jobs over ranges.   Memory: the arena.   Fails: std::bad_alloc.
///   Bits    minima and maxima: the same for any number of workers.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/FitShadows.h"
#include "filament_core/prepare/FramePacket.h"
#include "jobsystem/JobSystem.h"

namespace filament_core::prepare {

/// Lit or shadow-catching surfaces in view that receive shadows.
struct ShadowReceivers {
    uint32_t count = 0;
    double3 min{ 1e300 }, max{ -1e300 };  ///< in the world
    double nearest = 1e300, farthest = 0; ///< metres in front of the camera, not behind its near plane

    double3 center() const { return (min + max) * 0.5; }
    double3 halfExtent() const { return (max - min) * 0.5; }
};

ShadowReceivers findReceivers(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene,
                              ViewPacket const& view, ViewSpace const& space, ShadowFilter filter);

/// What volumetric fog shows of shadows: the part of the view that is nearer than so many metres.
void addFog(ShadowReceivers& receivers, ViewSpace const& space, float meters);

/// Of all renderables in these layers that can be drawn.
LightSpaceBox sceneInLightSpace(jobs::JobSystem& jobs, Arena& arena, scene::Renderables const& renderables,
                                double3x3 const& worldFromLight, Layers visibleLayers);

} // namespace filament_core::prepare
