// SPDX-License-Identifier: Apache-2.0
/// SlabCaps: caps where a view ray enters and leaves what section planes keep, all of it inside of a solid: of slabs
/// and boxes (SectionCut::Each). No surface is there; the first one behind, in what is cut off, tells: a back face if
/// the ray is inside.
///   Draws   into the depth of a pass, before all else in it: 1. the first surfaces behind where rays enter, of what
///           planes cut; 2. of those the back faces behind what is left, which mark their samples in the stencil;
///           3. these once more, which show caps: what is lit writes no stencil, so that devices test its depth first;
///           4. infinite depth and no mark elsewhere. So caps have the depth of their back face, as those of single
///           planes have (section_api.glsl), and front faces that are cut off hide nothing but caps.
///   Needs   depth with a stencil: needsStencil().
///   Skips   views without such rays: showsSlabCaps().
///   Shadow maps have the same (ShadowPass): light ends where it leaves the solid, not the slab.
#pragma once

#include "filament_core/passes/ChosenDraws.h"

namespace filament_core::passes {

/// Of `draws`, those of materials with section planes.
std::span<const prepare::DrawCall> cutOpen(FrameContext const& context, std::span<const prepare::DrawCall> draws);

/// Whether an opaque surface of the main view may be closed by caps.
bool showsCaps(FrameContext const& context);
/// The same of caps that these draws find.
bool showsSlabCaps(FrameContext const& context);

/// Whether the depth of passes that show the main view has a stencil.
inline bool needsStencil(FrameContext const& context) {
    return context.packet.demand.needs(prepare::Effect::Stencil) || showsSlabCaps(context);
}

/// Of the pass's block; none by default: there are no such caps.
struct SlabBlocks {
    PassBlock first, marks, caps;
};
SlabBlocks declareSlabCaps(FrameContext const& context, PassBlock target);

struct ChosenSlabCaps {
    ChosenDraws first, marks;
    ChosenDraws caps; ///< empty where depth alone is drawn
    backend::PipelineHandle farDepth;
};
/// `slot`: of the opaque surfaces of the pass, which are drawn with `textures`, `variant` and `channels`.
ChosenSlabCaps chooseSlabCaps(framegraph::PassContext& pass, FrameContext const& context, PassSlot const& slot,
                              SlabBlocks const& blocks, std::span<const prepare::DrawCall> surfaces,
                              PassTextures const& textures = {}, uint8_t variant = 0,
                              prepare::ChannelLists const& channels = {});
/// `draws`: of the surfaces of the pass.
void recordSlabCaps(framegraph::PassContext& pass, DrawContext draws, ChosenSlabCaps const& chosen);

} // namespace filament_core::passes
