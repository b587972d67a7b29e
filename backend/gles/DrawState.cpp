// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/DrawState.h"

namespace filament_core::backend::gles {

void DrawState::beginSubpass() {
    mPipeline = nullptr;
    mPipelineApplied = false;
    mSources = {};
    mStencilFront = mStencilBack = 0;
    mDescriptors.reset();
}

void DrawState::setStencilReference(uint8_t front, uint8_t back) {
    mStencilFront = front;
    mStencilBack = back;
    mPipelineApplied = false;
}

void DrawState::setPipeline(Pipeline const* pipeline) {
    mPipeline = pipeline;
    mPipelineApplied = false;
    // The numbers of the bindings belong to the program: groups that were bound before it are applied to its slots.
    if (mPipeline && mPipeline->isUsable()) mDescriptors.setProgram(*mPipeline->program);
}

void DrawState::setGroup(uint32_t index, BindGroup const* group,
                         std::array<uint32_t, kMaxDynamicOffsets> const& dynamicOffsets) {
    mDescriptors.bind(index, group, dynamicOffsets);
}

void DrawState::setVertexBuffer(uint32_t slot, Buffer const* buffer, uint64_t offset) {
    mSources.slots[slot] = { buffer ? buffer->name : 0, static_cast<GLintptr>(offset) };
}

void DrawState::setIndexBuffer(Buffer const* buffer, uint64_t offset, IndexFormat type) {
    mSources.indexBuffer = buffer ? buffer->name : 0;
    mSources.indexOffset = offset;
    mSources.indexFormat = type;
}

bool DrawState::prepareDraw(bool indexed, DrawBase base) {
    if (!mPipeline || !mPipeline->isUsable() || mPipeline->program->isCompute()) return false;
    if (!mPipelineApplied) {
        applyPipeline(mContext, *mPipeline, mStencilFront, mStencilBack);
        mPipelineApplied = true;
    }
    return mDescriptors.apply() && mVertices.bind(*mPipeline->vertices, mSources, indexed, base);
}

} // namespace filament_core::backend::gles
