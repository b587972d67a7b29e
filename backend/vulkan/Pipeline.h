// SPDX-License-Identifier: Apache-2.0
/// Pipeline: a program with all other fixed state.
///   Thread  the driver thread.
///   Limits  attachments without an output in the program keep their contents. A device without independentBlend blends
///           and masks all attachments like attachment 0.
///   Fails   create(): Internal or OutOfMemory with the names of pipeline and program.
///   Cost    create() compiles: milliseconds on lavapipe, which compiles the rest at the first draw.
#pragma once

#include "backend/vulkan/Program.h"
#include "backend/vulkan/RenderPasses.h"
#include "backend/vulkan/Vertices.h"

#include <memory>

namespace filament_core::backend::vulkan {

class Pipeline final : public DeviceObject {
public:
    /// `pass` is compatible with desc.pass.
    static Result<std::unique_ptr<Pipeline>> create(Device& device, VkPipelineCache cache, VkRenderPass pass,
                                                    Program const& program, PipelineDesc const& desc);
    /// Of a program with a compute stage.
    static Result<std::unique_ptr<Pipeline>> createCompute(Device& device, VkPipelineCache cache,
                                                           Program const& program, std::string_view debugName);
    ~Pipeline() override { mDevice.fn().vkDestroyPipeline(mDevice.handle(), mHandle, nullptr); }

    VkPipeline handle() const { return mHandle; }
    PipelineLayout const& layout() const { return mLayout; }
    bool isCompute() const { return mIsCompute; }
    uint8_t vertexBufferMask() const { return mVertexBufferMask; }
    bool readsZeros() const { return mReadsZeros; }
    bool isFromCache() const { return mIsFromCache; } ///< as far as the device tells

private:
    Pipeline(Device& device, PipelineLayout const& layout, VertexInput const& input)
            : mDevice(device), mLayout(layout), mVertexBufferMask(input.bufferMask), mReadsZeros(input.readsZeros) {}

    Device& mDevice;
    PipelineLayout const& mLayout;
    VkPipeline mHandle = VK_NULL_HANDLE;
    uint8_t mVertexBufferMask;
    bool mReadsZeros;
    bool mIsFromCache = false;
    bool mIsCompute = false;
};

} // namespace filament_core::backend::vulkan
