// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/RenderPasses.h"

#include "backend/vulkan/Formats.h"
#include "base/Hash.h"

#include <vector>

namespace filament_core::backend::vulkan {
namespace {

constexpr VkPipelineStageFlags kAttachmentStages = VK_PIPELINE_STAGE_COLOR_ATTACHMENT_OUTPUT_BIT |
                                                   VK_PIPELINE_STAGE_EARLY_FRAGMENT_TESTS_BIT |
                                                   VK_PIPELINE_STAGE_LATE_FRAGMENT_TESTS_BIT;
constexpr VkAccessFlags kAttachmentWrites =
        VK_ACCESS_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT;
constexpr VkAccessFlags kAttachmentReads =
        VK_ACCESS_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_DEPTH_STENCIL_ATTACHMENT_READ_BIT;
constexpr VkAttachmentReference kUnused{ VK_ATTACHMENT_UNUSED, VK_IMAGE_LAYOUT_UNDEFINED };

bool isIn(uint8_t mask, uint32_t bit) { return (mask >> bit & 1) != 0; }

/// The use of a colour attachment in one subpass; Undefined if the subpass does not use it.
Use colorUseIn(PassLayout const& layout, uint32_t subpass, uint32_t index) {
    if (isIn(readColors(layout, subpass), index)) return Use::InputRead;
    return isIn(writtenColors(layout, subpass), index) ? Use::ColorAttachment : Use::Undefined;
}

/// Everything that VkRenderPassCreateInfo points to.
struct RenderPassParts {
    struct Subpass {
        std::array<VkAttachmentReference, kMaxColorAttachments> colors, inputs, resolves;
        VkAttachmentReference depth = kUnused, depthResolve = kUnused;
        std::array<uint32_t, kMaxAttachments> preserved{};
        uint32_t preservedCount = 0;
    };
    std::array<VkAttachmentDescription, kMaxAttachments> attachments{};
    uint32_t attachmentCount = 0;
    std::array<Subpass, kMaxSubpasses> subpasses;
    std::vector<VkSubpassDependency> dependencies;
};

void describeAttachments(RenderPassKey const& key, RenderPassParts& parts) {
    PassLayout const& layout = key.layout;
    const auto add = [&](Format format, uint32_t samples, LoadOp load, StoreOp store, Use first, Use last) {
        VkAttachmentDescription& at = parts.attachments[parts.attachmentCount++];
        at.format = native(format);
        at.samples = sampleBits(samples);
        at.loadOp = native(load);
        at.storeOp = native(store);
        at.stencilLoadOp = hasStencil(format) ? at.loadOp : VK_ATTACHMENT_LOAD_OP_DONT_CARE;
        at.stencilStoreOp = hasStencil(format) ? at.storeOp : VK_ATTACHMENT_STORE_OP_DONT_CARE;
        at.initialLayout = infoOf(first).layout;
        at.finalLayout = infoOf(last).layout;
    };
    for (uint32_t i = 0; i < layout.colorCount; ++i) {
        add(layout.colorFormats[i], layout.samples, key.loads[i], key.stores[i], firstColorUse(layout, i),
            lastColorUse(layout, i));
    }
    if (layout.depthFormat != Format::None) {
        add(layout.depthFormat, layout.samples, key.depthLoad, key.depthStore, Use::DepthAttachment,
            Use::DepthAttachment);
    }
    for (uint32_t i = 0; i < layout.colorCount; ++i) {
        if (!isIn(layout.resolveMask, i)) continue;
        add(layout.colorFormats[i], 1, LoadOp::Discard, StoreOp::Store, Use::ColorAttachment, Use::ColorAttachment);
    }
    if (layout.resolvesDepth)
        add(layout.depthFormat, 1, LoadOp::Discard, StoreOp::Store, Use::DepthResolve, Use::DepthResolve);
}

void describeSubpass(PassLayout const& layout, uint32_t index, RenderPassParts::Subpass& subpass) {
    subpass.colors.fill(kUnused);
    subpass.inputs.fill(kUnused);
    subpass.resolves.fill(kUnused);
    const bool hasDepthAttachment = layout.depthFormat != Format::None;
    uint32_t resolve = layout.colorCount + (hasDepthAttachment ? 1u : 0u);
    for (uint32_t i = 0; i < layout.colorCount; ++i) {
        const Use use = colorUseIn(layout, index, i);
        if (use == Use::ColorAttachment) subpass.colors[i] = { i, infoOf(use).layout };
        if (use == Use::InputRead) subpass.inputs[i] = { i, infoOf(use).layout };
        if (use == Use::Undefined) subpass.preserved[subpass.preservedCount++] = i;
        if (isIn(layout.resolveMask, i)) {
            if (use == Use::ColorAttachment) subpass.resolves[i] = { resolve, infoOf(use).layout };
            ++resolve;
        }
    }
    if (!hasDepthAttachment) return;
    if (layout.resolvesDepth) subpass.depthResolve = { resolve, infoOf(Use::DepthResolve).layout };
    if (layout.subpasses[index].usesDepth) {
        subpass.depth = { layout.colorCount, infoOf(Use::DepthAttachment).layout };
    } else {
        subpass.preserved[subpass.preservedCount++] = layout.colorCount;
    }
}

void describeDependencies(PassLayout const& layout, RenderPassParts& parts) {
    for (uint32_t from = 0; from < layout.subpassCount; ++from) {
        for (uint32_t to = from + 1; to < layout.subpassCount; ++to) {
            VkSubpassDependency dependency{};
            dependency.srcSubpass = from;
            dependency.dstSubpass = to;
            // Includes reads in the fragment shader: a later subpass may write what an earlier one has read.
            dependency.srcStageMask = kAttachmentStages | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
            dependency.dstStageMask = kAttachmentStages | VK_PIPELINE_STAGE_FRAGMENT_SHADER_BIT;
            dependency.srcAccessMask = kAttachmentWrites;
            dependency.dstAccessMask = kAttachmentWrites | kAttachmentReads | VK_ACCESS_INPUT_ATTACHMENT_READ_BIT;
            dependency.dependencyFlags = VK_DEPENDENCY_BY_REGION_BIT;
            parts.dependencies.push_back(dependency);
        }
    }
}

/// The same structures for vkCreateRenderPass2, the only version that can resolve depth.
class RenderPassParts2 {
public:
    RenderPassParts2(PassLayout const& layout, RenderPassParts const& parts, uint32_t colorCount)
            : mAspects(aspectsOf(layout.depthFormat)), mColorCount(colorCount) {
        for (uint32_t i = 0; i < parts.attachmentCount; ++i) addAttachment(parts.attachments[i]);
        for (VkSubpassDependency const& each : parts.dependencies) addDependency(each);
        for (uint32_t i = 0; i < layout.subpassCount; ++i) addSubpass(layout, i, parts.subpasses[i]);
    }
    RenderPassParts2(RenderPassParts2 const&) = delete;
    RenderPassParts2& operator=(RenderPassParts2 const&) = delete;

    VkRenderPass create(Device& device) const {
        auto info = make<VkRenderPassCreateInfo2>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO_2);
        info.attachmentCount = static_cast<uint32_t>(mAttachments.size());
        info.pAttachments = mAttachments.data();
        info.subpassCount = mSubpassCount;
        info.pSubpasses = mSubpasses.data();
        info.dependencyCount = static_cast<uint32_t>(mDependencies.size());
        info.pDependencies = mDependencies.data();
        VkRenderPass pass = VK_NULL_HANDLE;
        const VkResult result = device.fn().vkCreateRenderPass2KHR(device.handle(), &info, nullptr, &pass);
        return result == VK_SUCCESS ? pass : VK_NULL_HANDLE;
    }

private:
    struct Subpass {
        std::array<VkAttachmentReference2, kMaxColorAttachments> colors, inputs, resolves;
        VkAttachmentReference2 depth, depthResolve;
        VkSubpassDescriptionDepthStencilResolve resolve;
    };

    static VkAttachmentReference2 reference(VkAttachmentReference const& of, VkImageAspectFlags aspects) {
        auto to = make<VkAttachmentReference2>(VK_STRUCTURE_TYPE_ATTACHMENT_REFERENCE_2);
        to.attachment = of.attachment;
        to.layout = of.layout;
        to.aspectMask = aspects;
        return to;
    }

    void addAttachment(VkAttachmentDescription const& of) {
        auto& to =
                mAttachments.emplace_back(make<VkAttachmentDescription2>(VK_STRUCTURE_TYPE_ATTACHMENT_DESCRIPTION_2));
        to.format = of.format;
        to.samples = of.samples;
        to.loadOp = of.loadOp;
        to.storeOp = of.storeOp;
        to.stencilLoadOp = of.stencilLoadOp;
        to.stencilStoreOp = of.stencilStoreOp;
        to.initialLayout = of.initialLayout;
        to.finalLayout = of.finalLayout;
    }

    void addDependency(VkSubpassDependency const& of) {
        auto& to = mDependencies.emplace_back(make<VkSubpassDependency2>(VK_STRUCTURE_TYPE_SUBPASS_DEPENDENCY_2));
        to.srcSubpass = of.srcSubpass;
        to.dstSubpass = of.dstSubpass;
        to.srcStageMask = of.srcStageMask;
        to.dstStageMask = of.dstStageMask;
        to.srcAccessMask = of.srcAccessMask;
        to.dstAccessMask = of.dstAccessMask;
        to.dependencyFlags = of.dependencyFlags;
    }

    void addSubpass(PassLayout const& layout, uint32_t index, RenderPassParts::Subpass const& of) {
        Subpass& part = mParts[index];
        for (uint32_t i = 0; i < mColorCount; ++i) {
            part.colors[i] = reference(of.colors[i], VK_IMAGE_ASPECT_COLOR_BIT);
            part.inputs[i] = reference(of.inputs[i], VK_IMAGE_ASPECT_COLOR_BIT);
            part.resolves[i] = reference(of.resolves[i], VK_IMAGE_ASPECT_COLOR_BIT);
        }
        part.depth = reference(of.depth, mAspects);
        part.depthResolve = reference(of.depthResolve, mAspects);
        part.resolve = make<VkSubpassDescriptionDepthStencilResolve>(
                VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_DEPTH_STENCIL_RESOLVE);
        constexpr VkResolveModeFlagBits kFirstSample = VK_RESOLVE_MODE_SAMPLE_ZERO_BIT; // by every device
        part.resolve.depthResolveMode = kFirstSample;
        // unused, but not every device can resolve only depth
        part.resolve.stencilResolveMode = hasStencil(layout.depthFormat) ? kFirstSample : VK_RESOLVE_MODE_NONE;
        part.resolve.pDepthStencilResolveAttachment = &part.depthResolve;
        auto& to = mSubpasses[mSubpassCount++];
        to = make<VkSubpassDescription2>(VK_STRUCTURE_TYPE_SUBPASS_DESCRIPTION_2);
        to.pNext = &part.resolve;
        to.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
        to.colorAttachmentCount = mColorCount;
        to.pColorAttachments = part.colors.data();
        to.pResolveAttachments = layout.resolveMask != 0 ? part.resolves.data() : nullptr;
        to.inputAttachmentCount = readColors(layout, index) != 0 ? layout.colorCount : 0;
        to.pInputAttachments = part.inputs.data();
        to.pDepthStencilAttachment = &part.depth;
        to.preserveAttachmentCount = of.preservedCount;
        to.pPreserveAttachments = of.preserved.data();
    }

    VkImageAspectFlags mAspects;
    uint32_t mColorCount; ///< references of each subpass
    std::vector<VkAttachmentDescription2> mAttachments;
    std::vector<VkSubpassDependency2> mDependencies;
    std::array<Subpass, kMaxSubpasses> mParts;
    std::array<VkSubpassDescription2, kMaxSubpasses> mSubpasses{};
    uint32_t mSubpassCount = 0;
};

VkRenderPass createRenderPass(Device& device, RenderPassKey const& key) {
    PassLayout const& layout = key.layout;
    RenderPassParts parts;
    describeAttachments(key, parts);
    describeDependencies(layout, parts);
    const uint32_t colorCount = colorReferences(device.physical().quirks, layout);
    std::array<VkSubpassDescription, kMaxSubpasses> subpasses{};
    for (uint32_t i = 0; i < layout.subpassCount; ++i) {
        RenderPassParts::Subpass& part = parts.subpasses[i];
        describeSubpass(layout, i, part);
        subpasses[i].pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
        subpasses[i].colorAttachmentCount = colorCount;
        subpasses[i].pColorAttachments = part.colors.data();
        subpasses[i].pResolveAttachments = layout.resolveMask != 0 ? part.resolves.data() : nullptr;
        subpasses[i].inputAttachmentCount = readColors(layout, i) != 0 ? layout.colorCount : 0;
        subpasses[i].pInputAttachments = part.inputs.data();
        subpasses[i].pDepthStencilAttachment = &part.depth;
        subpasses[i].preserveAttachmentCount = part.preservedCount;
        subpasses[i].pPreserveAttachments = part.preserved.data();
    }
    if (layout.resolvesDepth) return RenderPassParts2(layout, parts, colorCount).create(device);
    auto info = make<VkRenderPassCreateInfo>(VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO);
    info.attachmentCount = parts.attachmentCount;
    info.pAttachments = parts.attachments.data();
    info.subpassCount = layout.subpassCount;
    info.pSubpasses = subpasses.data();
    info.dependencyCount = static_cast<uint32_t>(parts.dependencies.size());
    info.pDependencies = parts.dependencies.data();
    VkRenderPass pass = VK_NULL_HANDLE;
    const VkResult result = device.fn().vkCreateRenderPass(device.handle(), &info, nullptr, &pass);
    return result == VK_SUCCESS ? pass : VK_NULL_HANDLE;
}

/// Clears unused entries, so that they do not make equal passes differ.
PassLayout normalized(PassLayout layout) {
    const auto used = static_cast<uint8_t>((1u << layout.colorCount) - 1);
    for (uint32_t i = layout.colorCount; i < kMaxColorAttachments; ++i) layout.colorFormats[i] = Format::None;
    for (uint32_t i = 0; i < kMaxSubpasses; ++i) {
        SubpassDesc& subpass = layout.subpasses[i];
        if (i >= layout.subpassCount) subpass = {};
        if (layout.depthFormat == Format::None) subpass.usesDepth = true;
        subpass.colorMask = static_cast<uint8_t>(subpass.colorMask & used);
        subpass.inputMask = static_cast<uint8_t>(subpass.inputMask & used);
    }
    layout.resolveMask = static_cast<uint8_t>(layout.resolveMask & used);
    return layout;
}

} // namespace

RenderPassKey keyOf(PassDesc const& desc) {
    RenderPassKey key = keyOf(desc.layout);
    for (uint32_t i = 0; i < desc.layout.colorCount; ++i) {
        key.loads[i] = desc.colors[i].load;
        key.stores[i] = desc.colors[i].store;
    }
    if (desc.layout.depthFormat != Format::None) {
        key.depthLoad = desc.depth.load;
        key.depthStore = desc.depth.store;
    }
    return key;
}

RenderPassKey keyOf(PassLayout const& layout) { return { .layout = normalized(layout) }; }

uint8_t readColors(PassLayout const& layout, uint32_t subpass) {
    return static_cast<uint8_t>(layout.subpasses[subpass].inputMask & ((1u << layout.colorCount) - 1));
}

uint8_t writtenColors(PassLayout const& layout, uint32_t subpass) {
    const uint32_t written = layout.subpasses[subpass].colorMask & ~layout.subpasses[subpass].inputMask;
    return static_cast<uint8_t>(written & ((1u << layout.colorCount) - 1));
}

Use firstColorUse(PassLayout const& layout, uint32_t index) {
    for (uint32_t subpass = 0; subpass < layout.subpassCount; ++subpass) {
        if (const Use use = colorUseIn(layout, subpass, index); use != Use::Undefined) return use;
    }
    return Use::ColorAttachment; // only loaded, cleared or stored
}

Use lastColorUse(PassLayout const& layout, uint32_t index) {
    for (uint32_t subpass = layout.subpassCount; subpass-- > 0;) {
        if (const Use use = colorUseIn(layout, subpass, index); use != Use::Undefined) return use;
    }
    return Use::ColorAttachment;
}

// ---------------------------------------------------------------------------------------------- render passes

size_t RenderPasses::Hash::operator()(RenderPassKey const& key) const { return hashValue(key); }

RenderPasses::~RenderPasses() {
    for (auto const& [key, pass] : mPasses) mDevice.fn().vkDestroyRenderPass(mDevice.handle(), pass, nullptr);
}

VkRenderPass RenderPasses::get(RenderPassKey const& key) {
    if (const auto known = mPasses.find(key); known != mPasses.end()) return known->second;
    const VkRenderPass pass = createRenderPass(mDevice, key);
    if (pass != VK_NULL_HANDLE) mPasses.emplace(key, pass);
    return pass;
}

} // namespace filament_core::backend::vulkan
