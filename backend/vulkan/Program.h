// SPDX-License-Identifier: Apache-2.0
/// Program: the shader modules of a vertex and a fragment stage, or of a compute stage; their constants, inputs
/// and outputs.
///   Thread  the driver thread.
///   Memory  may be destroyed once its pipelines have been created.
///   Fails   create(): Corrupt with the program's name for SPIR-V that cannot be read; otherwise Internal or
///           OutOfMemory.
#pragma once

#include "backend/vulkan/Descriptors.h"
#include "backend/vulkan/Spirv.h"

#include <memory>
#include <string>
#include <vector>

namespace filament_core::backend::vulkan {

class Program final : public DeviceObject {
public:
    static Result<std::unique_ptr<Program>> create(Device& device, PipelineLayout const& layout,
                                                   ProgramDesc const& desc);
    ~Program() override;

    VkShaderModule vertex() const { return mVertex; }
    VkShaderModule fragment() const { return mFragment; }
    VkShaderModule compute() const { return mCompute; } ///< null: a program for draws
    std::span<const ShaderInput> inputs() const { return mInputs; }
    uint32_t outputMask() const { return mOutputMask; }
    std::span<const ConstantValue> constants() const { return mConstants; }
    PipelineLayout const& layout() const { return mLayout; }
    std::string const& name() const { return mName; }

private:
    Program(Device& device, PipelineLayout const& layout, ProgramDesc const& desc);

    Device& mDevice;
    PipelineLayout const& mLayout;
    VkShaderModule mVertex = VK_NULL_HANDLE, mFragment = VK_NULL_HANDLE, mCompute = VK_NULL_HANDLE;
    std::vector<ShaderInput> mInputs;
    uint32_t mOutputMask = 0;
    std::vector<ConstantValue> mConstants;
    std::string mName;
};

} // namespace filament_core::backend::vulkan
