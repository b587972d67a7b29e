// SPDX-License-Identifier: Apache-2.0
/// Shadow moments: what the filters vsm and evsm read instead of depths: two or four moments of the shadow maps,
/// blurred, with mip levels (shaders/lib/moments.glsl).
///   Passes  "shadow moments", "shadow blur", "shadow mips": only over the tiles of maps that this frame draws. Tiles
///           that an earlier frame has drawn keep theirs.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

namespace filament_core::passes {

/// What the packet asks for (ShadowPacket::moments): makes targets.shadows the moments of targets.shadowDepths.
/// Otherwise nothing.
void addShadowMoments(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);

} // namespace filament_core::passes
