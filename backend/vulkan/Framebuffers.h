// SPDX-License-Identifier: Apache-2.0
/// Framebuffers: VkFramebuffer objects, created once per render pass and set of attachments.
///   Thread  the driver thread.
///   Memory  they live until one of their textures is destroyed: take() returns those that use it.
///   Fails   get() with a null handle if the device is out of memory.
#pragma once

#include "backend/vulkan/RenderPasses.h"
#include "backend/vulkan/Texture.h"

#include <array>
#include <memory>
#include <unordered_map>
#include <vector>

namespace filament_core::backend::vulkan {

struct FramebufferKey {
    VkRenderPass pass = VK_NULL_HANDLE;
    std::array<VkImageView, kMaxAttachments> views{};
    uint32_t viewCount = 0;
    uint32_t width = 0, height = 0;
    friend bool operator==(FramebufferKey const&, FramebufferKey const&) = default;
};

class Framebuffer final : public DeviceObject {
public:
    Framebuffer(Device& device, VkFramebuffer handle) : mDevice(device), mHandle(handle) {}
    ~Framebuffer() override { mDevice.fn().vkDestroyFramebuffer(mDevice.handle(), mHandle, nullptr); }
    VkFramebuffer handle() const { return mHandle; }

private:
    Device& mDevice;
    VkFramebuffer mHandle;
};

class Framebuffers {
public:
    explicit Framebuffers(Device& device) : mDevice(device) {}

    VkFramebuffer get(FramebufferKey const& key);
    /// Removes the framebuffers that draw into the texture; the caller keeps them until the GPU is done.
    std::vector<std::unique_ptr<Framebuffer>> take(Texture const& texture);

private:
    struct Hash {
        size_t operator()(FramebufferKey const& key) const;
    };

    Device& mDevice;
    std::unordered_map<FramebufferKey, std::unique_ptr<Framebuffer>, Hash> mFramebuffers;
};

} // namespace filament_core::backend::vulkan
