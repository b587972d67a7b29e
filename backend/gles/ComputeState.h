// SPDX-License-Identifier: Apache-2.0
/// ComputeState: what the stream has bound outside of passes, for dispatches.
///   By handle: unlike inside of a pass, what is bound here may be destroyed before it is used.
///   Thread  the driver thread, context current.
///   Fails   prepareDispatch() says no when something that the pipeline needs is missing or could not be made.
///   Cost    everything is bound again for each dispatch: there are few, and ContextState knows what the context has.
#pragma once

#include "backend/api/Slots.h"
#include "backend/gles/Descriptors.h"
#include "backend/gles/Pipeline.h"

namespace filament_core::backend::gles {

class ComputeState {
public:
    ComputeState(ContextState& context, Slots<PipelineHandle, Pipeline> const& pipelines,
                 Slots<BindGroupHandle, BindGroup> const& groups)
            : mContext(context), mPipelines(pipelines), mBindGroups(groups), mDescriptors(context) {}

    /// Nothing is bound any more: where a pass begins or ends.
    void reset();
    void setPipeline(PipelineHandle pipeline) { mPipeline = pipeline; }
    void setGroup(CmdBindGroup const& group) { mGroups[group.index] = group; }

    /// Makes the context ready; false: skip the dispatch.
    bool prepareDispatch();

private:
    ContextState& mContext;
    Slots<PipelineHandle, Pipeline> const& mPipelines;
    Slots<BindGroupHandle, BindGroup> const& mBindGroups;
    Descriptors mDescriptors;
    PipelineHandle mPipeline;
    std::array<CmdBindGroup, kMaxBindGroups> mGroups{};
};

} // namespace filament_core::backend::gles
