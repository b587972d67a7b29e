// SPDX-License-Identifier: Apache-2.0
/// Texture: a VkImage with its memory and views, and the last use of every level and layer.
///   Thread  the driver thread.
///   Memory  Device memory; tile memory for Transient attachments where the device has it. One view for sampling, one
///           per level and layer that has been an attachment.
///   Fails   create(): OutOfMemory with name and size, Unsupported with the format and usage that the device lacks.
#pragma once

#include "backend/api/Descriptions.h"
#include "backend/vulkan/Barriers.h"
#include "backend/vulkan/Device.h"

#include <string>
#include <vector>

namespace filament::backend::vulkan {

class Texture final : public DeviceObject {
public:
    static Result<std::unique_ptr<Texture>> create(Device& device, DeviceTextureDesc const& desc);
    ~Texture() override;

    VkImage image() const { return mImage; }
    VkImageView sampledView() const { return mSampledView; } ///< null without TextureUsage::Sampled
    /// 2D view of one level and layer, made on first use; null if the device refuses.
    VkImageView attachmentView(uint32_t level, uint32_t layer);
    bool owns(VkImageView view) const;

    Format format() const { return mFormat; }
    VkImageAspectFlags aspects() const { return mAspects; }
    bool isSampled() const { return mSampledView != VK_NULL_HANDLE; }
    uint32_t levels() const { return mLevels; }
    uint32_t layers() const { return mLayers; }
    VkExtent2D extent(uint32_t level) const {
        return { std::max(1u, mExtent.width >> level), std::max(1u, mExtent.height >> level) };
    }
    std::string const& name() const { return mName; }

    // Bookkeeping of Barriers.
    SubresourceUses uses;
    uint64_t attachmentOfPass = 0; ///< running number of the last pass that it is an attachment of
    bool isUnsettled = false;      ///< listed for a transition to Use::ShaderRead

private:
    Texture(Device& device, DeviceTextureDesc const& desc);
    VkResult createImage(DeviceTextureDesc const& desc);
    VkResult createView(VkImageViewType type, VkImageAspectFlags aspects, SubresourceRange const& range,
                        VkImageView& view);

    struct AttachmentView {
        uint32_t level = 0, layer = 0;
        VkImageView view = VK_NULL_HANDLE;
    };

    Device& mDevice;
    VkImage mImage = VK_NULL_HANDLE;
    VkImageView mSampledView = VK_NULL_HANDLE;
    std::vector<AttachmentView> mAttachmentViews;
    Allocation mAllocation;
    Format mFormat;
    VkImageAspectFlags mAspects;
    VkExtent2D mExtent;
    uint32_t mLevels, mLayers;
    std::string mName;
};

} // namespace filament::backend::vulkan
