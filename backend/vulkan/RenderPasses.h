// SPDX-License-Identifier: Apache-2.0
/// RenderPasses: VkRenderPass objects by what they do with their attachments.
///   Attachments  in the order of VkFramebuffer: colours, depth, resolve targets (ascending by colour), that of depth.
///   Locations    shader output i writes colour attachment i of the pass in every subpass; input attachment index i
///                reads colour attachment i. A subpass does not write what it reads: colorMask without inputMask
///                counts.
///   Layouts      every attachment enters in the layout of its first use and leaves in the layout of its last use;
///                Barriers moves it there before and tracks it afterwards. Inside, by-region dependencies from every
///                subpass to every later one order writes before reads.
///   Thread       the driver thread.
///   Memory       they live as long as the driver (dozens).
///   Fails        with a null handle if the device is out of memory.
#pragma once

#include "backend/api/Descriptions.h"
#include "backend/vulkan/Barriers.h"
#include "backend/vulkan/Device.h"

#include <array>
#include <unordered_map>

namespace filament_core::backend::vulkan {

inline constexpr uint32_t kMaxAttachments = 2 * kMaxColorAttachments + 2;

/// What determines a VkRenderPass. Everything beyond colorCount and subpassCount has its default value.
struct RenderPassKey {
    PassLayout layout{};
    std::array<LoadOp, kMaxColorAttachments> loads{};
    std::array<StoreOp, kMaxColorAttachments> stores{};
    LoadOp depthLoad{};
    StoreOp depthStore{};
    friend bool operator==(RenderPassKey const&, RenderPassKey const&) = default;
};

RenderPassKey keyOf(PassDesc const& desc);
/// A render pass for creating pipelines with this layout; load and store operations do not matter for them.
RenderPassKey keyOf(PassLayout const& layout);

/// Colour attachments that a subpass writes, and that it reads.
uint8_t writtenColors(PassLayout const& layout, uint32_t subpass);
uint8_t readColors(PassLayout const& layout, uint32_t subpass);

/// How colour attachment `index` is used by the first and by the last subpass that uses it at all.
Use firstColorUse(PassLayout const& layout, uint32_t index);
Use lastColorUse(PassLayout const& layout, uint32_t index);

class RenderPasses {
public:
    explicit RenderPasses(Device& device) : mDevice(device) {}
    ~RenderPasses();
    RenderPasses(RenderPasses const&) = delete;
    RenderPasses& operator=(RenderPasses const&) = delete;

    VkRenderPass get(RenderPassKey const& key);

private:
    struct Hash {
        size_t operator()(RenderPassKey const& key) const;
    };

    Device& mDevice;
    std::unordered_map<RenderPassKey, VkRenderPass, Hash> mPasses;
};

} // namespace filament_core::backend::vulkan
