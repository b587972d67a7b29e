// SPDX-License-Identifier: Apache-2.0
/// Draw lists -> draw commands. Pipelines are chosen first, outside of the pass; recording then only reads.
///   Thread  choosing: the app thread. recordDraws(): any, into a buffer of its own. recordDrawRanges(): as the pass.
///   Bits    a range binds everything that its first draw needs, so that the stream does not depend on who recorded it.
///   Cost    bench/filament_core/passes: state that did not change since the last draw is not recorded again.
#pragma once

#include "filament_core/base/Arena.h"
#include "filament_core/passes/FrameData.h"
#include "filament_core/passes/Pipelines.h"
#include "filament_core/prepare/FramePacket.h"
#include "framegraph/PassContext.h"

#include <span>

namespace filament::passes {

/// Parallel to `draws`; none where a draw has no pipeline.
std::span<const backend::PipelineHandle> choosePipelines(Arena& arena, PipelineCache& pipelines,
                                                         backend::CommandBuffer& setup, uint32_t slot,
                                                         std::span<const prepare::DrawCall> draws, uint8_t variant);

/// What all draws of a pass share.
struct DrawContext {
    backend::BindGroupHandle viewGroup;
    backend::BufferHandle instanceIds;
};

/// About 10 us of recording: what waking a thread for a range is worth.
inline constexpr size_t kDrawsPerRange = 1024;

/// One range, as if nothing were bound. Draws without a pipeline are skipped.
void recordDraws(backend::CommandBuffer& commands, DrawContext const& context, std::span<const prepare::DrawCall> draws,
                 std::span<const backend::PipelineHandle> pipelines);

/// A whole list, in ranges of kDrawsPerRange: on the job system where the frame is recorded with one.
void recordDrawRanges(framegraph::PassContext& pass, DrawContext const& context,
                      std::span<const prepare::DrawCall> draws, std::span<const backend::PipelineHandle> pipelines);

} // namespace filament::passes
