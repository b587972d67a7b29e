// SPDX-License-Identifier: Apache-2.0
/// Tone-mapping pass: scene-linear light -> what an 8-bit display buffer stores.
///   Reads   targets.color, at the pixel that it writes alone, so that it can be a subpass of the colour pass; where the
///           graph cannot merge it (MSAA, a device without subpass inputs) it samples instead. Same arithmetic, same bits.
///   Writes  targets.output.
#pragma once

#include "filament_core/passes/FrameTargets.h"
#include "filament_core/passes/FullScreenPass.h"

namespace filament::passes {

void addToneMapPass(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets const& targets);

} // namespace filament::passes
