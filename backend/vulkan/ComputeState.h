// SPDX-License-Identifier: Apache-2.0
/// ComputeState: what the stream has bound outside of passes, for dispatches.
///   By handle: unlike inside of a pass, what is bound here may be destroyed before it is used.
///   Thread  the driver thread.
///   Fails   prepareDispatch() says no when something that the pipeline needs is missing or failed to be created.
///   Cost    everything is bound again for each dispatch: there are few.
#pragma once

#include "backend/api/Commands.h"
#include "backend/api/Slots.h"
#include "backend/vulkan/Descriptors.h"
#include "backend/vulkan/Pipeline.h"

#include <array>

namespace filament_core::backend::vulkan {

class ComputeState {
public:
    ComputeState(Slots<PipelineHandle, Pipeline> const& pipelines, Slots<BindGroupHandle, BindGroup> const& groups)
            : mPipelines(pipelines), mBindGroups(groups) {}

    /// Nothing is bound any more: where a pass begins or ends.
    void reset();
    void setPipeline(PipelineHandle pipeline) { mPipeline = pipeline; }
    void setGroup(CmdBindGroup const& group) { mGroups[group.index] = group; }

    /// Finds what is bound; false: skip the dispatch.
    bool prepareDispatch();
    /// After prepareDispatch().
    void bind(VolkDeviceTable const& fn, VkCommandBuffer commands) const;

private:
    Slots<PipelineHandle, Pipeline> const& mPipelines;
    Slots<BindGroupHandle, BindGroup> const& mBindGroups;
    PipelineHandle mPipeline;
    std::array<CmdBindGroup, kMaxBindGroups> mGroups{};

    // of the dispatch being recorded
    Pipeline const* mFoundPipeline = nullptr;
    std::array<BindGroup const*, kMaxBindGroups> mFoundGroups{};
};

} // namespace filament_core::backend::vulkan
