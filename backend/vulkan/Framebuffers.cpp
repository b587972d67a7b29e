// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Framebuffers.h"

#include "base/Hash.h"

#include <algorithm>

namespace filament_core::backend::vulkan {

size_t Framebuffers::Hash::operator()(FramebufferKey const& key) const {
    uint64_t hash = hashBytes(std::as_bytes(std::span(key.views.data(), key.viewCount)), bitsOf(key.pass));
    return hashCombine(hash, uint64_t{ key.width } << 32 | key.height);
}

VkFramebuffer Framebuffers::get(FramebufferKey const& key) {
    if (const auto known = mFramebuffers.find(key); known != mFramebuffers.end()) return known->second->handle();
    auto info = make<VkFramebufferCreateInfo>(VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO);
    info.renderPass = key.pass;
    info.attachmentCount = key.viewCount;
    info.pAttachments = key.views.data();
    info.width = key.width;
    info.height = key.height;
    info.layers = 1;
    VkFramebuffer handle = VK_NULL_HANDLE;
    if (mDevice.fn().vkCreateFramebuffer(mDevice.handle(), &info, nullptr, &handle) != VK_SUCCESS)
        return VK_NULL_HANDLE;
    mFramebuffers.emplace(key, std::make_unique<Framebuffer>(mDevice, handle));
    return handle;
}

std::vector<std::unique_ptr<Framebuffer>> Framebuffers::take(Texture const& texture) {
    std::vector<std::unique_ptr<Framebuffer>> taken;
    for (auto entry = mFramebuffers.begin(); entry != mFramebuffers.end();) {
        const auto views = std::span(entry->first.views).first(entry->first.viewCount);
        if (std::ranges::any_of(views, [&](VkImageView view) { return texture.owns(view); })) {
            taken.push_back(std::move(entry->second));
            entry = mFramebuffers.erase(entry);
        } else {
            ++entry;
        }
    }
    return taken;
}

} // namespace filament_core::backend::vulkan
