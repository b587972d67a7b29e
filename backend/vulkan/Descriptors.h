// SPDX-License-Identifier: Apache-2.0
/// Descriptors: set layouts and pipeline layouts by description, and bind groups as immutable descriptor sets.
///   Thread  the driver thread.
///   Memory  layouts live as long as the driver. Sets come from pools of one layout each, 32 sets, then twice as many
///           as before; a set returns to its layout when its bind group goes, so pools never fragment.
///   Fails   with null handles or OutOfMemory; BindGroup::create also names the first entry whose object is missing.
#pragma once

#include "backend/api/Descriptions.h"
#include "backend/vulkan/Buffer.h"
#include "backend/vulkan/Sampler.h"
#include "backend/vulkan/Texture.h"

#include <algorithm>
#include <array>
#include <memory>
#include <unordered_map>
#include <vector>

namespace filament_core::backend::vulkan {

/// One VkDescriptorSetLayout and the sets made for it.
class SetLayout {
public:
    static std::unique_ptr<SetLayout> create(Device& device, BindGroupLayout const& layout);
    ~SetLayout();
    SetLayout(SetLayout const&) = delete;
    SetLayout& operator=(SetLayout const&) = delete;

    VkDescriptorSetLayout handle() const { return mHandle; }
    bool isEmpty() const { return mLayout.count == 0; }
    BindGroupLayout const& layout() const { return mLayout; }
    uint8_t dynamicCount() const { return mDynamicCount; }

    VkDescriptorSet takeSet(); ///< null when out of memory
    void giveBack(VkDescriptorSet set) { mFree.push_back(set); }

private:
    SetLayout(Device& device, BindGroupLayout const& layout)
            : mDevice(device), mLayout(layout),
              mDynamicCount(static_cast<uint8_t>(std::min(layout.dynamicCount(), kMaxDynamicOffsets))) {}
    void addPool();

    Device& mDevice;
    BindGroupLayout mLayout;
    uint8_t mDynamicCount;
    uint32_t mSpares = 0; // descriptors of a set that nothing is bound to
    VkDescriptorSetLayout mHandle = VK_NULL_HANDLE;
    std::vector<VkDescriptorPool> mPools;
    std::vector<VkDescriptorSet> mFree;
    uint32_t mNextPoolSize = 32;
};

/// What a pipeline binds; two groups are interchangeable if their SetLayout is the same object.
struct PipelineLayout {
    VkPipelineLayout handle = VK_NULL_HANDLE;
    std::array<SetLayout*, kMaxBindGroups> sets{};
};

class Layouts {
public:
    explicit Layouts(Device& device) : mDevice(device) {}
    ~Layouts();
    Layouts(Layouts const&) = delete;
    Layouts& operator=(Layouts const&) = delete;

    SetLayout* get(BindGroupLayout const& layout);          ///< null when out of memory
    PipelineLayout const* get(ProgramLayout const& layout); ///< null when out of memory

private:
    struct Hash {
        size_t operator()(BindGroupLayout const& layout) const;
        size_t operator()(ProgramLayout const& layout) const;
    };

    Device& mDevice;
    std::unordered_map<BindGroupLayout, std::unique_ptr<SetLayout>, Hash> mSets;
    std::unordered_map<ProgramLayout, PipelineLayout, Hash> mPipelines;
};

/// A bind group entry with the objects behind its handles.
struct ResolvedEntry {
    BindGroupEntry entry;
    Buffer* buffer = nullptr;
    Texture* texture = nullptr;
    Sampler const* sampler = nullptr;
};

class BindGroup final : public DeviceObject {
public:
    static Result<std::unique_ptr<BindGroup>>
    create(Device& device, SetLayout& layout, std::span<const ResolvedEntry> entries, std::string_view debugName);
    ~BindGroup() override { mLayout.giveBack(mSet); }

    VkDescriptorSet set() const { return mSet; }
    SetLayout const* layout() const { return &mLayout; }

private:
    BindGroup(SetLayout& layout, VkDescriptorSet set) : mLayout(layout), mSet(set) {}

    SetLayout& mLayout;
    VkDescriptorSet mSet;
};

} // namespace filament_core::backend::vulkan
