// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Texture.h"

#include "backend/vulkan/Formats.h"

#include <algorithm>

namespace filament_core::backend::vulkan {
namespace {

constexpr VkImageUsageFlags kAttachmentUsage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT |
                                               VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT |
                                               VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT;

VkImageUsageFlags usageFlags(TextureUsage usage) {
    VkImageUsageFlags flags = 0;
    if (has(usage, TextureUsage::Sampled)) flags |= VK_IMAGE_USAGE_SAMPLED_BIT;
    if (has(usage, TextureUsage::ColorAttachment)) flags |= VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
    if (has(usage, TextureUsage::DepthAttachment)) flags |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
    if (has(usage, TextureUsage::InputAttachment)) flags |= VK_IMAGE_USAGE_INPUT_ATTACHMENT_BIT;
    if (has(usage, TextureUsage::TransferSource)) flags |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
    if (has(usage, TextureUsage::TransferTarget)) flags |= VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    // The specification allows no other use together with transient memory.
    const bool attachmentOnly = flags != 0 && (flags & ~kAttachmentUsage) == 0;
    if (has(usage, TextureUsage::Transient) && attachmentOnly) flags |= VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT;
    return flags;
}

/// Passes see the stored bytes, samplers decode them.
bool hasTwoFormats(DeviceTextureDesc const& desc) {
    return has(desc.usage, TextureUsage::ColorAttachment) && attachmentFormat(desc.format) != desc.format;
}

VkImageCreateInfo imageInfo(DeviceTextureDesc const& desc) {
    auto info = make<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
    info.flags = isCube(desc.type) ? VK_IMAGE_CREATE_CUBE_COMPATIBLE_BIT : 0;
    if (hasTwoFormats(desc)) info.flags |= VK_IMAGE_CREATE_MUTABLE_FORMAT_BIT;
    const bool is3D = desc.type == TextureKind::Texture3D;
    // Passes attach slices by 2D views, of which an image says that it will have them (Vulkan 1.1, 12.3 and 12.5).
    if (is3D && has(desc.usage, TextureUsage::ColorAttachment)) info.flags |= VK_IMAGE_CREATE_2D_ARRAY_COMPATIBLE_BIT;
    info.imageType = is3D ? VK_IMAGE_TYPE_3D : VK_IMAGE_TYPE_2D;
    info.format = native(desc.format);
    info.extent = { desc.width, desc.height, is3D ? desc.layers : 1u };
    info.mipLevels = desc.levels;
    info.arrayLayers = is3D ? 1 : desc.layers;
    info.samples = sampleBits(desc.samples);
    info.usage = usageFlags(desc.usage);
    return info;
}

VkImageViewType viewType(TextureKind type) {
    switch (type) {
    case TextureKind::Texture2DArray:
        return VK_IMAGE_VIEW_TYPE_2D_ARRAY;
    case TextureKind::Cube:
        return VK_IMAGE_VIEW_TYPE_CUBE;
    case TextureKind::CubeArray:
        return VK_IMAGE_VIEW_TYPE_CUBE_ARRAY;
    case TextureKind::Texture3D:
        return VK_IMAGE_VIEW_TYPE_3D;
    case TextureKind::Texture2D:
        break;
    }
    return VK_IMAGE_VIEW_TYPE_2D;
}

/// "texture 'hdr' (1280x720 RGBA16F, 3 levels, 1 layers, 4 samples, 9830400 bytes)"
std::string describe(DeviceTextureDesc const& desc) {
    return fmt::format("texture '{}' ({}x{} {}, {} levels, {} layers, {} samples, {} bytes)", desc.debugName,
                       desc.width, desc.height, formatInfo(desc.format).name, desc.levels, desc.layers, desc.samples,
                       textureBytes(desc));
}

/// Queried first: an image beyond these limits is invalid usage, not an error that vkCreateImage would report.
Result<void> checkSupport(Device const& device, DeviceTextureDesc const& desc, VkImageCreateInfo const& info) {
    VkImageFormatProperties limits{};
    const VkResult result = device.instance().fn().vkGetPhysicalDeviceImageFormatProperties(
            device.physical().handle, info.format, info.imageType, info.tiling, info.usage, info.flags, &limits);
    if (result == VK_ERROR_FORMAT_NOT_SUPPORTED) {
        return fail(ErrorCode::Unsupported, "{}: '{}' cannot use this format that way; choose another format or usage",
                    describe(desc), device.info().deviceName);
    }
    if (result != VK_SUCCESS) return errorFromResult(result, describe(desc));
    const bool fits = desc.width <= limits.maxExtent.width && desc.height <= limits.maxExtent.height &&
                      info.extent.depth <= limits.maxExtent.depth && desc.levels <= limits.maxMipLevels &&
                      info.arrayLayers <= limits.maxArrayLayers && (limits.sampleCounts & info.samples) != 0;
    if (!fits) {
        return fail(ErrorCode::Unsupported, "{}: beyond the limits of '{}' ({}x{}, {} levels, {} layers)",
                    describe(desc), device.info().deviceName, limits.maxExtent.width, limits.maxExtent.height,
                    limits.maxMipLevels, limits.maxArrayLayers);
    }
    if (textureBytes(desc) > limits.maxResourceSize) {
        return fail(ErrorCode::OutOfMemory, "{}: '{}' allows {} bytes for one texture", describe(desc),
                    device.info().deviceName, limits.maxResourceSize);
    }
    return {};
}

/// Whether an image may be bound where another one is.
bool fits(VkMemoryRequirements const& needs, ImageMemory const& memory) {
    // The memory type was chosen among those of the first image, so another one must allow the same.
    return needs.size <= memory.allocation.bytes && memory.allocation.offset % needs.alignment == 0 &&
           needs.memoryTypeBits == memory.needs.memoryTypeBits;
}

} // namespace

Texture::Texture(Device& device, DeviceTextureDesc const& desc)
        : uses(desc.levels, imageInfo(desc).arrayLayers), mDevice(device), mType(desc.type), mFormat(desc.format),
          mAspects(aspectsOf(desc.format)), mExtent{ desc.width, desc.height }, mLevels(desc.levels),
          mLayers(imageInfo(desc).arrayLayers), mName(desc.debugName) {}

Result<std::unique_ptr<Texture>> Texture::create(Device& device, DeviceTextureDesc const& desc, Texture const* host) {
    if (Result<void> support = checkSupport(device, desc, imageInfo(desc)); !support) return support.error();
    std::unique_ptr<Texture> texture(new Texture(device, desc));
    VkResult result = texture->createImage(desc, host);
    if (result == VK_SUCCESS && has(desc.usage, TextureUsage::Sampled)) {
        result = texture->createView(texture->sampledKind(), texture->uses.all(), texture->mSampledView);
    }
    if (result != VK_SUCCESS) return errorFromResult(result, describe(desc));
    return texture;
}

VkResult Texture::createImage(DeviceTextureDesc const& desc, Texture const* host) {
    VolkDeviceTable const& fn = mDevice.fn();
    VkImageCreateInfo info = imageInfo(desc);
    const std::array formats{ native(desc.format), native(attachmentFormat(desc.format)) };
    auto list = make<VkImageFormatListCreateInfoKHR>(VK_STRUCTURE_TYPE_IMAGE_FORMAT_LIST_CREATE_INFO_KHR);
    list.viewFormatCount = formats.size(), list.pViewFormats = formats.data();
    if (hasTwoFormats(desc) && mDevice.physical().imageFormatList) info.pNext = &list;
    const VkResult created = fn.vkCreateImage(mDevice.handle(), &info, nullptr, &mImage);
    if (created != VK_SUCCESS) return created;
    mDevice.setName(VK_OBJECT_TYPE_IMAGE, mImage, mName);

    VkMemoryRequirements needs{};
    fn.vkGetImageMemoryRequirements(mDevice.handle(), mImage, &needs);
    if (host && fits(needs, *host->mMemory))
        mMemory = host->mMemory;
    else if (const VkResult allocated = allocate(needs, (info.usage & VK_IMAGE_USAGE_TRANSIENT_ATTACHMENT_BIT) != 0);
             allocated != VK_SUCCESS)
        return allocated;
    Allocation const& at = mMemory->allocation;
    return fn.vkBindImageMemory(mDevice.handle(), mImage, Memory::handleOf(at), at.offset);
}

VkResult Texture::allocate(VkMemoryRequirements const& needs, bool isTransient) {
    auto memory = std::make_shared<ImageMemory>(mDevice, needs);
    const auto allocation = mDevice.memory().allocate(needs, ResourceKind::Optimal,
                                                      isTransient ? MemoryPurpose::Transient : MemoryPurpose::Device);
    if (!allocation) return VK_ERROR_OUT_OF_DEVICE_MEMORY;
    memory->allocation = *allocation;
    memory->user = this;
    mMemory = std::move(memory);
    return VK_SUCCESS;
}

VkResult Texture::createView(ViewKind const& kind, SubresourceRange const& range, VkImageView& view) {
    auto info = make<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
    info.image = mImage;
    info.viewType = kind.type;
    info.format = native(kind.format);
    info.subresourceRange = { kind.aspects, range.level, range.levelCount, range.layer, range.layerCount };
    const VkResult result = mDevice.fn().vkCreateImageView(mDevice.handle(), &info, nullptr, &view);
    if (result == VK_SUCCESS) mDevice.setName(VK_OBJECT_TYPE_IMAGE_VIEW, view, mName);
    return result;
}

VkImageView Texture::partView(std::vector<PartView>& views, SubresourceRange const& range, ViewKind const& kind) {
    const auto known = std::ranges::find(views, range, &PartView::range);
    if (known != views.end()) return known->view;
    PartView made{ range };
    if (createView(kind, range, made.view) != VK_SUCCESS) return VK_NULL_HANDLE;
    views.push_back(made);
    return made.view;
}

Texture::ViewKind Texture::sampledKind() const { return { viewType(mType), copyAspectOf(mFormat), mFormat }; }

VkImageView Texture::sampledView(TextureRange const& range) {
    const TextureRange part = withCounts(range, static_cast<uint8_t>(mLevels), static_cast<uint16_t>(mLayers));
    const SubresourceRange wanted{ part.level, part.levelCount, part.layer, part.layerCount };
    if (!isSampled() || wanted == uses.all()) return mSampledView;
    return partView(mSampledParts, wanted, sampledKind());
}

VkImageView Texture::attachmentView(uint32_t level, uint32_t layer) {
    const ViewKind kind{ VK_IMAGE_VIEW_TYPE_2D, mAspects, attachmentFormat(mFormat) };
    return partView(mAttachmentViews, { level, 1, layer, 1 }, kind);
}

bool Texture::owns(VkImageView view) const {
    return std::ranges::find(mAttachmentViews, view, &PartView::view) != mAttachmentViews.end();
}

Texture::~Texture() {
    VolkDeviceTable const& fn = mDevice.fn();
    for (PartView const& each : mAttachmentViews) fn.vkDestroyImageView(mDevice.handle(), each.view, nullptr);
    for (PartView const& each : mSampledParts) fn.vkDestroyImageView(mDevice.handle(), each.view, nullptr);
    fn.vkDestroyImageView(mDevice.handle(), mSampledView, nullptr);
    fn.vkDestroyImage(mDevice.handle(), mImage, nullptr);
    // Whichever texture takes the memory next must not find this one. Its readers have finished, so nothing waits for
    // them.
    if (mMemory && hasMemory()) mMemory->user = nullptr;
}

} // namespace filament_core::backend::vulkan
