// SPDX-License-Identifier: Apache-2.0
/// The Pass bind group: the size of a pass's target, and the engine's textures that its materials read.
///   Use     declareTarget() while the pass declares itself, passGroup() in its `beforePass`.
///   Thread  the app thread.
///   Memory  the graph's pool keeps the groups; equal ones are made once (PassContext::bindGroup()).
#pragma once

#include "filament_core/passes/FrameContext.h"
#include "framegraph/PassContext.h"
#include "shaders/package/GroupLayouts.h"

#include <array>

namespace filament_core::passes {

/// For a pass that draws to `level` of `texture`, or draws `samples` a pixel and resolves them to it.
PassBlock declareTarget(FrameContext const& context, framegraph::GraphTextureDesc const& texture, uint8_t level = 0,
                        uint8_t samples = 1);

/// The same for a pass whose materials refract or reflect the scene colour.
PassBlock declareTargetBeforePicture(FrameContext const& context, framegraph::GraphTextureDesc const& texture,
                                     uint8_t samples, prepare::SceneColorCopy const& copy);

/// For surfaces of which a debug view shows a value.
PassBlock declareDebugTarget(FrameContext const& context, framegraph::GraphTextureDesc const& texture,
                             DebugView debugView, uint8_t samples = 1);

/// For a shadow map with texels for all colours, or for colour channel 1, 2 or 3 alone.
PassBlock declareShadowTarget(FrameContext const& context, uint32_t size, uint32_t channel);

/// What of surfaces that section planes cut is drawn (SlabCaps.h): negative numbers in the place of colour channels, as
/// shaders/material/surface/section.glsl has them.
enum class SectionPart : int8_t { FirstSurfaces = -1, SlabCaps = -2 };
/// The block of a pass with that instead of what is left.
PassBlock declareSectionPart(FrameContext const& context, PassBlock of, SectionPart part);

/// What materials read of shadow maps; none by default.
struct PassShadows {
    framegraph::TextureId maps;
    PassBlock block;         ///< shader::ShadowUniforms
    bool hasMoments = false; ///< which are filtered; depths are not
};
PassShadows declareShadows(FrameContext const& context, framegraph::TextureId maps);

/// shader::ProbeUniforms of the main view; empty: it has no reflection probes.
PassBlock declareProbes(FrameContext const& context);

/// What a pass declares to read of what others have drawn; none by default: its materials then have white or black
/// instead.
struct PassTextures {
    PassShadows shadows{};
    framegraph::TextureId occlusion{};   ///< FrameTargets::ambientOcclusion
    framegraph::TextureId linearDepth{}; ///< FrameTargets::linearDepth
    framegraph::TextureId sceneColor{};  ///< FrameTargets::sceneColor
    uint8_t sceneColorLevels = 0;        ///< of `sceneColor`: those that are drawn
    framegraph::BufferId fogCells{};     ///< FrameTargets::fogCells
    PassBlock probes{};                  ///< declareProbes()
};
void declareReads(framegraph::PassBuilder& pass, PassTextures const& textures);

backend::BindGroupHandle passGroup(framegraph::PassContext& pass, FrameContext const& context, shader::PassKind kind,
                                   PassBlock target, PassTextures const& textures = {});
/// One for each kind of material that surfaces have.
std::array<backend::BindGroupHandle, shader::kSurfaceKinds> surfaceGroups(framegraph::PassContext& pass,
                                                                          FrameContext const& context, PassBlock target,
                                                                          PassTextures const& textures = {});

} // namespace filament_core::passes
