// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Executor.h"

#include "backend/vulkan/Formats.h"

#include <algorithm>

namespace filament_core::backend::vulkan {

// ---------------------------------------------------------------------------------------------- begin and end

void Executor::execute(CmdBeginPass const& command) {
    ++mStatistics.passes;
    label(command.desc.debugName);
    if (const Result<void> begun = mPass->begin(command.desc, commands()); !begun) report(begun.error());
    mDraws->beginSubpass(command.desc.area);
    mCompute.reset();
}

void Executor::execute(CmdNextSubpass const&) {
    if (!mPass->isUsable()) return;
    mPass->nextSubpass(commands());
    mDraws->beginSubpass(mPass->area());
}

void Executor::execute(CmdEndPass const&) {
    if (!mPass->isOpen()) return;
    mPass->end(commands());
    mCompute.reset();
    endLabel();
}

// ---------------------------------------------------------------------------------------------- bindings

void Executor::execute(CmdBindPipeline const& command) {
    if (mPass->isOpen())
        mDraws->setPipeline(mPipelines.find(command.pipeline));
    else
        mCompute.setPipeline(command.pipeline);
}

void Executor::execute(CmdBindGroup const& command) {
    if (!mPass->isOpen()) return mCompute.setGroup(command);
    BindGroup const* const group = mBindGroups.find(command.group);
    BoundGroup bound{ .group = group };
    if (group) {
        bound.offsetCount = group->layout()->dynamicCount();
        std::copy_n(command.dynamicOffsets.begin(), bound.offsetCount, bound.offsets.begin());
    }
    mDraws->setGroup(command.index, bound);
}

void Executor::execute(CmdBindVertexBuffers const& command) {
    BoundVertexBuffers bound;
    for (uint32_t slot = 0; slot < command.count; ++slot) {
        Buffer* const buffer = mBuffers.find(command.buffers[slot]);
        if (!buffer) continue;
        buffer->isUsed = true;
        bound.buffers[slot] = buffer->handle();
        bound.offsets[slot] = command.offsets[slot];
    }
    mDraws->setVertexBuffers(bound);
}

void Executor::execute(CmdBindIndexBuffer const& command) {
    Buffer* const buffer = mBuffers.find(command.buffer);
    if (!buffer) return mDraws->setIndexBuffer({});
    buffer->isUsed = true;
    mDraws->setIndexBuffer({ buffer->handle(), command.offset, native(command.type) });
}

void Executor::execute(CmdDraw const& command) {
    if (!mPass->isUsable() || !mDraws->prepareDraw(false)) return;
    ++mStatistics.draws;
    mDevice->fn().vkCmdDraw(mSubmissions->commands(), command.vertexCount, command.instanceCount, command.firstVertex,
                            command.firstInstance);
}

void Executor::execute(CmdDrawIndexed const& command) {
    if (!mPass->isUsable() || !mDraws->prepareDraw(true)) return;
    ++mStatistics.draws;
    mDevice->fn().vkCmdDrawIndexed(mSubmissions->commands(), command.indexCount, command.instanceCount,
                                   command.firstIndex, command.vertexOffset, command.firstInstance);
}

// ---------------------------------------------------------------------------------------------- dispatches

void Executor::execute(CmdDispatch const& command) {
    // Whether the dispatch can run is decided before barriers are recorded for it.
    if (mPass->isOpen() || !mCompute.prepareDispatch()) return;
    VkCommandBuffer recording = commands();
    mBarriers.beginDispatch();
    flushBarriers();
    mCompute.bind(mDevice->fn(), recording);
    mDevice->fn().vkCmdDispatch(recording, command.groupsX, command.groupsY, command.groupsZ);
    mBarriers.endDispatch();
    ++mStatistics.dispatches;
}

} // namespace filament_core::backend::vulkan
