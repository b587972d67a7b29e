// SPDX-License-Identifier: Apache-2.0
/// prepareView: what one view sees of a scene -> ViewPacket, on the job system.
///   In      the current scene, the view, and the settings of the frame. For several views of a frame: one call each,
///           in turn.
///   Out     the packet, and the visible draws: deformations are placed for all views together.
///   Thread  the thread that owns the arena; it takes part in the work until all is done.
///   Memory  the arena only.
///   Bits    the same for any number of workers: jobs are pure functions of index ranges.
///   Fails   std::bad_alloc. Cost: bench/filament_core/prepare.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/CullRenderables.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/prepare/ViewInput.h"
#include "jobsystem/JobSystem.h"

#include <optional>

namespace filament_core::prepare {

struct PreparedView {
    ViewPacket packet;
    VisibleItems visible;
    std::optional<uint32_t> sunRecord;      ///< of scene.lights: the sun of the uniforms
    std::span<const uint32_t> lightRecords; ///< of scene.lights: those of packet.lights
    bool hasChannels = false;               ///< some light does not shine on everything: see LightChannels.h
};

PreparedView prepareView(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewInput const& view,
                         FrameSettings const& settings, LevelChoice const& levels = {});

} // namespace filament_core::prepare
