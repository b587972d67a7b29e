// SPDX-License-Identifier: Apache-2.0
/// cullBlocks: which renderables a view may see, by the boxes of the blocks that they rest in (scene::RestingBlocks).
///   In      the blocks of a scene as they are now, and a frustum.
///   Out     a bit for each renderable: not set only if the test of its own box (Frustum.h) finds it outside of a
///           plane, too. A block counts as outside of a plane only by more than all roundings of both tests together.
///   Thread  jobs over ranges of blocks.   Memory: the arena, a bit for each renderable, a byte for eight blocks.
///   Fails   std::bad_alloc.   Cost: 2 ns a block, 1 ns for each member of those in view.
#pragma once

#include "base/Arena.h"
#include "base/math/Frustum.h"
#include "filament_core/scene/RestingBlocks.h"
#include "jobsystem/JobSystem.h"

#include <span>

namespace filament_core::prepare {

/// By position: bit i of word w is renderable 64 w + i. Empty: every renderable may be seen, or too many for it to pay.
std::span<const uint64_t> cullBlocks(jobs::JobSystem& jobs, Arena& arena, scene::RestingBlocks const& blocks,
                                     Frustum const& frustum, double3 const& cameraWorld);

} // namespace filament_core::prepare
