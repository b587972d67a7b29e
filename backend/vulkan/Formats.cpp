// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Formats.h"

namespace filament_core::backend::vulkan {
namespace {

constexpr std::array<VkFormat, static_cast<size_t>(Format::Count)> kFormats{
    VK_FORMAT_UNDEFINED,
    VK_FORMAT_R8_UNORM,
    VK_FORMAT_R8G8_UNORM,
    VK_FORMAT_R8G8B8A8_UNORM,
    VK_FORMAT_R8G8B8A8_SRGB,
    VK_FORMAT_R8_UINT,
    VK_FORMAT_R32_UINT,
    VK_FORMAT_R32G32_UINT,
    VK_FORMAT_R8G8B8A8_UINT,
    VK_FORMAT_A2B10G10R10_UNORM_PACK32, // red in the low bits
    VK_FORMAT_R16_SFLOAT,
    VK_FORMAT_R16G16_SFLOAT,
    VK_FORMAT_R16G16B16A16_SFLOAT,
    VK_FORMAT_R32_SFLOAT,
    VK_FORMAT_R32G32_SFLOAT,
    VK_FORMAT_R32G32B32A32_SFLOAT,
    VK_FORMAT_B10G11R11_UFLOAT_PACK32,
    VK_FORMAT_E5B9G9R9_UFLOAT_PACK32, // red in the low bits
    VK_FORMAT_D16_UNORM,
    VK_FORMAT_D32_SFLOAT,
    VK_FORMAT_D32_SFLOAT_S8_UINT,
    VK_FORMAT_BC1_RGBA_UNORM_BLOCK,
    VK_FORMAT_BC1_RGBA_SRGB_BLOCK,
    VK_FORMAT_BC2_UNORM_BLOCK,
    VK_FORMAT_BC2_SRGB_BLOCK,
    VK_FORMAT_BC3_UNORM_BLOCK,
    VK_FORMAT_BC3_SRGB_BLOCK,
    VK_FORMAT_BC4_UNORM_BLOCK,
    VK_FORMAT_BC5_UNORM_BLOCK,
    VK_FORMAT_BC6H_UFLOAT_BLOCK,
    VK_FORMAT_BC7_UNORM_BLOCK,
    VK_FORMAT_BC7_SRGB_BLOCK,
    VK_FORMAT_R8_SINT,
    VK_FORMAT_R32_SINT,
    VK_FORMAT_R32G32_SINT,
    VK_FORMAT_R8G8B8A8_SINT,
};

constexpr std::array<VkFormat, static_cast<size_t>(VertexFormat::Count)> kVertexFormats{
    VK_FORMAT_UNDEFINED,           VK_FORMAT_R32_SFLOAT,
    VK_FORMAT_R32G32_SFLOAT,       VK_FORMAT_R32G32B32_SFLOAT,
    VK_FORMAT_R32G32B32A32_SFLOAT, VK_FORMAT_R16G16_SFLOAT,
    VK_FORMAT_R16G16B16A16_SFLOAT, VK_FORMAT_R8G8B8A8_UINT,
    VK_FORMAT_R8G8B8A8_UNORM,      VK_FORMAT_R8G8B8A8_SINT,
    VK_FORMAT_R8G8B8A8_SNORM,      VK_FORMAT_R16G16_UINT,
    VK_FORMAT_R16G16_UNORM,        VK_FORMAT_R16G16B16A16_UINT,
    VK_FORMAT_R16G16B16A16_UNORM,  VK_FORMAT_R16G16_SINT,
    VK_FORMAT_R16G16_SNORM,        VK_FORMAT_R16G16B16A16_SINT,
    VK_FORMAT_R16G16B16A16_SNORM,  VK_FORMAT_R32_UINT,
};

constexpr std::array kCompareOps{
    VK_COMPARE_OP_ALWAYS,        VK_COMPARE_OP_NEVER,   VK_COMPARE_OP_LESS,      VK_COMPARE_OP_EQUAL,
    VK_COMPARE_OP_LESS_OR_EQUAL, VK_COMPARE_OP_GREATER, VK_COMPARE_OP_NOT_EQUAL, VK_COMPARE_OP_GREATER_OR_EQUAL,
    VK_COMPARE_OP_ALWAYS,
};

constexpr std::array kTopologies{
    VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST, VK_PRIMITIVE_TOPOLOGY_TRIANGLE_STRIP, VK_PRIMITIVE_TOPOLOGY_LINE_LIST,
    VK_PRIMITIVE_TOPOLOGY_LINE_STRIP,    VK_PRIMITIVE_TOPOLOGY_POINT_LIST,
};

constexpr std::array kStencilOps{
    VK_STENCIL_OP_KEEP,
    VK_STENCIL_OP_ZERO,
    VK_STENCIL_OP_REPLACE,
    VK_STENCIL_OP_INCREMENT_AND_CLAMP,
    VK_STENCIL_OP_DECREMENT_AND_CLAMP,
    VK_STENCIL_OP_INVERT,
    VK_STENCIL_OP_INCREMENT_AND_WRAP,
    VK_STENCIL_OP_DECREMENT_AND_WRAP,
};

constexpr std::array kBlendFactors{
    VK_BLEND_FACTOR_ZERO,
    VK_BLEND_FACTOR_ONE,
    VK_BLEND_FACTOR_SRC_COLOR,
    VK_BLEND_FACTOR_ONE_MINUS_SRC_COLOR,
    VK_BLEND_FACTOR_DST_COLOR,
    VK_BLEND_FACTOR_ONE_MINUS_DST_COLOR,
    VK_BLEND_FACTOR_SRC_ALPHA,
    VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
    VK_BLEND_FACTOR_DST_ALPHA,
    VK_BLEND_FACTOR_ONE_MINUS_DST_ALPHA,
    VK_BLEND_FACTOR_SRC_ALPHA_SATURATE,
};

constexpr std::array kBlendOps{
    VK_BLEND_OP_ADD, VK_BLEND_OP_SUBTRACT, VK_BLEND_OP_REVERSE_SUBTRACT, VK_BLEND_OP_MIN, VK_BLEND_OP_MAX,
};

constexpr std::array kDescriptorTypes{
    VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,         VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC,
    VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, VK_DESCRIPTOR_TYPE_INPUT_ATTACHMENT,
    VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
};

template <class Table, class E>
auto lookUp(Table const& table, E value) {
    return table[static_cast<size_t>(value)];
}

} // namespace

VkFormat native(Format format) { return lookUp(kFormats, format); }
VkFormat native(VertexFormat format) { return lookUp(kVertexFormats, format); }
VkFilter native(Filter filter) { return filter == Filter::Linear ? VK_FILTER_LINEAR : VK_FILTER_NEAREST; }
VkCompareOp native(CompareOp op) { return lookUp(kCompareOps, op); }
VkPrimitiveTopology native(PrimitiveType topology) { return lookUp(kTopologies, topology); }
VkStencilOp native(StencilOp op) { return lookUp(kStencilOps, op); }
VkBlendFactor native(BlendFactor factor) { return lookUp(kBlendFactors, factor); }
VkBlendOp native(BlendOp op) { return lookUp(kBlendOps, op); }
VkDescriptorType native(BindingType type) { return lookUp(kDescriptorTypes, type); }

VkSamplerAddressMode native(WrapMode mode) {
    switch (mode) {
    case WrapMode::Repeat:
        return VK_SAMPLER_ADDRESS_MODE_REPEAT;
    case WrapMode::MirroredRepeat:
        return VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT;
    case WrapMode::ClampToEdge:
        break;
    }
    return VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
}

VkCullModeFlags native(CullMode mode) {
    switch (mode) {
    case CullMode::None:
        return VK_CULL_MODE_NONE;
    case CullMode::Front:
        return VK_CULL_MODE_FRONT_BIT;
    case CullMode::Back:
        break;
    }
    return VK_CULL_MODE_BACK_BIT;
}

VkFrontFace native(FrontFace face) {
    return face == FrontFace::CounterClockwise ? VK_FRONT_FACE_COUNTER_CLOCKWISE : VK_FRONT_FACE_CLOCKWISE;
}

VkShaderStageFlags native(ShaderStage stages) {
    VkShaderStageFlags flags = 0;
    if ((static_cast<uint8_t>(stages) & static_cast<uint8_t>(ShaderStage::Vertex)) != 0)
        flags |= VK_SHADER_STAGE_VERTEX_BIT;
    if ((static_cast<uint8_t>(stages) & static_cast<uint8_t>(ShaderStage::Fragment)) != 0)
        flags |= VK_SHADER_STAGE_FRAGMENT_BIT;
    if ((static_cast<uint8_t>(stages) & static_cast<uint8_t>(ShaderStage::Compute)) != 0)
        flags |= VK_SHADER_STAGE_COMPUTE_BIT;
    return flags;
}

VkAttachmentLoadOp native(LoadOp op) {
    switch (op) {
    case LoadOp::Load:
        return VK_ATTACHMENT_LOAD_OP_LOAD;
    case LoadOp::Clear:
        return VK_ATTACHMENT_LOAD_OP_CLEAR;
    case LoadOp::Discard:
        break;
    }
    return VK_ATTACHMENT_LOAD_OP_DONT_CARE;
}

VkAttachmentStoreOp native(StoreOp op) {
    return op == StoreOp::Store ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
}

VkIndexType native(IndexFormat type) {
    return type == IndexFormat::UInt32 ? VK_INDEX_TYPE_UINT32 : VK_INDEX_TYPE_UINT16;
}

VkImageAspectFlags aspectsOf(Format format) {
    if (!hasDepth(format)) return VK_IMAGE_ASPECT_COLOR_BIT;
    return hasStencil(format) ? VK_IMAGE_ASPECT_DEPTH_BIT | VK_IMAGE_ASPECT_STENCIL_BIT : VK_IMAGE_ASPECT_DEPTH_BIT;
}

VkImageAspectFlags copyAspectOf(Format format) {
    return hasDepth(format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

VkSampleCountFlagBits sampleBits(uint32_t samples) { return static_cast<VkSampleCountFlagBits>(samples); }

} // namespace filament_core::backend::vulkan
