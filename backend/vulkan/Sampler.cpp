// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Sampler.h"

#include "backend/vulkan/Formats.h"

#include <algorithm>

namespace filament_core::backend::vulkan {

Result<std::unique_ptr<Sampler>> Sampler::create(Device& device, SamplerDesc const& desc) {
    auto info = make<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
    info.magFilter = native(desc.magFilter);
    info.minFilter = native(desc.minFilter);
    info.mipmapMode =
            desc.mipFilter == MipFilter::Linear ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
    info.addressModeU = native(desc.wrapU);
    info.addressModeV = native(desc.wrapV);
    info.addressModeW = native(desc.wrapW);
    const float anisotropy = std::min(static_cast<float>(desc.anisotropy), device.info().limits.maxAnisotropy);
    info.anisotropyEnable = anisotropy > 1;
    info.maxAnisotropy = std::max(anisotropy, 1.0f);
    info.compareEnable = desc.compare != CompareOp::None;
    info.compareOp = native(desc.compare);
    // Vulkan always has a mip filter. As the specification's table for OpenGL's filters without one says: a nearest mip
    // filter and levels of detail up to 0.25 tell minification from magnification and never leave level 0.
    info.maxLod = desc.mipFilter == MipFilter::None ? 0.25f : VK_LOD_CLAMP_NONE;

    std::unique_ptr<Sampler> sampler(new Sampler(device));
    const VkResult result = device.fn().vkCreateSampler(device.handle(), &info, nullptr, &sampler->mHandle);
    if (result != VK_SUCCESS) return errorFromResult(result, "sampler");
    return sampler;
}

Sampler::~Sampler() { mDevice.fn().vkDestroySampler(mDevice.handle(), mHandle, nullptr); }

} // namespace filament_core::backend::vulkan
