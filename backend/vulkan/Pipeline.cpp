// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Pipeline.h"

#include "backend/vulkan/Formats.h"

#include <array>
#include <vector>

namespace filament_core::backend::vulkan {
namespace {

/// Specialisation constants of both stages, 32 bits each.
class Specialization {
public:
    explicit Specialization(std::span<const ConstantValue> constants) {
        for (ConstantValue const& constant : constants) {
            const auto offset = static_cast<uint32_t>(mData.size() * sizeof(uint32_t));
            mEntries.push_back({ constant.id, offset, sizeof(uint32_t) });
            mData.push_back(constant.bits);
        }
        mInfo = { static_cast<uint32_t>(mEntries.size()), mEntries.data(), mData.size() * sizeof(uint32_t),
                  mData.data() };
    }
    Specialization(Specialization const&) = delete;
    Specialization& operator=(Specialization const&) = delete;
    VkSpecializationInfo const* info() const { return mEntries.empty() ? nullptr : &mInfo; }

private:
    std::vector<VkSpecializationMapEntry> mEntries;
    std::vector<uint32_t> mData;
    VkSpecializationInfo mInfo{};
};

VkPipelineShaderStageCreateInfo stageInfo(VkShaderStageFlagBits stage, VkShaderModule module,
                                          Specialization const& constants) {
    auto info = make<VkPipelineShaderStageCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO);
    info.stage = stage;
    info.module = module;
    info.pName = "main";
    info.pSpecializationInfo = constants.info();
    return info;
}

VkPipelineRasterizationStateCreateInfo rasterInfo(Device const& device, RasterState const& raster) {
    auto info =
            make<VkPipelineRasterizationStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO);
    info.depthClampEnable = raster.depthClamp && device.info().features.depthClamp;
    info.polygonMode = VK_POLYGON_MODE_FILL;
    info.cullMode = native(raster.cull);
    info.frontFace = native(raster.frontFace);
    info.depthBiasEnable = raster.depthBiasConstant != 0 || raster.depthBiasSlope != 0;
    info.depthBiasConstantFactor = raster.depthBiasConstant;
    info.depthBiasSlopeFactor = raster.depthBiasSlope;
    info.lineWidth = 1;
    return info;
}

bool isLines(PrimitiveType topology) {
    return topology == PrimitiveType::Lines || topology == PrimitiveType::LineStrip;
}

VkStencilOpState stencilFace(StencilFace const& face) {
    return { native(face.fail),
             native(face.pass),
             native(face.depthFail),
             native(face.compare),
             face.readMask,
             face.writeMask,
             0 };
}

VkPipelineDepthStencilStateCreateInfo depthInfo(PipelineDesc const& desc) {
    auto info = make<VkPipelineDepthStencilStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO);
    if (desc.pass.depthFormat == Format::None || !desc.pass.subpasses[desc.subpass].usesDepth) return info;
    DepthStencilState const& state = desc.depthStencil;
    info.depthTestEnable = state.depthCompare != CompareOp::None;
    info.depthWriteEnable = info.depthTestEnable && state.depthWrite;
    info.depthCompareOp = native(state.depthCompare);
    info.stencilTestEnable = state.stencilTest && hasStencil(desc.pass.depthFormat);
    info.front = stencilFace(state.front);
    info.back = stencilFace(state.back);
    info.maxDepthBounds = 1;
    return info;
}

VkPipelineColorBlendAttachmentState blendAttachment(BlendState const& blend, Format format) {
    VkPipelineColorBlendAttachmentState info{};
    info.blendEnable = blend.enabled && formatInfo(format).kind != FormatKind::UnsignedInteger;
    info.srcColorBlendFactor = native(blend.srcColor);
    info.dstColorBlendFactor = native(blend.dstColor);
    info.colorBlendOp = native(blend.colorOp);
    info.srcAlphaBlendFactor = native(blend.srcAlpha);
    info.dstAlphaBlendFactor = native(blend.dstAlpha);
    info.alphaBlendOp = native(blend.alphaOp);
    info.colorWriteMask = blend.writeMask;
    return info;
}

struct BlendInfo {
    std::array<VkPipelineColorBlendAttachmentState, kMaxColorAttachments> attachments{};
    VkPipelineColorBlendStateCreateInfo info =
            make<VkPipelineColorBlendStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO);
};

/// Outputs that the subpass or the program does not write keep their values.
void fillBlend(BlendInfo& blend, Device const& device, PipelineDesc const& desc, uint32_t outputMask) {
    const uint32_t written = writtenColors(desc.pass, desc.subpass) & outputMask;
    for (uint32_t i = 0; i < desc.pass.colorCount; ++i) {
        blend.attachments[i] = blendAttachment(desc.blend[i], desc.pass.colorFormats[i]);
        if ((written >> i & 1) == 0) blend.attachments[i].colorWriteMask = 0;
        // Without the feature the states of all attachments must be equal.
        if (!device.physical().features.independentBlend) blend.attachments[i] = blend.attachments[0];
    }
    blend.info.attachmentCount = colorReferences(device.physical().quirks, desc.pass);
    blend.info.pAttachments = blend.attachments.data();
}

VkPipelineMultisampleStateCreateInfo multisampleInfo(PipelineDesc const& desc) {
    auto info = make<VkPipelineMultisampleStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO);
    info.rasterizationSamples = sampleBits(desc.pass.samples);
    info.alphaToCoverageEnable = desc.raster.alphaToCoverage;
    return info;
}

VkPipelineVertexInputStateCreateInfo vertexInfo(VertexInput const& input) {
    auto info = make<VkPipelineVertexInputStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO);
    info.vertexAttributeDescriptionCount = input.attributeCount;
    info.pVertexAttributeDescriptions = input.attributes.data();
    info.vertexBindingDescriptionCount = input.bufferCount;
    info.pVertexBindingDescriptions = input.buffers.data();
    return info;
}

/// Whether the device reports that a pipeline came from the cache.
class CreationFeedback {
public:
    CreationFeedback(Device const& device, uint32_t stageCount) : mIsAsked(device.physical().creationFeedback) {
        mInfo.pPipelineCreationFeedback = &mWhole;
        mInfo.pipelineStageCreationFeedbackCount = stageCount;
        mInfo.pPipelineStageCreationFeedbacks = mOfStages.data();
    }
    CreationFeedback(CreationFeedback const&) = delete;
    CreationFeedback& operator=(CreationFeedback const&) = delete;

    void const* chain() const { return mIsAsked ? &mInfo : nullptr; }
    bool isFromCache() const {
        constexpr VkPipelineCreationFeedbackFlagsEXT kHit =
                VK_PIPELINE_CREATION_FEEDBACK_VALID_BIT_EXT |
                VK_PIPELINE_CREATION_FEEDBACK_APPLICATION_PIPELINE_CACHE_HIT_BIT_EXT;
        return (mWhole.flags & kHit) == kHit;
    }

private:
    bool mIsAsked;
    VkPipelineCreationFeedbackEXT mWhole{};
    std::array<VkPipelineCreationFeedbackEXT, 2> mOfStages{};
    VkPipelineCreationFeedbackCreateInfoEXT mInfo =
            make<VkPipelineCreationFeedbackCreateInfoEXT>(VK_STRUCTURE_TYPE_PIPELINE_CREATION_FEEDBACK_CREATE_INFO_EXT);
};

} // namespace

Result<std::unique_ptr<Pipeline>> Pipeline::create(Device& device, VkPipelineCache cache, VkRenderPass pass,
                                                   Program const& program, PipelineDesc const& desc) {
    const Specialization constants(program.constants());
    const std::array stages{ stageInfo(VK_SHADER_STAGE_VERTEX_BIT, program.vertex(), constants),
                             stageInfo(VK_SHADER_STAGE_FRAGMENT_BIT, program.fragment(), constants) };
    const VertexInput input = vertexInputOf(desc.vertices, program.inputs());
    const VkPipelineVertexInputStateCreateInfo vertices = vertexInfo(input);
    auto assembly =
            make<VkPipelineInputAssemblyStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO);
    assembly.topology = native(desc.raster.topology);
    auto viewports = make<VkPipelineViewportStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO);
    viewports.viewportCount = viewports.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo raster = rasterInfo(device, desc.raster);
    // OpenGL's convention. It also decides the vertex from which triangle set-up starts, and so the last bit.
    auto provoking = make<VkPipelineRasterizationProvokingVertexStateCreateInfoEXT>(
            VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_PROVOKING_VERTEX_STATE_CREATE_INFO_EXT);
    provoking.provokingVertexMode = VK_PROVOKING_VERTEX_MODE_LAST_VERTEX_EXT;
    if (device.physical().provokingVertexLast) raster.pNext = &provoking;
    // OpenGL ES 3.2, 13.5.1 draws lines of one sample by Bresenham's rule (diamond exit) and those of several as
    // rectangles, which is Vulkan's default for both.
    auto lines = make<VkPipelineRasterizationLineStateCreateInfoEXT>(
            VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_LINE_STATE_CREATE_INFO_EXT);
    lines.lineRasterizationMode = VK_LINE_RASTERIZATION_MODE_BRESENHAM_EXT;
    lines.pNext = raster.pNext;
    if (device.physical().bresenhamLines && isLines(desc.raster.topology) && desc.pass.samples == 1)
        raster.pNext = &lines;
    const VkPipelineMultisampleStateCreateInfo multisample = multisampleInfo(desc);
    const VkPipelineDepthStencilStateCreateInfo depth = depthInfo(desc);
    BlendInfo blend;
    fillBlend(blend, device, desc, program.outputMask());
    constexpr std::array kDynamic{ VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR,
                                   VK_DYNAMIC_STATE_STENCIL_REFERENCE };
    auto dynamic = make<VkPipelineDynamicStateCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO);
    dynamic.dynamicStateCount = static_cast<uint32_t>(kDynamic.size());
    dynamic.pDynamicStates = kDynamic.data();

    auto info = make<VkGraphicsPipelineCreateInfo>(VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO);
    info.stageCount = static_cast<uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &vertices;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewports;
    info.pRasterizationState = &raster;
    info.pMultisampleState = &multisample;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend.info;
    info.pDynamicState = &dynamic;
    info.layout = program.layout().handle;
    info.renderPass = pass;
    info.subpass = desc.subpass;
    CreationFeedback feedback(device, info.stageCount);
    info.pNext = feedback.chain();
    std::unique_ptr<Pipeline> pipeline(new Pipeline(device, program.layout(), input));
    const VkResult result =
            device.fn().vkCreateGraphicsPipelines(device.handle(), cache, 1, &info, nullptr, &pipeline->mHandle);
    if (result != VK_SUCCESS) {
        return errorFromResult(result,
                               fmt::format("pipeline '{}' of program '{}' refused", desc.debugName, program.name()));
    }
    pipeline->mIsFromCache = feedback.isFromCache();
    device.setName(VK_OBJECT_TYPE_PIPELINE, pipeline->mHandle, desc.debugName);
    return pipeline;
}

Result<std::unique_ptr<Pipeline>> Pipeline::createCompute(Device& device, VkPipelineCache cache, Program const& program,
                                                          std::string_view debugName) {
    const Specialization constants(program.constants());
    auto info = make<VkComputePipelineCreateInfo>(VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO);
    info.stage = stageInfo(VK_SHADER_STAGE_COMPUTE_BIT, program.compute(), constants);
    info.layout = program.layout().handle;
    CreationFeedback feedback(device, 1);
    info.pNext = feedback.chain();
    std::unique_ptr<Pipeline> pipeline(new Pipeline(device, program.layout(), {}));
    pipeline->mIsCompute = true;
    const VkResult result =
            device.fn().vkCreateComputePipelines(device.handle(), cache, 1, &info, nullptr, &pipeline->mHandle);
    if (result != VK_SUCCESS) {
        return errorFromResult(result, fmt::format("pipeline '{}' of program '{}' refused", debugName, program.name()));
    }
    pipeline->mIsFromCache = feedback.isFromCache();
    device.setName(VK_OBJECT_TYPE_PIPELINE, pipeline->mHandle, debugName);
    return pipeline;
}

} // namespace filament_core::backend::vulkan
