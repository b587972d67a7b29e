// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Executor.h"

#include "backend/vulkan/Formats.h"
#include "base/Assert.h"

#include <cstring>

namespace filament_core::backend::vulkan {
namespace {

/// Of a texture's subresources: those of all slices are one.
SubresourceRange layersOf(Texture const& texture, uint32_t level, uint32_t layer, uint32_t layerCount) {
    SubresourceRange range = texture.part(level, layer);
    if (!texture.is3D()) range.layerCount = layerCount;
    return range;
}

/// Of a 3D texture.
struct Slices {
    uint32_t first, count;
};

VkBufferImageCopy copyRegion(Texture const& texture, uint64_t bufferOffset, SubresourceRange const& range,
                             Rect const& rect, Slices slices) {
    VkBufferImageCopy region{};
    region.bufferOffset = bufferOffset; // row length and image height 0: tightly packed
    region.imageSubresource = { copyAspectOf(texture.format()), range.level, range.layer, range.layerCount };
    region.imageOffset = { rect.x, rect.y, texture.is3D() ? static_cast<int32_t>(slices.first) : 0 };
    region.imageExtent = { rect.width, rect.height, texture.is3D() ? slices.count : 1 };
    return region;
}

bool covers(Rect const& rect, VkExtent2D extent) {
    return rect.x == 0 && rect.y == 0 && rect.width == extent.width && rect.height == extent.height;
}

bool isEmpty(Rect const& rect) { return rect.width == 0 || rect.height == 0; }

void setOffsets(VkOffset3D (&offsets)[2], Rect const& rect) {
    offsets[0] = { rect.x, rect.y, 0 };
    offsets[1] = { rect.x + static_cast<int32_t>(rect.width), rect.y + static_cast<int32_t>(rect.height), 1 };
}

} // namespace

// ---------------------------------------------------------------------------------------------- uploads

std::optional<StagedBytes> Executor::stage(std::span<const std::byte> bytes, std::string_view target) {
    commands(); // opens the submission that staged bytes belong to
    auto staged = mUpload->stage(bytes);
    if (!staged) report(fail(ErrorCode::OutOfMemory, "upload of {} bytes to '{}'", bytes.size(), target));
    return staged;
}

void Executor::execute(CmdUpdateBuffer const& command) {
    Buffer* const buffer = mBuffers.find(command.buffer);
    if (!buffer || command.bytes.empty()) return;
    const uint64_t end = command.offset + command.bytes.size();
    FILAMENT_ASSERT(end >= command.offset && end <= buffer->bytes(), "an update stays inside its buffer");
    // No submission refers to it yet, so it can be written now, without a copy on the device.
    if (!buffer->isUsed && buffer->mapped()) {
        std::memcpy(buffer->mapped() + command.offset, command.bytes.data(), command.bytes.size());
        return; // visible to the next submission
    }
    // Staging comes before the barrier, since it may fail: without a copy, no write must be noted.
    const auto staged = stage(command.bytes, "a buffer");
    if (!staged) return;
    buffer->isUsed = true;
    mBarriers.bufferWrite(*buffer, command.offset, end);
    flushBarriers();
    const VkBufferCopy region{ staged->offset, command.offset, command.bytes.size() };
    mDevice->fn().vkCmdCopyBuffer(commands(), staged->buffer, buffer->handle(), 1, &region);
}

void Executor::execute(CmdUploadTexture const& command) {
    Texture* const texture = mTextures.find(command.texture);
    if (!texture || isEmpty(command.rect)) return;
    if (hasStencil(texture->format())) {
        return report(fail(ErrorCode::Unsupported, "texture '{}': depth with stencil cannot be uploaded; render it",
                           texture->name()));
    }
    const uint64_t bytes = imageBytes(texture->format(), command.rect.width, command.rect.height) * command.layerCount;
    FILAMENT_ASSERT(command.bytes.size() >= bytes, "an upload has the bytes of its rectangle in every layer");
    const auto staged = stage(command.bytes.first(bytes), texture->name());
    if (!staged) return;
    const SubresourceRange range = layersOf(*texture, command.level, command.layer, command.layerCount);
    const bool replacesAll = !texture->is3D() && covers(command.rect, texture->extent(command.level));
    // A level of a layer has one layout: the texels around the rectangle survive only if the old one is named.
    mBarriers.image(*texture, range, Use::TransferWrite, replacesAll ? Contents::Discard : Contents::Keep);
    flushBarriers();
    const VkBufferImageCopy region =
            copyRegion(*texture, staged->offset, range, command.rect, { command.layer, command.layerCount });
    mDevice->fn().vkCmdCopyBufferToImage(commands(), staged->buffer, texture->image(),
                                         infoOf(Use::TransferWrite).layout, 1, &region);
}

// ---------------------------------------------------------------------------------------------- blits

bool Executor::canBlit(Texture const& texture, VkFormatFeatureFlags needed, std::string_view what) {
    if ((needed & VK_FORMAT_FEATURE_BLIT_DST_BIT) != 0 && formatInfo(texture.format()).isSrgb) {
        report(fail(ErrorCode::Unsupported,
                    "{} of texture '{}' would let the driver encode {}, which has other bits on other processors; "
                    "upload the texels",
                    what, texture.name(), formatInfo(texture.format()).name));
        return false;
    }
    VkFormatProperties properties{};
    mDevice->instance().fn().vkGetPhysicalDeviceFormatProperties(mDevice->physical().handle, native(texture.format()),
                                                                 &properties);
    if ((properties.optimalTilingFeatures & needed) == needed) return true;
    report(fail(ErrorCode::Unsupported, "{} of texture '{}': '{}' cannot filter {} that way; choose another format",
                what, texture.name(), info().deviceName, formatInfo(texture.format()).name));
    return false;
}

void Executor::recordBlit(Texture& source, VkImageBlit const& blit, Texture& target, Contents targetContents,
                          Filter filter) {
    VkImageSubresourceLayers const& from = blit.srcSubresource;
    VkImageSubresourceLayers const& to = blit.dstSubresource;
    mBarriers.image(source, { from.mipLevel, 1, from.baseArrayLayer, from.layerCount }, Use::TransferRead);
    mBarriers.image(target, { to.mipLevel, 1, to.baseArrayLayer, to.layerCount }, Use::TransferWrite, targetContents);
    flushBarriers();
    mDevice->fn().vkCmdBlitImage(commands(), source.image(), infoOf(Use::TransferRead).layout, target.image(),
                                 infoOf(Use::TransferWrite).layout, 1, &blit, native(filter));
}

void Executor::execute(CmdGenerateMips const& command) {
    Texture* const texture = mTextures.find(command.texture);
    if (!texture || texture->levels() == 1) return;
    constexpr VkFormatFeatureFlags kNeeded = VK_FORMAT_FEATURE_BLIT_SRC_BIT | VK_FORMAT_FEATURE_BLIT_DST_BIT |
                                             VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    if (!canBlit(*texture, kNeeded, "mips")) return;
    for (uint32_t level = 1; level < texture->levels(); ++level) {
        VkImageBlit blit{};
        const VkExtent2D from = texture->extent(level - 1), to = texture->extent(level);
        blit.srcSubresource = { VK_IMAGE_ASPECT_COLOR_BIT, level - 1, 0, texture->layers() };
        blit.dstSubresource = { VK_IMAGE_ASPECT_COLOR_BIT, level, 0, texture->layers() };
        setOffsets(blit.srcOffsets, { 0, 0, from.width, from.height });
        setOffsets(blit.dstOffsets, { 0, 0, to.width, to.height });
        recordBlit(*texture, blit, *texture, Contents::Discard, Filter::Linear);
    }
}

void Executor::execute(CmdBlit const& command) {
    Texture* const source = mTextures.find(command.source);
    Texture* const target = mTextures.find(command.target);
    if (!source || !target || isEmpty(command.sourceRect) || isEmpty(command.targetRect)) return;
    VkFormatFeatureFlags needed = VK_FORMAT_FEATURE_BLIT_SRC_BIT;
    if (command.filter == Filter::Linear) needed |= VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT;
    if (!canBlit(*source, needed, "blit") || !canBlit(*target, VK_FORMAT_FEATURE_BLIT_DST_BIT, "blit")) return;
    VkImageBlit blit{};
    blit.srcSubresource = { VK_IMAGE_ASPECT_COLOR_BIT, command.sourceLevel, command.sourceLayer, 1 };
    blit.dstSubresource = { VK_IMAGE_ASPECT_COLOR_BIT, command.targetLevel, command.targetLayer, 1 };
    setOffsets(blit.srcOffsets, command.sourceRect);
    setOffsets(blit.dstOffsets, command.targetRect);
    const bool replacesAll = covers(command.targetRect, target->extent(command.targetLevel));
    recordBlit(*source, blit, *target, replacesAll ? Contents::Discard : Contents::Keep, command.filter);
}

// ---------------------------------------------------------------------------------------------- read-backs

void Executor::execute(CmdReadBuffer const& command) {
    Buffer* const buffer = mBuffers.find(command.buffer);
    if (!buffer || command.size == 0) return mSink.onReadback(command.ticket, {});
    FILAMENT_ASSERT(command.offset <= buffer->bytes() && command.size <= buffer->bytes() - command.offset,
                    "a read-back stays inside its buffer");
    auto target = mReadbacks->makeTarget(command);
    if (!target) {
        report(target.error());
        return mSink.onReadback(command.ticket, {});
    }
    buffer->isUsed = true;
    VkCommandBuffer recording = commands();
    mBarriers.bufferRead();
    flushBarriers();
    const VkBufferCopy region{ command.offset, 0, command.size };
    mDevice->fn().vkCmdCopyBuffer(recording, buffer->handle(), (*target)->handle(), 1, &region);
    // Emitted at the latest when the submission ends. A fence alone makes no writes visible to the host.
    mBarriers.hostRead();
    mReadbacks->add(command.ticket, Format::None, std::move(*target), mSubmissions->recordingSerial());
}

void Executor::execute(CmdReadTexture const& command) {
    Texture* const texture = mTextures.find(command.texture);
    if (!texture || isEmpty(command.rect)) return mSink.onReadback(command.ticket, {});
    auto target = mReadbacks->makeTarget(command, *texture);
    if (!target) {
        report(target.error());
        return mSink.onReadback(command.ticket, {});
    }
    recordReadback(command, *texture, std::move(*target));
}

void Executor::recordReadback(CmdReadTexture const& command, Texture& texture, std::unique_ptr<Buffer> target) {
    const SubresourceRange range = layersOf(texture, command.level, command.layer, 1);
    mBarriers.image(texture, range, Use::TransferRead);
    VkCommandBuffer recording = commands();
    flushBarriers();
    const VkBufferImageCopy region = copyRegion(texture, 0, range, command.rect, { command.layer, 1 });
    mDevice->fn().vkCmdCopyImageToBuffer(recording, texture.image(), infoOf(Use::TransferRead).layout, target->handle(),
                                         1, &region);
    mBarriers.hostRead();
    mReadbacks->add(command.ticket, texture.format(), std::move(target), mSubmissions->recordingSerial());
}

// ---------------------------------------------------------------------------------------------- windows

void Executor::execute(CmdPresent const& command) {
    Surface* const surface = mSurfaces.find(command.surface);
    Texture* const texture = mTextures.find(command.texture);
    if (!surface || !texture) return;
    commands(); // opens the submission that will wait for the image
    // Before anything is recorded: without an image the frame stays as it is.
    const Result<std::optional<Surface::Target>> target =
            surface->acquire(texture->format(), texture->extent(0), *mSubmissions);
    if (!target && !std::exchange(surface->isReported, true)) report(target.error());
    if (!target || !*target) return;
    mBarriers.image(*texture, { 0, 1, 0, 1 }, Use::TransferRead);
    flushBarriers();
    surface->recordCopy(commands(), texture->image(), texture->extent(0), **target);
    // The semaphores belong to a submission, so this one ends here.
    if (!check(mSubmissions->submit((*target)->acquired, (*target)->drawn), "submit")) return;
    const VkResult presented = surface->present(**target, *mSubmissions);
    if (presented == VK_ERROR_DEVICE_LOST) check(presented, "present");
    if (presented < VK_SUCCESS) return;
    ++mStatistics.presents;
    mStatistics.lastPresent = std::chrono::steady_clock::now();
}

} // namespace filament_core::backend::vulkan
