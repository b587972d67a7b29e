// SPDX-License-Identifier: Apache-2.0
/// Pipeline: programs (two shader modules, their constants and edges) and pipelines (all other fixed state).
///   Thread  the driver thread.
///   Memory  a program may be destroyed once its pipelines are made.
///   Limits  attributes that the program does not read are left out; those that the layout lacks come from a buffer of
///           zeros with stride 0 at slot kZeroBufferSlot, which makes them (0, 0, 0, 1). Fragment outputs that the
///           program does not write leave their attachment alone.
///           A device without independentBlend blends and masks all attachments like attachment 0.
///   Fails   create(): Corrupt with the program's name for SPIR-V that cannot be read; Internal or OutOfMemory
///           otherwise.
///   Cost    create() compiles: milliseconds on lavapipe, which compiles the rest at the first draw.
#pragma once

#include "backend/vulkan/Descriptors.h"
#include "backend/vulkan/Pass.h"
#include "backend/vulkan/Spirv.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace filament::backend::vulkan {

class Program final : public DeviceObject {
public:
    static Result<std::unique_ptr<Program>> create(Device& device, PipelineLayout const& layout,
                                                   ProgramDesc const& desc);
    ~Program() override;

    VkShaderModule vertex() const { return mVertex; }
    VkShaderModule fragment() const { return mFragment; }
    std::span<const ShaderInput> inputs() const { return mInputs; }
    uint32_t outputMask() const { return mOutputMask; }
    std::span<const ConstantValue> constants() const { return mConstants; }
    PipelineLayout const& layout() const { return mLayout; }
    std::string const& name() const { return mName; }

private:
    Program(Device& device, PipelineLayout const& layout, ProgramDesc const& desc);

    Device& mDevice;
    PipelineLayout const& mLayout;
    VkShaderModule mVertex = VK_NULL_HANDLE, mFragment = VK_NULL_HANDLE;
    std::vector<ShaderInput> mInputs;
    uint32_t mOutputMask = 0;
    std::vector<ConstantValue> mConstants;
    std::string mName;
};

inline constexpr uint32_t kZeroBufferSlot = kMaxVertexBuffers;

/// Where the vertex inputs of a program come from.
struct VertexInput {
    std::array<VkVertexInputAttributeDescription, 32> attributes{};
    std::array<VkVertexInputBindingDescription, kMaxVertexBuffers + 1> buffers{};
    uint32_t attributeCount = 0, bufferCount = 0;
    uint8_t bufferMask = 0; ///< bit i: slot i of CmdBindVertexBuffers is read
    bool readsZeros = false;
};
VertexInput vertexInputOf(VertexLayout const& layout, std::span<const ShaderInput> inputs);

class Pipeline final : public DeviceObject {
public:
    /// `pass` is compatible with desc.pass.
    static Result<std::unique_ptr<Pipeline>> create(Device& device, VkPipelineCache cache, VkRenderPass pass,
                                                    Program const& program, PipelineDesc const& desc);
    ~Pipeline() override { mDevice.fn().vkDestroyPipeline(mDevice.handle(), mHandle, nullptr); }

    VkPipeline handle() const { return mHandle; }
    PipelineLayout const& layout() const { return mLayout; }
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
};

} // namespace filament::backend::vulkan
