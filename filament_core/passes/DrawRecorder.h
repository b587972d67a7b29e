// SPDX-License-Identifier: Apache-2.0
/// Draw lists -> draw commands. Pipelines are chosen first, outside of the pass; recording then only reads.
///   Thread  choosePipelines(), recordDrawRanges(): as the pass. recordDraws(): any, into a buffer of its own.
///   Bits    a range binds everything that its first draw needs, so the stream does not depend on which thread recorded
///           it.
///   Cost    bench/filament_core/passes: state that did not change since the last draw is not recorded again.
#pragma once

#include "base/Arena.h"
#include "filament_core/passes/FrameData.h"
#include "filament_core/passes/PipelineSource.h"
#include "filament_core/prepare/FramePacket.h"
#include "framegraph/PassContext.h"
#include "shaders/package/GroupLayouts.h"

#include <array>
#include <span>

namespace filament_core::passes {

/// About 10 us of recording: enough to make waking a thread for a range worthwhile.
inline constexpr size_t kDrawsPerRange = 1024;

/// The instance ids of all draws: 0, 1, 2, ... kObjectsPerWindow - 1, where an object has one record; then 0, 2, 4, ...
/// kObjectsPerWindow - 2, the first records of objects with two.
inline constexpr uint32_t kFirstPairId = shader::kObjectsPerWindow;

/// Parallel to `draws`; none if a draw has no pipeline. Call in `beforePass`: missing pipelines are recorded into its
/// commands, in drawing order; for a frame that is only expected all are none. Looks up in ranges, on the job system if
/// there is one.
/// `fading`: for levels of detail that fade; elsewhere as `slot`.
struct DrawSlots {
    uint32_t slot = 0, fading = 0;
    DrawSlots(uint32_t all) : slot(all), fading(all) {} // NOLINT(google-explicit-constructor): most have one
    DrawSlots(uint32_t others, uint32_t ofFading) : slot(others), fading(ofFading) {}
    uint32_t of(prepare::DrawCall const& draw) const { return draw.fade != 0 ? fading : slot; }
};
std::span<const backend::PipelineHandle> choosePipelines(framegraph::PassContext& pass, Arena& arena,
                                                         PipelineSource const& pipelines, DrawSlots slots,
                                                         std::span<const prepare::DrawCall> draws, uint8_t variant,
                                                         prepare::ChannelLists const& channels = {});

/// Shared by all draws of a pass.
struct DrawContext {
    ViewGroup view;
    std::array<backend::BindGroupHandle, shader::kSurfaceKinds> passGroups; ///< by shader::PassKind
    backend::BufferHandle instanceIds;
    std::span<const backend::CmdBindGroup> deformations; ///< by DrawCall::deformation
    TextureFilter textureFilter = TextureFilter::AsAuthored;
    prepare::ChannelLists channels{}; ///< of the view; its lists are in `view`
    bool readsFields = false;         ///< irradiance fields: draws that have one are drawn object by object
    bool hasPairs = false;            ///< ObjectList::hasLastFrames
};

/// One range, starting with nothing bound. Draws without a pipeline are skipped.
void recordDraws(backend::CommandBuffer& commands, DrawContext const& context, std::span<const prepare::DrawCall> draws,
                 std::span<const backend::PipelineHandle> pipelines);

/// A whole list, in ranges of kDrawsPerRange: on the job system if the frame is recorded with one.
void recordDrawRanges(framegraph::PassContext& pass, DrawContext const& context,
                      std::span<const prepare::DrawCall> draws, std::span<const backend::PipelineHandle> pipelines);

} // namespace filament_core::passes
