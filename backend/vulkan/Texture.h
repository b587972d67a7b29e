// SPDX-License-Identifier: Apache-2.0
/// Texture: a VkImage with its memory and views, and the last use of every level and layer.
///   Thread  the driver thread.
///   Memory  Device memory, which textures may share; tile memory for Transient attachments where the device has it.
///           One view for sampling everything, and one for each part that a bind group has shown or a pass has
///           attached.
///   Fails   create(): OutOfMemory with name and size, Unsupported with the format and usage that the device lacks.
#pragma once

#include "backend/api/Descriptions.h"
#include "backend/vulkan/Barriers.h"
#include "backend/vulkan/Device.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace filament_core::backend::vulkan {

class Texture;

/// Memory of one image, or of several that share it.
struct ImageMemory {
    ImageMemory(Device& of, VkMemoryRequirements const& ofImage) : device(of), needs(ofImage) {}
    ~ImageMemory() {
        if (allocation.bytes > 0) device.memory().free(allocation);
    }

    Device& device;
    VkMemoryRequirements needs; ///< of the image that it was allocated for
    Allocation allocation{};
    Texture* user = nullptr; ///< the only one with contents; null: it is gone
    /// How all of them have written it: where the last one is smaller, or has fewer samples, the last write is that of
    /// another one.
    VkPipelineStageFlags writingStages = 0;
    VkAccessFlags written = 0;
};

class Texture final : public DeviceObject {
public:
    /// `host`: of DeviceTextureDesc::placedOn.
    static Result<std::unique_ptr<Texture>> create(Device& device, DeviceTextureDesc const& desc,
                                                   Texture const* host = nullptr);
    ~Texture() override;

    VkImage image() const { return mImage; }
    /// What shaders sample; created on first use, except for the view of all. Null without TextureUsage::Sampled, or
    /// if the device refuses.
    VkImageView sampledView(TextureRange const& range);
    /// 2D view of one level and layer, or slice, in its attachmentFormat(), made on first use; null if the device
    /// refuses.
    VkImageView attachmentView(uint32_t level, uint32_t layer);
    /// The subresource of a level and layer; a level of a 3D texture is one, with all of its slices.
    SubresourceRange part(uint32_t level, uint32_t layer) const { return { level, 1, is3D() ? 0 : layer, 1 }; }
    bool owns(VkImageView view) const;

    Format format() const { return mFormat; }
    VkImageAspectFlags aspects() const { return mAspects; }
    bool isSampled() const { return mSampledView != VK_NULL_HANDLE; }
    uint32_t levels() const { return mLevels; }
    uint32_t layers() const { return mLayers; } ///< 1 of a 3D texture: its slices are one subresource
    bool is3D() const { return mType == TextureKind::Texture3D; }
    VkExtent2D extent(uint32_t level) const {
        return { std::max(1u, mExtent.width >> level), std::max(1u, mExtent.height >> level) };
    }
    std::string const& name() const { return mName; }

    /// Whether the memory is this texture's at present.
    bool hasMemory() const { return mMemory->user == this; }
    /// It is from now on. Returns the texture that had it, if there is one.
    Texture* takeMemory() { return std::exchange(mMemory->user, this); }
    ImageMemory& memory() { return *mMemory; }

    // Bookkeeping of Barriers.
    SubresourceUses uses;
    bool isUnsettled = false; ///< listed for a transition to Use::ShaderRead

private:
    struct ViewKind {
        VkImageViewType type;
        VkImageAspectFlags aspects;
        Format format;
    };
    struct PartView {
        SubresourceRange range;
        VkImageView view = VK_NULL_HANDLE;
    };

    Texture(Device& device, DeviceTextureDesc const& desc);
    VkResult createImage(DeviceTextureDesc const& desc, Texture const* host);
    VkResult allocate(VkMemoryRequirements const& needs, bool isTransient);
    VkResult createView(ViewKind const& kind, SubresourceRange const& range, VkImageView& view);
    VkImageView partView(std::vector<PartView>& views, SubresourceRange const& range, ViewKind const& kind);
    ViewKind sampledKind() const;

    Device& mDevice;
    VkImage mImage = VK_NULL_HANDLE;
    VkImageView mSampledView = VK_NULL_HANDLE;
    std::vector<PartView> mSampledParts, mAttachmentViews;
    std::shared_ptr<ImageMemory> mMemory;
    TextureKind mType;
    Format mFormat;
    VkImageAspectFlags mAspects;
    VkExtent2D mExtent;
    uint32_t mLevels, mLayers;
    std::string mName;
};

} // namespace filament_core::backend::vulkan
