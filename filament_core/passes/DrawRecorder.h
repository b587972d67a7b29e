// SPDX-License-Identifier: Apache-2.0
/// Draw lists -> draw commands. Pipelines are chosen first, outside of the pass; recording then only reads.
///   Thread  choosing: the app thread. Recording: any, into a buffer of its own.
///   Cost    bench/filament_core/passes: state that did not change since the last draw is not recorded again.
#pragma once

#include "filament_core/base/Arena.h"
#include "filament_core/passes/FrameData.h"
#include "filament_core/passes/Pipelines.h"
#include "filament_core/prepare/FramePacket.h"

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

/// Returns the number of draws recorded.
uint32_t recordDraws(backend::CommandBuffer& commands, DrawContext const& context,
                     std::span<const prepare::DrawCall> draws, std::span<const backend::PipelineHandle> pipelines);

} // namespace filament::passes
