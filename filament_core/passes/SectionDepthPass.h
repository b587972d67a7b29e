// SPDX-License-Identifier: Apache-2.0
/// SectionDepthPass: the depths of caps, for whatever reads depths.
///   In      the depth of a view, in which a cap has the depth of the back face that it is drawn on (section_api.glsl).
///   Out     the same depths in R32F, with those of caps in their place.
///   Draws   a copy, then the opaque surfaces that section planes cut, where that depth is theirs.
///   Skips   views without caps: showsCaps() of SlabCaps.h.
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "filament_core/passes/FrameTargets.h"
#include "filament_core/passes/SlabCaps.h"

namespace filament_core::passes {

/// `depth`: with one sample a pixel.
framegraph::TextureId addSectionDepthPass(framegraph::FrameGraph& graph, FrameContext const& context,
                                          framegraph::TextureId depth);

/// The same if the view shows caps; otherwise `depth` itself. Resolved depths of several samples stay those of back
/// faces.
inline framegraph::TextureId depthWithCaps(framegraph::FrameGraph& graph, FrameContext const& context,
                                           framegraph::TextureId depth) {
    const bool hasCaps = context.settings().samples == 1 && showsCaps(context);
    return hasCaps ? addSectionDepthPass(graph, context, depth) : depth;
}

} // namespace filament_core::passes
