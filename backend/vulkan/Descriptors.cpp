// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Descriptors.h"

#include "backend/vulkan/Formats.h"
#include "backend/vulkan/Quirks.h"
#include "base/Hash.h"

#include <algorithm>

namespace filament_core::backend::vulkan {
namespace {

/// The number of descriptors per type for `sets` sets of the layout, including those added by spareBindings().
std::vector<VkDescriptorPoolSize> poolSizes(BindGroupLayout const& layout, uint32_t spares, uint32_t sets) {
    std::vector<VkDescriptorPoolSize> sizes;
    if (spares > 0) sizes.push_back({ VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, spares * sets });
    for (uint32_t i = 0; i < layout.count; ++i) {
        const VkDescriptorType type = native(layout.bindings[i].type);
        const auto known = std::ranges::find(sizes, type, &VkDescriptorPoolSize::type);
        if (known != sizes.end()) {
            known->descriptorCount += sets;
        } else {
            sizes.push_back({ type, sets });
        }
    }
    return sizes;
}

BindingDesc const* findBinding(BindGroupLayout const& layout, uint8_t binding) {
    const auto bindings = std::span(layout.bindings).first(layout.count);
    const auto found = std::ranges::find(bindings, binding, &BindingDesc::binding);
    return found != bindings.end() ? &*found : nullptr;
}

VkImageView inputView(ResolvedEntry const& entry) {
    return entry.texture->attachmentView(entry.entry.range.level, entry.entry.range.layer);
}

/// The object that a binding of this type needs but the entry lacks; null if the entry is complete.
const char* missingIn(BindingType type, ResolvedEntry const& entry) {
    switch (type) {
    case BindingType::UniformBuffer:
    case BindingType::DynamicUniformBuffer:
    case BindingType::StorageBuffer:
        return entry.buffer ? nullptr : "buffer";
    case BindingType::SampledTexture:
        if (!entry.texture || !entry.texture->sampledView(entry.entry.range)) return "sampled texture";
        return entry.sampler ? nullptr : "sampler";
    case BindingType::InputAttachment:
        return entry.texture && inputView(entry) ? nullptr : "input attachment";
    }
    return nullptr;
}

struct DescriptorWrites {
    std::array<VkWriteDescriptorSet, kMaxBindings> writes{};
    std::array<VkDescriptorBufferInfo, kMaxBindings> buffers{};
    std::array<VkDescriptorImageInfo, kMaxBindings> images{};
    uint32_t count = 0;

    void add(BindingDesc const& binding, ResolvedEntry const& entry) {
        VkWriteDescriptorSet& write = writes[count];
        write = make<VkWriteDescriptorSet>(VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET);
        write.dstBinding = binding.binding;
        write.descriptorCount = 1;
        write.descriptorType = native(binding.type);
        write.pBufferInfo = &buffers[count];
        write.pImageInfo = &images[count];
        if (binding.type == BindingType::SampledTexture) {
            const VkImageView view = entry.texture->sampledView(entry.entry.range);
            images[count] = { entry.sampler->handle(), view, infoOf(Use::ShaderRead).layout };
        } else if (binding.type == BindingType::InputAttachment) {
            images[count] = { VK_NULL_HANDLE, inputView(entry), infoOf(Use::InputRead).layout };
        } else {
            buffers[count] = { entry.buffer->handle(), entry.entry.offset, entry.entry.size };
            entry.buffer->isUsed = true; // from now on a draw or dispatch may read it at any time
        }
        ++count;
    }

    void apply(Device& device, VkDescriptorSet set) {
        for (uint32_t i = 0; i < count; ++i) writes[i].dstSet = set;
        device.fn().vkUpdateDescriptorSets(device.handle(), count, writes.data(), 0, nullptr);
    }
};

} // namespace

// ---------------------------------------------------------------------------------------------- set layouts

std::unique_ptr<SetLayout> SetLayout::create(Device& device, BindGroupLayout const& layout) {
    std::array<VkDescriptorSetLayoutBinding, kMaxBindings + kMaxSpareBindings> bindings{};
    for (uint32_t i = 0; i < layout.count; ++i) {
        BindingDesc const& binding = layout.bindings[i];
        const ShaderStage stages =
                binding.type == BindingType::InputAttachment ? ShaderStage::Fragment : binding.stages;
        bindings[i].binding = binding.binding;
        bindings[i].descriptorType = native(binding.type);
        bindings[i].descriptorCount = 1;
        bindings[i].stageFlags = native(stages);
    }
    auto info = make<VkDescriptorSetLayoutCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO);
    info.bindingCount = layout.count;
    info.pBindings = bindings.data();
    std::unique_ptr<SetLayout> made(new SetLayout(device, layout));
    if (device.physical().quirks.spoilsFourthUniforms) {
        const auto spares = std::span(bindings).subspan(layout.count).first<kMaxSpareBindings>();
        info.bindingCount += spareBindings(layout, spares);
        made->mSpares = spares[0].descriptorCount + spares[1].descriptorCount;
    }
    if (device.fn().vkCreateDescriptorSetLayout(device.handle(), &info, nullptr, &made->mHandle) != VK_SUCCESS) {
        made->mHandle = VK_NULL_HANDLE;
        return nullptr;
    }
    return made;
}

SetLayout::~SetLayout() {
    for (VkDescriptorPool pool : mPools) mDevice.fn().vkDestroyDescriptorPool(mDevice.handle(), pool, nullptr);
    mDevice.fn().vkDestroyDescriptorSetLayout(mDevice.handle(), mHandle, nullptr);
}

VkDescriptorSet SetLayout::takeSet() {
    if (mFree.empty()) addPool();
    if (mFree.empty()) return VK_NULL_HANDLE;
    const VkDescriptorSet set = mFree.back();
    mFree.pop_back();
    return set;
}

void SetLayout::addPool() {
    const std::vector<VkDescriptorPoolSize> sizes = poolSizes(mLayout, mSpares, mNextPoolSize);
    auto info = make<VkDescriptorPoolCreateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO);
    info.maxSets = mNextPoolSize;
    info.poolSizeCount = static_cast<uint32_t>(sizes.size());
    info.pPoolSizes = sizes.data();
    VkDescriptorPool pool = VK_NULL_HANDLE;
    if (mDevice.fn().vkCreateDescriptorPool(mDevice.handle(), &info, nullptr, &pool) != VK_SUCCESS) return;
    mPools.push_back(pool);

    const std::vector<VkDescriptorSetLayout> layouts(mNextPoolSize, mHandle);
    std::vector<VkDescriptorSet> sets(mNextPoolSize);
    auto allocate = make<VkDescriptorSetAllocateInfo>(VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO);
    allocate.descriptorPool = pool;
    allocate.descriptorSetCount = mNextPoolSize;
    allocate.pSetLayouts = layouts.data();
    if (mDevice.fn().vkAllocateDescriptorSets(mDevice.handle(), &allocate, sets.data()) != VK_SUCCESS) return;
    mFree.insert(mFree.end(), sets.rbegin(), sets.rend());
    mNextPoolSize = std::min(mNextPoolSize * 2, 1024u);
}

// ---------------------------------------------------------------------------------------------- caches

size_t Layouts::Hash::operator()(BindGroupLayout const& layout) const {
    return hashBytes(std::as_bytes(std::span(layout.bindings).first(layout.count)), layout.count);
}

size_t Layouts::Hash::operator()(ProgramLayout const& layout) const {
    uint64_t hash = 0;
    for (BindGroupLayout const& group : layout) hash = hashCombine(hash, (*this)(group));
    return hash;
}

Layouts::~Layouts() {
    for (auto const& [key, layout] : mPipelines) {
        mDevice.fn().vkDestroyPipelineLayout(mDevice.handle(), layout.handle, nullptr);
    }
}

SetLayout* Layouts::get(BindGroupLayout const& layout) {
    if (const auto known = mSets.find(layout); known != mSets.end()) return known->second.get();
    std::unique_ptr<SetLayout> made = SetLayout::create(mDevice, layout);
    if (!made) return nullptr;
    return mSets.emplace(layout, std::move(made)).first->second.get();
}

PipelineLayout const* Layouts::get(ProgramLayout const& layout) {
    if (const auto known = mPipelines.find(layout); known != mPipelines.end()) return &known->second;
    PipelineLayout made;
    std::array<VkDescriptorSetLayout, kMaxBindGroups> handles{};
    for (uint32_t i = 0; i < kMaxBindGroups; ++i) {
        made.sets[i] = get(layout[i]); // including empty groups: keeps the layouts of different programs compatible
        if (!made.sets[i]) return nullptr;
        handles[i] = made.sets[i]->handle();
    }
    auto info = make<VkPipelineLayoutCreateInfo>(VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO);
    info.setLayoutCount = kMaxBindGroups;
    info.pSetLayouts = handles.data();
    if (mDevice.fn().vkCreatePipelineLayout(mDevice.handle(), &info, nullptr, &made.handle) != VK_SUCCESS)
        return nullptr;
    return &mPipelines.emplace(layout, made).first->second;
}

// ---------------------------------------------------------------------------------------------- bind groups

Result<std::unique_ptr<BindGroup>> BindGroup::create(Device& device, SetLayout& layout,
                                                     std::span<const ResolvedEntry> entries,
                                                     std::string_view debugName) {
    DescriptorWrites writes;
    for (ResolvedEntry const& entry : entries) {
        BindingDesc const* const binding = findBinding(layout.layout(), entry.entry.binding);
        if (!binding || writes.count == kMaxBindings) continue;
        if (const char* missing = missingIn(binding->type, entry)) {
            return fail(ErrorCode::NotFound, "bind group '{}': binding {} has no {}, draws with it are skipped",
                        debugName, binding->binding, missing);
        }
        writes.add(*binding, entry);
    }
    if (writes.count != layout.layout().count) {
        return fail(ErrorCode::InvalidArgument,
                    "bind group '{}': {} entries for {} bindings, draws with it are skipped", debugName, writes.count,
                    layout.layout().count);
    }

    // Only now that the entries are known to be complete: a group that is refused takes no set.
    const VkDescriptorSet set = layout.takeSet();
    if (set == VK_NULL_HANDLE)
        return fail(ErrorCode::OutOfMemory, "bind group '{}': no descriptor set left", debugName);
    writes.apply(device, set);
    device.setName(VK_OBJECT_TYPE_DESCRIPTOR_SET, set, debugName);
    return std::unique_ptr<BindGroup>(new BindGroup(layout, set));
}

} // namespace filament_core::backend::vulkan
