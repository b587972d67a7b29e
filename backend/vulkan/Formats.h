// SPDX-License-Identifier: Apache-2.0
/// Converts our enums to Vulkan's. Pure functions, defined for every enumerator.
#pragma once

#include "backend/api/Descriptions.h"
#include "backend/vulkan/Api.h"

namespace filament_core::backend::vulkan {

VkFormat native(Format format);       ///< VK_FORMAT_UNDEFINED for None
VkFormat native(VertexFormat format); ///< VK_FORMAT_UNDEFINED for None
VkFilter native(Filter filter);
VkSamplerAddressMode native(WrapMode mode);
VkCompareOp native(CompareOp op); ///< None: always
VkPrimitiveTopology native(PrimitiveType topology);
VkCullModeFlags native(CullMode mode);
VkStencilOp native(StencilOp op);
VkBlendFactor native(BlendFactor factor);
VkBlendOp native(BlendOp op);
VkDescriptorType native(BindingType type);
VkShaderStageFlags native(ShaderStage stages);
VkAttachmentLoadOp native(LoadOp op);
VkAttachmentStoreOp native(StoreOp op);
VkIndexType native(IndexFormat type);

/// Vulkan computes the sign of a triangle's area with y pointing down, and calls positive counter-clockwise. That is
/// how the triangle looks with row 0 at the top, so the names agree.
VkFrontFace native(FrontFace face);

/// All aspects of the format, for barriers and attachment views.
VkImageAspectFlags aspectsOf(Format format);
/// The aspect that is sampled and copied: colour, or depth without stencil.
VkImageAspectFlags copyAspectOf(Format format);

VkSampleCountFlagBits sampleBits(uint32_t samples);

} // namespace filament_core::backend::vulkan
