// SPDX-License-Identifier: Apache-2.0
/// Tone-mapping pass: scene-linear light -> what an 8-bit display buffer stores.
///   Reads only the pixel that it writes, so that it can be a subpass of the colour pass; where the graph cannot merge
///   it (MSAA, a device without subpass inputs) it samples instead. Same arithmetic, same bits.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

namespace filament::passes {

/// From targets.color to targets.output.
void addToneMapPass(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets const& targets);

} // namespace filament::passes
