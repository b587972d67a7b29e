// SPDX-License-Identifier: Apache-2.0
#include "backend/gles/Descriptors.h"

#include <algorithm>

namespace filament_core::backend::gles {
namespace {

constexpr uint32_t kAllGroups = (1u << kMaxBindGroups) - 1;
constexpr uint8_t kNoSlot = 0xFF;

BindGroup::Slot resolve(BindGroupEntry const& entry, BindingType type, Buffers const& buffers, Textures& textures,
                        Samplers const& samplers, std::string_view group) {
    BindGroup::Slot slot{ .type = type };
    if (type != BindingType::SampledTexture && type != BindingType::InputAttachment) {
        Buffer const* buffer = buffers.find(entry.buffer);
        slot.object = buffer ? buffer->name : 0;
        slot.offset = static_cast<GLintptr>(entry.offset);
        slot.size = static_cast<GLsizeiptr>(entry.size);
        return slot;
    }
    Texture const* texture = textures.find(entry.texture);
    if (!texture) return slot;
    const bool isSampled = type == BindingType::SampledTexture;
    slot.object = isSampled ? textures.sampledName(entry.texture, entry.range, group) : texture->name;
    slot.target = texture->target;
    slot.sampler = samplers.find(entry.sampler);
    return slot;
}

} // namespace

BindGroup makeBindGroup(BindGroupDesc const& desc, Buffers const& buffers, Textures& textures,
                        Samplers const& samplers) {
    BindGroup group;
    group.slots.reserve(desc.layout.count);
    for (uint32_t i = 0; i < desc.layout.count; ++i) {
        BindingDesc const& binding = desc.layout.bindings[i];
        const auto entry = std::find_if(desc.entries.begin(), desc.entries.end(),
                                        [&](BindGroupEntry const& at) { return at.binding == binding.binding; });
        FILAMENT_ASSERT(entry != desc.entries.end(), "every binding of a bind group layout has an entry");
        group.slots.push_back(resolve(*entry, binding.type, buffers, textures, samplers, desc.debugName));
        group.isUsable = group.isUsable && group.slots.back().object != 0;
    }
    return group;
}

void Descriptors::reset() {
    mBound = {};
    mPending = kAllGroups;
}

void Descriptors::bind(uint32_t index, BindGroup const* group,
                       std::array<uint32_t, kMaxDynamicOffsets> const& dynamicOffsets) {
    mBound[index] = { group, dynamicOffsets };
    mPending |= 1u << index;
}

void Descriptors::setProgram(Program const& program) {
    FlatBindings const& wanted = program.bindings();
    for (uint32_t i = 0; i < kMaxBindGroups; ++i) {
        // Programs that number the bindings of a group alike, as those of one material do, keep it bound.
        if (mBindings[i] == wanted[i]) continue;
        mBindings[i] = wanted[i];
        mPending |= 1u << i;
    }
}

bool Descriptors::isNeeded(uint32_t index) const {
    return std::any_of(mBindings[index].begin(), mBindings[index].end(), [](uint8_t slot) { return slot != kNoSlot; });
}

bool Descriptors::apply() {
    for (uint32_t i = 0; mPending >> i; ++i) {
        if (!((mPending >> i) & 1)) continue;
        BindGroup const* group = mBound[i].group;
        if (group && group->isUsable) {
            applyGroup(i);
        } else if (isNeeded(i)) {
            return false;
        }
        // Only then: a group that could not be applied is tried again at the next draw.
        mPending &= ~(1u << i);
    }
    return true;
}

void Descriptors::applyGroup(uint32_t index) {
    Bound const& bound = mBound[index];
    uint32_t dynamic = 0;
    for (size_t i = 0; i < bound.group->slots.size(); ++i) {
        BindGroup::Slot const& slot = bound.group->slots[i];
        const uint32_t offset = slot.type == BindingType::DynamicUniformBuffer ? bound.dynamicOffsets[dynamic++] : 0;
        const uint8_t at = mBindings[index][i];
        if (at == kNoSlot) continue;
        if (slot.type == BindingType::SampledTexture) {
            mState.bindTexture(at, slot.target, slot.object);
            mState.bindSampler(at, slot.sampler);
        } else if (slot.type == BindingType::StorageBuffer) {
            mState.bindStorage(at, slot.object, slot.offset, slot.size);
        } else {
            mState.bindUniforms(at, slot.object, slot.offset + static_cast<GLintptr>(offset), slot.size);
        }
    }
}

} // namespace filament_core::backend::gles
