// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Executor.h"

#include "backend/vulkan/Formats.h"

#include <algorithm>

namespace filament::backend::vulkan {
namespace {

Contents contentsFor(LoadOp load) { return load == LoadOp::Load ? Contents::Keep : Contents::Discard; }

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

// ---------------------------------------------------------------------------------------------- begin and end

void Executor::execute(CmdBeginPass const& command) {
    PassDesc const& desc = command.desc;
    ++mPassNumber;
    ++mStatistics.passes;
    label(desc.debugName);
    OpenPass pass;
    pass.layout = desc.layout;
    pass.area = desc.area;
    FramebufferKey framebuffer;
    pass.isSkipped = !collectAttachments(desc, pass, framebuffer) || !recordBeginPass(desc, pass, framebuffer);
    mPass = pass;
    mDraws->beginSubpass(desc.area);
}

bool Executor::collectAttachments(PassDesc const& desc, OpenPass& pass, FramebufferKey& framebuffer) {
    framebuffer.width = static_cast<uint32_t>(desc.area.x) + desc.area.width;
    framebuffer.height = static_cast<uint32_t>(desc.area.y) + desc.area.height;
    for (uint32_t i = 0; i < desc.layout.colorCount; ++i) {
        pass.colors[i] = mTextures.find(desc.colors[i].texture);
        pass.colorRanges[i] = { desc.colors[i].level, 1, desc.colors[i].layer, 1 };
        if (!addAttachment(pass.colors[i], pass.colorRanges[i], framebuffer)) return false;
    }
    if (desc.layout.depthFormat != Format::None) {
        pass.depth = mTextures.find(desc.depth.texture);
        pass.depthRange = { desc.depth.level, 1, desc.depth.layer, 1 };
        if (!addAttachment(pass.depth, pass.depthRange, framebuffer)) return false;
    }
    for (uint32_t i = 0; i < desc.layout.colorCount; ++i) {
        if ((desc.layout.resolveMask >> i & 1) == 0) continue;
        pass.resolves[i] = mTextures.find(desc.colors[i].resolve);
        if (!addAttachment(pass.resolves[i], {}, framebuffer)) return false;
    }
    return true;
}

bool Executor::addAttachment(Texture* texture, SubresourceRange const& range, FramebufferKey& framebuffer) {
    const VkImageView view = texture ? texture->attachmentView(range.level, range.layer) : VK_NULL_HANDLE;
    if (view == VK_NULL_HANDLE) return false;
    texture->attachmentOfPass = mPassNumber;
    framebuffer.views[framebuffer.viewCount++] = view;
    return true;
}

bool Executor::recordBeginPass(PassDesc const& desc, OpenPass const& pass, FramebufferKey& key) {
    key.pass = mRenderPasses->get(keyOf(desc));
    const VkFramebuffer framebuffer = key.pass != VK_NULL_HANDLE ? mFramebuffers->get(key) : VK_NULL_HANDLE;
    if (framebuffer == VK_NULL_HANDLE) {
        report(fail(ErrorCode::OutOfMemory, "pass '{}': no framebuffer, the pass is skipped", desc.debugName));
        return false;
    }
    prepareAttachments(desc, pass);
    mBarriers.beginPass(mPassNumber);
    VkCommandBuffer recording = commands();
    flushBarriers();

    std::array<VkClearValue, kMaxAttachments> clears{};
    for (uint32_t i = 0; i < desc.layout.colorCount; ++i) {
        clears[i] = clearColor(desc.colors[i], desc.layout.colorFormats[i]);
    }
    clears[desc.layout.colorCount].depthStencil = { desc.depth.clear[0], static_cast<uint32_t>(desc.depth.clear[1]) };
    auto info = make<VkRenderPassBeginInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO);
    info.renderPass = key.pass;
    info.framebuffer = framebuffer;
    info.renderArea = { { desc.area.x, desc.area.y }, { desc.area.width, desc.area.height } };
    info.clearValueCount = key.viewCount;
    info.pClearValues = clears.data();
    mDevice->fn().vkCmdBeginRenderPass(recording, &info, VK_SUBPASS_CONTENTS_INLINE);
    return true;
}

void Executor::prepareAttachments(PassDesc const& desc, OpenPass const& pass) {
    for (uint32_t i = 0; i < desc.layout.colorCount; ++i) {
        const Use first = firstColorUse(desc.layout, i);
        mBarriers.image(*pass.colors[i], pass.colorRanges[i], first, contentsFor(desc.colors[i].load));
        if (pass.resolves[i]) mBarriers.image(*pass.resolves[i], {}, Use::ColorAttachment, Contents::Discard);
    }
    if (pass.depth) {
        mBarriers.image(*pass.depth, pass.depthRange, Use::DepthAttachment, contentsFor(desc.depth.load));
    }
}

void Executor::leaveAttachments(OpenPass const& pass) {
    for (uint32_t i = 0; i < pass.layout.colorCount; ++i) {
        mBarriers.leave(*pass.colors[i], pass.colorRanges[i], lastColorUse(pass.layout, i));
    }
}

void Executor::execute(CmdNextSubpass const&) {
    if (!mPass || mPass->isSkipped) return;
    mDevice->fn().vkCmdNextSubpass(commands(), VK_SUBPASS_CONTENTS_INLINE);
    mDraws->beginSubpass(mPass->area);
}

void Executor::execute(CmdEndPass const&) {
    if (!mPass) return;
    if (!mPass->isSkipped) {
        mDevice->fn().vkCmdEndRenderPass(commands());
        leaveAttachments(*mPass);
        mBarriers.endPass();
    }
    mPass.reset();
    endLabel();
}

// ---------------------------------------------------------------------------------------------- inside

void Executor::execute(CmdBindGroup const& command) {
    BindGroup const* const group = mBindGroups.find(command.group);
    BoundGroup bound{ .group = group };
    if (group) {
        bound.offsetCount = group->layout()->dynamicCount();
        std::copy_n(command.dynamicOffsets.begin(), bound.offsetCount, bound.offsets.begin());
    }
    mDraws->setGroup(command.index, bound);
}

void Executor::execute(CmdBindVertexBuffers const& command) {
    BoundVertexBuffers bound;
    for (uint32_t slot = 0; slot < command.count; ++slot) {
        Buffer* const buffer = mBuffers.find(command.buffers[slot]);
        if (!buffer) continue;
        buffer->isUsed = true;
        bound.buffers[slot] = buffer->handle();
        bound.offsets[slot] = command.offsets[slot];
    }
    mDraws->setVertexBuffers(bound);
}

void Executor::execute(CmdBindIndexBuffer const& command) {
    Buffer* const buffer = mBuffers.find(command.buffer);
    if (!buffer) return mDraws->setIndexBuffer({});
    buffer->isUsed = true;
    mDraws->setIndexBuffer({ buffer->handle(), command.offset, native(command.type) });
}

void Executor::execute(CmdDraw const& command) {
    if (!mPass || mPass->isSkipped || !mDraws->prepareDraw(false)) return;
    ++mStatistics.draws;
    mDevice->fn().vkCmdDraw(mSubmissions->commands(), command.vertexCount, command.instanceCount, command.firstVertex,
                            command.firstInstance);
}

void Executor::execute(CmdDrawIndexed const& command) {
    if (!mPass || mPass->isSkipped || !mDraws->prepareDraw(true)) return;
    ++mStatistics.draws;
    mDevice->fn().vkCmdDrawIndexed(mSubmissions->commands(), command.indexCount, command.instanceCount,
                                   command.firstIndex, command.vertexOffset, command.firstInstance);
}

} // namespace filament::backend::vulkan
