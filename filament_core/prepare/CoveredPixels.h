// SPDX-License-Identifier: Apache-2.0
/// CoveredPixels: the part of the screen that objects cover, by their boxes.
///   Thread  any; pure.   Memory: the arena.   Fails: never.
#pragma once

#include "backend/api/Descriptions.h"
#include "base/Arena.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/prepare/PixelBox.h"
#include "filament_core/prepare/ViewConstants.h"
#include "filament_core/scene/Renderables.h"
#include "jobsystem/JobSystem.h"

#include <cstdint>

namespace filament_core::prepare {

/// What a renderable covers; all of the view if its box does not say.
PixelBox coveredBy(scene::Renderables const& renderables, uint32_t renderable, ViewSpace const& space, uint2 view);

/// Pixels around what is covered, for filters that look at neighbours.
inline constexpr uint32_t kCoverMargin = 8;

/// Of `size`: all that the objects of the view cover, and kCoverMargin pixels around it. Begins and ends at even
/// pixels, or with the view; never empty.
backend::Rect coveredPixels(jobs::JobSystem& jobs, Arena& arena, scene::SceneData const& scene, ViewPacket const& view,
                            ViewSpace const& space, uint2 size);

} // namespace filament_core::prepare
