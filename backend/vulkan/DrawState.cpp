// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/DrawState.h"

#include <algorithm>

namespace filament_core::backend::vulkan {
namespace {

/// Vulkan has no negative scissor offsets: the part beyond the left and top edges of the image is clipped.
VkRect2D scissorOf(Rect const& rect) {
    const auto cut = [](int32_t start, uint32_t length) {
        return static_cast<uint32_t>(std::max<int64_t>(int64_t{ length } + std::min(start, 0), 0));
    };
    return { { std::max(rect.x, 0), std::max(rect.y, 0) }, { cut(rect.x, rect.width), cut(rect.y, rect.height) } };
}

} // namespace

void DrawState::beginCommands(VkCommandBuffer commands) {
    mCommands = commands;
    // A new command buffer inherits no state from the one before.
    mEmitted = {};
    mEmittedLayout = nullptr;
    mAreZerosEmitted = mIsRasterEmitted = false;
    mChanged = kAll;
}

void DrawState::beginSubpass(Rect const& area) {
    // A pass begins with nothing bound, but the command buffer still has what was bound in the last one: binding that
    // again emits nothing.
    mWanted = {};
    mWanted.scissor = area;
    mWanted.viewport = { static_cast<float>(area.x), static_cast<float>(area.y), static_cast<float>(area.width),
                         static_cast<float>(area.height) };
    mChanged = kAll;
}

void DrawState::setViewport(Viewport const& viewport) {
    mWanted.viewport = viewport;
    mChanged |= kViewport;
}

void DrawState::setScissor(Rect const& rect) {
    mWanted.scissor = rect;
    mChanged |= kScissor;
}

void DrawState::setStencilReference(uint8_t front, uint8_t back) {
    mWanted.stencilFront = front;
    mWanted.stencilBack = back;
    mChanged |= kStencil;
}

void DrawState::setPipeline(Pipeline const* pipeline) {
    if (mWanted.pipeline == pipeline) return;
    mWanted.pipeline = pipeline;
    mChanged |= kPipeline;
}

void DrawState::setGroup(uint32_t index, BoundGroup const& group) {
    if (mWanted.groups[index] == group) return;
    mWanted.groups[index] = group;
    mChanged |= 1u << index;
}

void DrawState::setVertexBuffers(BoundVertexBuffers const& buffers) {
    if (mWanted.vertices == buffers) return;
    mWanted.vertices = buffers;
    mChanged |= kVertices;
}

void DrawState::setIndexBuffer(BoundIndexBuffer const& buffer) {
    if (mWanted.index == buffer) return;
    mWanted.index = buffer;
    mChanged |= kIndex;
}

void DrawState::emit() {
    mIsDrawable = isComplete();
    if (!mIsDrawable) return; // keep the changes: the next bind may complete the state
    // The pipeline first: its layout decides which groups are still bound, and groups are bound through it.
    emitPipeline();
    emitGroups();
    if ((mChanged & (kVertices | kPipeline)) != 0) emitVertices();
    if ((mChanged & kIndex) != 0) emitIndex();
    if ((mChanged & (kViewport | kScissor | kStencil)) != 0) emitRaster();
    mChanged = 0;
}

bool DrawState::isComplete() const {
    if (!mWanted.pipeline || mWanted.pipeline->isCompute()) return false;
    PipelineLayout const& layout = mWanted.pipeline->layout();
    for (uint32_t i = 0; i < kMaxBindGroups; ++i) {
        if (layout.sets[i]->isEmpty()) continue;
        BindGroup const* const group = mWanted.groups[i].group;
        if (!group || group->layout() != layout.sets[i]) return false;
    }
    for (uint32_t slot = 0; slot < kMaxVertexBuffers; ++slot) {
        const bool isRead = (mWanted.pipeline->vertexBufferMask() >> slot & 1) != 0;
        if (isRead && mWanted.vertices.buffers[slot] == VK_NULL_HANDLE) return false;
    }
    return true;
}

void DrawState::emitPipeline() {
    if (mEmitted.pipeline == mWanted.pipeline) return;
    mFn.vkCmdBindPipeline(mCommands, VK_PIPELINE_BIND_POINT_GRAPHICS, mWanted.pipeline->handle());
    mEmitted.pipeline = mWanted.pipeline;

    PipelineLayout const* const layout = &mWanted.pipeline->layout();
    if (mEmittedLayout == layout) return;
    // Sets stay bound up to the first one whose layout differs (Vulkan 1.1, 13.2.2, pipeline layout compatibility).
    uint32_t first = 0;
    while (mEmittedLayout && first < kMaxBindGroups && mEmittedLayout->sets[first] == layout->sets[first]) ++first;
    for (uint32_t i = first; i < kMaxBindGroups; ++i) {
        mEmitted.groups[i] = {};
        mChanged |= 1u << i;
    }
    mEmittedLayout = layout;
}

void DrawState::emitGroups() {
    for (uint32_t i = 0; i < kMaxBindGroups; ++i) {
        BoundGroup const& wanted = mWanted.groups[i];
        if ((mChanged >> i & 1) == 0 || mEmittedLayout->sets[i]->isEmpty() || mEmitted.groups[i] == wanted) continue;
        const VkDescriptorSet set = wanted.group->set();
        mFn.vkCmdBindDescriptorSets(mCommands, VK_PIPELINE_BIND_POINT_GRAPHICS, mEmittedLayout->handle, i, 1, &set,
                                    wanted.offsetCount, wanted.offsets.data());
        mEmitted.groups[i] = wanted;
    }
}

void DrawState::emitVertices() {
    if (mWanted.pipeline->readsZeros() && !mAreZerosEmitted) {
        const VkDeviceSize offset = 0;
        mFn.vkCmdBindVertexBuffers(mCommands, kZeroBufferSlot, 1, &mZeros, &offset);
        mAreZerosEmitted = true;
    }
    if (mWanted.pipeline->vertexBufferMask() == 0 || mEmitted.vertices == mWanted.vertices) return;
    BoundVertexBuffers bound = mWanted.vertices;
    for (VkBuffer& buffer : bound.buffers) {
        if (buffer == VK_NULL_HANDLE) buffer = mZeros; // the bound pipeline does not read it
    }
    mFn.vkCmdBindVertexBuffers(mCommands, 0, kMaxVertexBuffers, bound.buffers.data(), bound.offsets.data());
    mEmitted.vertices = mWanted.vertices;
}

void DrawState::emitIndex() {
    BoundIndexBuffer const& index = mWanted.index;
    if (index.buffer == VK_NULL_HANDLE || mEmitted.index == index) return;
    mFn.vkCmdBindIndexBuffer(mCommands, index.buffer, index.offset, index.type);
    mEmitted.index = index;
}

void DrawState::emitRaster() {
    if (!mIsRasterEmitted || mEmitted.viewport != mWanted.viewport) {
        Viewport const& v = mWanted.viewport;
        const VkViewport viewport{ v.x, v.y, v.width, v.height, 0, 1 };
        mFn.vkCmdSetViewport(mCommands, 0, 1, &viewport);
        mEmitted.viewport = v;
    }
    if (!mIsRasterEmitted || mEmitted.scissor != mWanted.scissor) {
        const VkRect2D scissor = scissorOf(mWanted.scissor);
        mFn.vkCmdSetScissor(mCommands, 0, 1, &scissor);
        mEmitted.scissor = mWanted.scissor;
    }
    const bool sameStencil =
            mEmitted.stencilFront == mWanted.stencilFront && mEmitted.stencilBack == mWanted.stencilBack;
    if (!mIsRasterEmitted || !sameStencil) {
        mFn.vkCmdSetStencilReference(mCommands, VK_STENCIL_FACE_FRONT_BIT, mWanted.stencilFront);
        mFn.vkCmdSetStencilReference(mCommands, VK_STENCIL_FACE_BACK_BIT, mWanted.stencilBack);
        mEmitted.stencilFront = mWanted.stencilFront;
        mEmitted.stencilBack = mWanted.stencilBack;
    }
    mIsRasterEmitted = true;
}

} // namespace filament_core::backend::vulkan
