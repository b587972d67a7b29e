// SPDX-License-Identifier: Apache-2.0
/// Pass: the pass being recorded: layouts, load and store operations and resolves around the draws.
///   begin() moves every attachment into the layout of its first use, and all other sampled textures to the layout for
///   reading, in one barrier; end() tells Barriers the final layouts of the attachments.
///   Thread  the driver thread.
///   Fails   a pass with an attachment that could not be created is skipped with its draws; the creation was reported.
#pragma once

#include "backend/api/Slots.h"
#include "backend/vulkan/Barriers.h"
#include "backend/vulkan/Framebuffers.h"

#include <array>

namespace filament_core::backend::vulkan {

class Pass {
public:
    Pass(Device& device, Slots<TextureHandle, Texture> const& textures, Barriers& barriers, RenderPasses& renderPasses,
         Framebuffers& framebuffers)
            : mDevice(device), mTextures(textures), mBarriers(barriers), mRenderPasses(renderPasses),
              mFramebuffers(framebuffers) {}

    /// OutOfMemory names the pass, which is then skipped.
    Result<void> begin(PassDesc const& desc, VkCommandBuffer commands);
    void nextSubpass(VkCommandBuffer commands);
    void end(VkCommandBuffer commands);

    bool isOpen() const { return mOpen; }
    bool isUsable() const { return mUsable; } ///< false outside of passes too
    Rect const& area() const { return mArea; }

private:
    bool collect(PassDesc const& desc, FramebufferKey& key);
    bool add(Texture* texture, uint32_t level, uint32_t layer, FramebufferKey& key);
    void prepareAttachments(PassDesc const& desc);
    void leaveAttachments();
    void recordBegin(PassDesc const& desc, FramebufferKey const& key, VkFramebuffer framebuffer,
                     VkCommandBuffer commands);

    Device& mDevice;
    Slots<TextureHandle, Texture> const& mTextures;
    Barriers& mBarriers;
    RenderPasses& mRenderPasses;
    Framebuffers& mFramebuffers;

    PassLayout mLayout{};
    Rect mArea{};
    std::array<Texture*, kMaxColorAttachments> mColors{}, mResolves{};
    Texture *mDepth = nullptr, *mDepthResolve = nullptr;
    std::array<SubresourceRange, kMaxColorAttachments> mColorRanges{};
    SubresourceRange mDepthRange;
    bool mOpen = false, mUsable = false;
};

} // namespace filament_core::backend::vulkan
