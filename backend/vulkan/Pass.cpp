// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Pass.h"

#include <algorithm>

namespace filament_core::backend::vulkan {
namespace {

/// The other slices of a level share its layout, and keep what they hold.
Contents contentsFor(LoadOp load, Texture const& texture) {
    return load == LoadOp::Load || texture.is3D() ? Contents::Keep : Contents::Discard;
}

VkClearValue clearColor(Attachment const& attachment, Format format) {
    VkClearValue value{};
    for (size_t i = 0; i < 4; ++i) {
        if (formatInfo(format).kind == FormatKind::UnsignedInteger) {
            value.color.uint32[i] = static_cast<uint32_t>(std::max(attachment.clear[i], 0.0f));
        } else {
            value.color.float32[i] = attachment.clear[i];
        }
    }
    return value;
}

} // namespace

Result<void> Pass::begin(PassDesc const& desc, VkCommandBuffer commands) {
    mLayout = desc.layout;
    mArea = desc.area;
    mColors = mResolves = {};
    mDepth = mDepthResolve = nullptr;
    mOpen = true;
    mUsable = false;
    FramebufferKey key;
    // Before anything is recorded: a pass with a missing attachment leaves no barrier behind.
    if (!collect(desc, key)) return {};
    key.pass = mRenderPasses.get(keyOf(desc));
    const VkFramebuffer framebuffer = key.pass != VK_NULL_HANDLE ? mFramebuffers.get(key) : VK_NULL_HANDLE;
    if (framebuffer == VK_NULL_HANDLE) {
        return fail(ErrorCode::OutOfMemory, "pass '{}': no framebuffer, the pass is skipped", desc.debugName);
    }
    mUsable = true;
    prepareAttachments(desc);
    // The attachments are known by now: all other sampled textures become readable.
    mBarriers.beginPass();
    mBarriers.flush(mDevice.fn(), commands);
    recordBegin(desc, key, framebuffer, commands);
    return {};
}

void Pass::nextSubpass(VkCommandBuffer commands) {
    mDevice.fn().vkCmdNextSubpass(commands, VK_SUBPASS_CONTENTS_INLINE);
}

void Pass::end(VkCommandBuffer commands) {
    if (mUsable) {
        mDevice.fn().vkCmdEndRenderPass(commands);
        // The render pass has changed the layouts by itself, without a barrier.
        leaveAttachments();
        mBarriers.endPass();
    }
    mOpen = mUsable = false;
}

bool Pass::collect(PassDesc const& desc, FramebufferKey& key) {
    key.width = static_cast<uint32_t>(desc.area.x) + desc.area.width;
    key.height = static_cast<uint32_t>(desc.area.y) + desc.area.height;
    for (uint32_t i = 0; i < desc.layout.colorCount; ++i) {
        Attachment const& color = desc.colors[i];
        mColors[i] = mTextures.find(color.texture);
        if (!add(mColors[i], color.level, color.layer, key)) return false;
        mColorRanges[i] = mColors[i]->part(color.level, color.layer);
    }
    if (desc.layout.depthFormat != Format::None) {
        mDepth = mTextures.find(desc.depth.texture);
        if (!add(mDepth, desc.depth.level, desc.depth.layer, key)) return false;
        mDepthRange = mDepth->part(desc.depth.level, desc.depth.layer);
    }
    for (uint32_t i = 0; i < desc.layout.colorCount; ++i) {
        if ((desc.layout.resolveMask >> i & 1) == 0) continue;
        mResolves[i] = mTextures.find(desc.colors[i].resolve);
        if (!add(mResolves[i], 0, 0, key)) return false;
    }
    if (!mLayout.resolvesDepth) return true;
    mDepthResolve = mTextures.find(desc.depth.resolve);
    return add(mDepthResolve, 0, 0, key);
}

bool Pass::add(Texture* texture, uint32_t level, uint32_t layer, FramebufferKey& key) {
    const VkImageView view = texture ? texture->attachmentView(level, layer) : VK_NULL_HANDLE;
    if (view == VK_NULL_HANDLE) return false;
    key.views[key.viewCount++] = view;
    return true;
}

void Pass::prepareAttachments(PassDesc const& desc) {
    for (uint32_t i = 0; i < mLayout.colorCount; ++i) {
        const Use first = firstColorUse(mLayout, i);
        mBarriers.attach(*mColors[i], mColorRanges[i], first, contentsFor(desc.colors[i].load, *mColors[i]));
        if (mResolves[i]) mBarriers.attach(*mResolves[i], {}, Use::ColorAttachment, Contents::Discard);
    }
    if (mDepthResolve) mBarriers.attach(*mDepthResolve, {}, Use::DepthResolve, Contents::Discard);
    if (mDepth) mBarriers.attach(*mDepth, mDepthRange, Use::DepthAttachment, contentsFor(desc.depth.load, *mDepth));
}

void Pass::leaveAttachments() {
    for (uint32_t i = 0; i < mLayout.colorCount; ++i) {
        mBarriers.leave(*mColors[i], mColorRanges[i], lastColorUse(mLayout, i));
    }
    if (mDepthResolve) mBarriers.leave(*mDepth, mDepthRange, Use::DepthResolve);
}

void Pass::recordBegin(PassDesc const& desc, FramebufferKey const& key, VkFramebuffer framebuffer,
                       VkCommandBuffer commands) {
    std::array<VkClearValue, kMaxAttachments> clears{};
    for (uint32_t i = 0; i < mLayout.colorCount; ++i) {
        clears[i] = clearColor(desc.colors[i], mLayout.colorFormats[i]);
    }
    clears[mLayout.colorCount].depthStencil = { desc.depth.clear[0], static_cast<uint32_t>(desc.depth.clear[1]) };
    auto info = make<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
    info.renderPass = key.pass;
    info.framebuffer = framebuffer;
    info.renderArea = { { mArea.x, mArea.y }, { mArea.width, mArea.height } };
    info.clearValueCount = key.viewCount;
    info.pClearValues = clears.data();
    mDevice.fn().vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
}

} // namespace filament_core::backend::vulkan
