// SPDX-License-Identifier: Apache-2.0
/// Picture passes: copy what is drawn so far for what refracts it, and blur the copy, level by level.
///   Reads   targets.color, and a depth of one sample a pixel.
///   Draws   targets.picture: rgb: pre-exposed light, a: 1 / distance along the view in 1/m, 0 where nothing is. Only the
///           rectangle and the levels of ViewPacket::picture; what lies outside of the rectangle is 0.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

namespace filament::passes {

void addPicturePasses(framegraph::FrameGraph& graph, FrameContext const& context, framegraph::TextureId depth,
                      FrameTargets& targets);

} // namespace filament::passes
