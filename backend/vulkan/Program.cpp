// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Program.h"

#include "backend/vulkan/FoldConstants.h"
#include "backend/vulkan/UniformConditions.h"

#include <cstring>

namespace filament_core::backend::vulkan {
namespace {

/// The words of a module, aligned; empty if the bytes are not whole words.
std::vector<uint32_t> wordsOf(std::span<const std::byte> bytes) {
    if (bytes.size() % sizeof(uint32_t) != 0) return {};
    std::vector<uint32_t> words(bytes.size() / sizeof(uint32_t));
    if (!words.empty()) std::memcpy(words.data(), bytes.data(), bytes.size());
    return words;
}

struct Stage {
    ShaderEdges edges;
    VkShaderModule module = VK_NULL_HANDLE;
};

const char* nameOf(ShaderStage stage) {
    return stage == ShaderStage::Vertex ? "vertex" : stage == ShaderStage::Fragment ? "fragment" : "compute";
}

Result<Stage> makeStage(Device& device, ProgramDesc const& desc, std::span<const std::byte> bytes, ShaderStage stage) {
    const std::string_view program = desc.debugName;
    const char* const stageName = nameOf(stage);
    std::vector<uint32_t> words = wordsOf(bytes);
    Result<ShaderEdges> edges = readEdges(words, stage);
    if (!edges) {
        return fail(ErrorCode::Corrupt, "program '{}', {} shader: {}; what uses it is skipped", program, stageName,
                    edges.error().message);
    }
    // Folding first: conditions that it decides need not be hidden, and hidden ones could no longer be decided.
    words = foldConstants(std::move(words), desc.constants);
    if (device.physical().quirks.inlinesUniforms) words = hideUniformConditions(std::move(words), stage);
    Stage made{ .edges = std::move(*edges) };
    auto info = make<VkShaderModuleCreateInfo>(VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO);
    info.codeSize = words.size() * sizeof(uint32_t);
    info.pCode = words.data();
    const VkResult result = device.fn().vkCreateShaderModule(device.handle(), &info, nullptr, &made.module);
    if (result != VK_SUCCESS) {
        return errorFromResult(result, fmt::format("program '{}', {} shader refused", program, stageName));
    }
    device.setName(VK_OBJECT_TYPE_SHADER_MODULE, made.module, program);
    return made;
}

} // namespace

Program::Program(Device& device, PipelineLayout const& layout, ProgramDesc const& desc)
        : mDevice(device), mLayout(layout), mConstants(desc.constants.begin(), desc.constants.end()),
          mName(desc.debugName) {}

Result<std::unique_ptr<Program>> Program::create(Device& device, PipelineLayout const& layout,
                                                 ProgramDesc const& desc) {
    std::unique_ptr<Program> program(new Program(device, layout, desc));
    if (!desc.compute.empty()) {
        Result<Stage> compute = makeStage(device, desc, desc.compute, ShaderStage::Compute);
        if (!compute) return compute.error();
        program->mCompute = compute->module;
        return program;
    }
    Result<Stage> vertex = makeStage(device, desc, desc.vertex, ShaderStage::Vertex);
    if (!vertex) return vertex.error();
    program->mVertex = vertex->module;
    program->mInputs = std::move(vertex->edges.inputs);
    Result<Stage> fragment = makeStage(device, desc, desc.fragment, ShaderStage::Fragment);
    if (!fragment) return fragment.error();
    program->mFragment = fragment->module;
    program->mOutputMask = fragment->edges.outputMask;
    return program;
}

Program::~Program() {
    mDevice.fn().vkDestroyShaderModule(mDevice.handle(), mVertex, nullptr);
    mDevice.fn().vkDestroyShaderModule(mDevice.handle(), mFragment, nullptr);
    mDevice.fn().vkDestroyShaderModule(mDevice.handle(), mCompute, nullptr);
}

} // namespace filament_core::backend::vulkan
