// SPDX-License-Identifier: Apache-2.0
/// ChosenDraws: what a pass that draws one list of surfaces needs to record, chosen before it begins.
///   Use     chooseDraws() in the pass's `beforePass`; then recordDraws() or recordDrawRanges() (DrawRecorder.h).
///   Thread  the app thread.
///   Memory  the arena of the frame.
#pragma once

#include "filament_core/passes/DrawRecorder.h"
#include "filament_core/passes/PassGroup.h"

namespace filament_core::passes {

struct ChosenDraws {
    std::array<backend::BindGroupHandle, shader::kSurfaceKinds> passGroups; ///< by shader::PassKind
    std::span<const prepare::DrawCall> draws;
    std::span<const backend::PipelineHandle> pipelines; ///< choosePipelines() of `draws`
};

/// For programs of the variant 0 that read no textures of the engine.
ChosenDraws chooseDraws(framegraph::PassContext& pass, FrameContext const& context, PassSlot const& slot,
                        PassBlock target, std::span<const prepare::DrawCall> draws);

/// The opaque list of the main view for a pass without the depths of levels of detail that fade: those that appear are
/// drawn as any other.
std::span<const prepare::DrawCall> opaqueWithoutFade(FrameContext const& context);

/// In `execute`: how the main view's surfaces are drawn with their light.
DrawContext shadedDraws(FrameContext const& context,
                        std::array<backend::BindGroupHandle, shader::kSurfaceKinds> const& passGroups);

} // namespace filament_core::passes
