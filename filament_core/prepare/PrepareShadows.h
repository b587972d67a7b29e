// SPDX-License-Identifier: Apache-2.0
/// prepareShadows: which lights cast shadows in the main view, the maps for them, and what each of them shows.
///   Demand  there is a map only if a surface in view receives shadows, its light reaches that surface and may cast,
///           and something that casts lies in the map. Whatever is in view of the light casts, in view of the camera or
///           not. A map is drawn only if its contents changed: light, casters, fit, size or tile.
///   In      the scene, the main view as it was prepared, and what the atlas holds.
///   Out     the packet, and a view for each map that is drawn. Lights of the main view learn their maps.
///   Thread  the thread that owns the arena; it takes part in the work until all is done.
///   Memory  the arena.   Bits: the same for any number of workers.
///   Fails   std::bad_alloc. Cost: every map culls the scene; without demand, nothing.
#pragma once

#include "filament_core/prepare/FitShadows.h"
#include "filament_core/prepare/PrepareView.h"
#include "filament_core/prepare/ShadowCounts.h"
#include "filament_core/prepare/ShadowMaps.h"

namespace filament_core::prepare {

struct PreparedShadows {
    ShadowPacket packet; ///< ShadowMapPacket::view counts from 0, in `views`
    std::span<const PreparedView> views;
    ShadowCounts counts;
};

/// Changes `main`: its variant, and the lights of its list.
PreparedShadows prepareShadows(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene,
                               ViewInput const& view, FrameSettings const& settings, PreparedView& main,
                               ShadowAtlas const& held);

} // namespace filament_core::prepare
