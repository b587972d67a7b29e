// SPDX-License-Identifier: Apache-2.0
/// Colour pass: opaque and masked geometry, then the sky where nothing covers it, then blended geometry. If something
/// is refractive, two passes: what it sees, which is then copied (SceneColorCopyPass.h), and the rest over that.
///   Draws   pre-exposed scene-linear light, and a reversed depth buffer that lives only as long as the pass.
///   Skips   the sky if the scene has none; draws without a pipeline.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"

namespace filament_core::passes {

/// Declares the pass; it writes every pixel of targets.color, which is single-sampled, and makes targets.depth. With
/// settings().samples > 1 it draws into a multisampled image and resolves that into targets.color (ResolvePass.h).
void addColorPass(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);

} // namespace filament_core::passes
