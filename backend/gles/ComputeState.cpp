// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/ComputeState.h"

namespace filament_core::backend::gles {

void ComputeState::reset() {
    mPipeline = {};
    mGroups = {};
}

bool ComputeState::prepareDispatch() {
    Pipeline const* pipeline = mPipelines.find(mPipeline);
    if (!pipeline || !pipeline->isUsable() || !pipeline->program->isCompute()) return false;
    mContext.useProgram(pipeline->program->name());
    mDescriptors.setProgram(*pipeline->program);
    for (uint32_t i = 0; i < kMaxBindGroups; ++i) {
        mDescriptors.bind(i, mBindGroups.find(mGroups[i].group), mGroups[i].dynamicOffsets);
    }
    return mDescriptors.apply();
}

} // namespace filament_core::backend::gles
