// SPDX-License-Identifier: Apache-2.0
/// hideOccluded: takes what lies behind large occluders out of the opaque draws of a view. The image keeps its bits: a
/// box is left out only if every pixel that it could cover shows something nearer (OcclusionBuffer.h).
///   In      the finished packet of a view of a camera, or of a shadow map, with one sample a pixel.
///   Out     a packet with fewer opaque draws; transparent draws stay, and so does what other steps of the frame found.
///   Chosen  the occluders that look largest, at most kMostOccluders; without one of kSmallestPixels nothing is done,
///           and in scenes without any the objects are not even visited.
///   Thread  jobs over ranges; the bits are the same for any number of workers.   Memory: the arena.
///   Fails   std::bad_alloc.   Cost: occlusion_bench.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/prepare/ViewConstants.h"
#include "jobsystem/JobSystem.h"

namespace filament_core::prepare {

inline constexpr size_t kMostOccluders = 256;
/// Across an occluder: so many pixels, or this share of a shadow map, whichever is less.
inline constexpr float kSmallestPixels = 32, kSmallestShare = 1.0f / 16;
/// With fewer opaque objects drawing them all costs less than looking for hidden ones.
inline constexpr size_t kObjectsWorthHiding = 64;

void hideOccluded(jobs::JobSystem& jobs, Arena& arena, scene::Renderables const& renderables, ViewSpace const& space,
                  ViewInput const& view, ViewPacket& packet);

} // namespace filament_core::prepare
