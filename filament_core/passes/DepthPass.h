// SPDX-License-Identifier: Apache-2.0
/// Depth prepass: the depths of opaque and masked objects, before anything is shaded.
///   Draws   targets.depth, one sample a pixel: the opaque list of the main view by variants that compute nothing but
///           positions and what cuts holes. Then targets.linearDepth, if materials read them, and their pyramid, if
///           rays are marched through it: level n has the nearest distance of 2^n x 2^n pixels (Uludag 2014, "Hi-Z
///           Screen-Space Cone-Traced Reflections", GPU Pro 5).
///   Why     effects that look at the surroundings of a pixel read them; and with one sample a pixel the colour pass
///           continues with this depth: its test, which lets equal depths pass, then shades each pixel once.
///   Skips   all of it, unless the frame's demand needs it.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"
#include "filament_core/passes/PipelineCache.h"

namespace filament_core::passes {

/// `shading`: depthOfViewKey().
PassSlot depthSlot(prepare::FrameSettings const& settings, ShadingKey shading);

/// Levels of the pyramid of distances for a view of this size; at most 7, and the smallest is two texels high or more,
/// if there are several.
uint8_t pyramidLevels(uint2 view);

/// A pass that draws the opaque list of the main view to depth, in an image of `size` pixels.
framegraph::TextureId addDepthOfView(framegraph::FrameGraph& graph, FrameContext const& context, uint2 size,
                                     std::string_view name);

void addDepthPass(framegraph::FrameGraph& graph, FrameContext const& context, FrameTargets& targets);

} // namespace filament_core::passes
