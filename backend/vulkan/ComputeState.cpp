// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/ComputeState.h"

namespace filament_core::backend::vulkan {

void ComputeState::reset() {
    mPipeline = {};
    mGroups = {};
}

bool ComputeState::prepareDispatch() {
    mFoundPipeline = mPipelines.find(mPipeline);
    if (!mFoundPipeline || !mFoundPipeline->isCompute()) return false;
    PipelineLayout const& layout = mFoundPipeline->layout();
    for (uint32_t i = 0; i < kMaxBindGroups; ++i) {
        mFoundGroups[i] = mBindGroups.find(mGroups[i].group);
        if (layout.sets[i]->isEmpty()) continue;
        if (!mFoundGroups[i] || mFoundGroups[i]->layout() != layout.sets[i]) return false;
    }
    return true;
}

void ComputeState::bind(VolkDeviceTable const& fn, VkCommandBuffer commands) const {
    PipelineLayout const& layout = mFoundPipeline->layout();
    fn.vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, mFoundPipeline->handle());
    for (uint32_t i = 0; i < kMaxBindGroups; ++i) {
        if (layout.sets[i]->isEmpty()) continue;
        const VkDescriptorSet set = mFoundGroups[i]->set();
        fn.vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout.handle, i, 1, &set,
                                   layout.sets[i]->dynamicCount(), mGroups[i].dynamicOffsets.data());
    }
}

} // namespace filament_core::backend::vulkan
