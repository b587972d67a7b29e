// SPDX-License-Identifier: Apache-2.0
/// prepareFrame: scene and view -> FramePacket, on the job system.
///   In      the scene as it is now, the view, the pixel size.     Out: one FramePacket in `arena`.
///   Thread  the app thread; it works along with the workers until all are done.
///   Memory  the arena only.
///   Bits    the packet is the same for any number of workers: jobs are pure functions of index ranges.
///   Fails   never. Cost: bench/filament_core/prepare.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/prepare/ViewInput.h"
#include "jobsystem/JobSystem.h"

namespace filament::prepare {

FramePacket prepareFrame(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewInput const& view);

} // namespace filament::prepare
