// SPDX-License-Identifier: Apache-2.0
/// DrawState: what the stream has bound, and what the command buffer has; prepareDraw() emits only the difference.
///   Why     on CPU devices a redundant bind costs as much as a small draw.
///   Thread  the driver thread.
///   Fails   prepareDraw() says no when something that the pipeline needs is missing or failed to be created.
///   Cost    one branch for a draw after which nothing changed.
#pragma once

#include "backend/vulkan/Buffer.h"
#include "backend/vulkan/Descriptors.h"
#include "backend/vulkan/Pipeline.h"

#include <array>

namespace filament_core::backend::vulkan {

struct BoundGroup {
    BindGroup const* group = nullptr;
    std::array<uint32_t, kMaxDynamicOffsets> offsets{};
    uint8_t offsetCount = 0;
    friend bool operator==(BoundGroup const&, BoundGroup const&) = default;
};

struct BoundVertexBuffers {
    std::array<VkBuffer, kMaxVertexBuffers> buffers{};
    std::array<VkDeviceSize, kMaxVertexBuffers> offsets{};
    friend bool operator==(BoundVertexBuffers const&, BoundVertexBuffers const&) = default;
};

struct BoundIndexBuffer {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
    VkIndexType type = VK_INDEX_TYPE_UINT16;
    friend bool operator==(BoundIndexBuffer const&, BoundIndexBuffer const&) = default;
};

class DrawState {
public:
    /// `zeros` feeds attributes that a vertex layout lacks, and slots that nothing is bound to.
    DrawState(VolkDeviceTable const& fn, VkBuffer zeros) : mFn(fn), mZeros(zeros) {}

    /// A new command buffer has nothing bound.
    void beginCommands(VkCommandBuffer commands);
    /// A new subpass: nothing bound, viewport and scissor cover the area, the stencil reference is 0.
    void beginSubpass(Rect const& area);

    void setViewport(Viewport const& viewport);
    void setScissor(Rect const& rect);
    void setStencilReference(uint8_t front, uint8_t back);
    void setPipeline(Pipeline const* pipeline);
    void setGroup(uint32_t index, BoundGroup const& group);
    void setVertexBuffers(BoundVertexBuffers const& buffers);
    void setIndexBuffer(BoundIndexBuffer const& buffer);

    /// Makes the command buffer ready; false: skip the draw.
    bool prepareDraw(bool indexed) {
        if (mChanged != 0) emit();
        return mIsDrawable && (!indexed || mWanted.index.buffer != VK_NULL_HANDLE);
    }

private:
    struct State {
        Pipeline const* pipeline = nullptr;
        std::array<BoundGroup, kMaxBindGroups> groups{};
        BoundVertexBuffers vertices{};
        BoundIndexBuffer index{};
        Viewport viewport{};
        Rect scissor{};
        uint8_t stencilFront = 0, stencilBack = 0;
    };
    enum Change : uint32_t { // groups: bits 0..3
        kPipeline = 1u << 8,
        kVertices = 1u << 9,
        kIndex = 1u << 10,
        kViewport = 1u << 11,
        kScissor = 1u << 12,
        kStencil = 1u << 13,
        kAll = 0xFFFFFFFF,
    };

    void emit();
    bool isComplete() const;
    void emitPipeline();
    void emitGroups();
    void emitVertices();
    void emitIndex();
    void emitRaster();

    VolkDeviceTable const& mFn;
    VkBuffer mZeros;
    VkCommandBuffer mCommands = VK_NULL_HANDLE;
    State mWanted, mEmitted;
    PipelineLayout const* mEmittedLayout = nullptr; // the layout that the emitted groups were bound with
    bool mAreZerosEmitted = false;
    bool mIsRasterEmitted = false; // viewport, scissor and stencil of mEmitted are real
    uint32_t mChanged = kAll;
    bool mIsDrawable = false;
};

} // namespace filament_core::backend::vulkan
