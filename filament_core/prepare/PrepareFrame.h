// SPDX-License-Identifier: Apache-2.0
/// prepareFrame: scene and views -> FramePacket, on the job system. The table of contents of this room.
///   In      the scene as it is now; the views, the main one first, one at least; what the atlas of shadow maps and the
///           array of probes hold; the previous frame of the same renderer.
///   Out     one FramePacket in `arena`: its views in the same order, then those of the shadow maps that are drawn,
///           then that of moving objects, if an effect needs it.
///   Thread  the app thread, which takes part in the work until all is done.
///   Memory  the arena only.
///   Bits    the packet is the same for any number of workers, and a view's part of it does not depend on other views;
///           deformations are placed for all views together.
///   Fails   std::bad_alloc. Cost: that of its views, one after the other; bench/filament_core/prepare.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/prepare/LastFrame.h"
#include "filament_core/prepare/ViewInput.h"
#include "jobsystem/JobSystem.h"

#include <span>

namespace filament_core::prepare {

class FieldCache;

/// `fields`: of irradiance grids, known from earlier frames; null: none are, or will be.
FramePacket prepareFrame(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene,
                         std::span<const ViewInput> views, ShadowAtlas const& held = {}, LastFrame const& last = {},
                         HeldProbes const& probes = {}, FieldCache* fields = nullptr);

} // namespace filament_core::prepare
