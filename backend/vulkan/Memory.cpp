// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Memory.h"

#include <algorithm>

namespace filament_core::backend::vulkan {
namespace {

constexpr VkMemoryPropertyFlags kMappable = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;

struct PropertyFlags {
    VkMemoryPropertyFlags required, wanted, unwanted;
};

PropertyFlags propertiesFor(MemoryPurpose purpose) {
    switch (purpose) {
    case MemoryPurpose::Device:
        // Lazily allocated memory takes transient attachments only.
        return { 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT };
    case MemoryPurpose::Transient:
        return { 0, VK_MEMORY_PROPERTY_LAZILY_ALLOCATED_BIT, 0 };
    case MemoryPurpose::Upload:
        // Staged bytes are written once, front to back, and never read: write-combined memory is best for that, and
        // leaves the processor's cache to others.
        return { kMappable, 0, VK_MEMORY_PROPERTY_HOST_CACHED_BIT };
    case MemoryPurpose::Readback:
        break;
    }
    // Reading memory that is not cached is slower by far.
    return { kMappable, VK_MEMORY_PROPERTY_HOST_CACHED_BIT, 0 };
}

} // namespace

MemoryTypeOrder memoryTypeOrder(VkPhysicalDeviceMemoryProperties const& memory, uint32_t typeBits,
                                MemoryPurpose purpose) {
    const PropertyFlags properties = propertiesFor(purpose);
    const auto penalty = [&](uint32_t type) {
        const VkMemoryPropertyFlags flags = memory.memoryTypes[type].propertyFlags;
        return 2 * static_cast<int>((flags & properties.wanted) != properties.wanted) +
               static_cast<int>((flags & properties.unwanted) != 0);
    };
    MemoryTypeOrder order;
    for (uint32_t type = 0; type < memory.memoryTypeCount; ++type) {
        const VkMemoryPropertyFlags flags = memory.memoryTypes[type].propertyFlags;
        const bool allowed = (typeBits >> type & 1) != 0 && (flags & properties.required) == properties.required &&
                             (flags & VK_MEMORY_PROPERTY_PROTECTED_BIT) == 0;
        if (allowed) order.types[order.count++] = type;
    }
    // Stable, because the specification orders equal types by speed.
    std::stable_sort(order.types, order.types + order.count,
                     [&](uint32_t a, uint32_t b) { return penalty(a) < penalty(b); });
    return order;
}

Memory::Memory(VolkDeviceTable const& fn, VkDevice device, VkPhysicalDeviceMemoryProperties const& properties)
        : mFn(fn), mDevice(device), mProperties(properties), mAllocator(*this) {}

std::optional<Allocation> Memory::allocate(VkMemoryRequirements const& needs, ResourceKind kind,
                                           MemoryPurpose purpose) {
    const MemoryTypeOrder order = memoryTypeOrder(mProperties, needs.memoryTypeBits, purpose);
    for (uint32_t i = 0; i < order.count; ++i) {
        const MemoryRequest request{ needs.size, needs.alignment, order.types[i], kind };
        if (auto allocation = mAllocator.allocate(request)) return allocation;
    }
    return std::nullopt;
}

VkDeviceMemory Memory::handleOf(Allocation const& allocation) { return (VkDeviceMemory)allocation.memory; }

std::optional<MemoryChunk> Memory::allocate(uint32_t memoryType, uint64_t bytes) {
    VkMemoryType const& type = mProperties.memoryTypes[memoryType];
    if (bytes > mProperties.memoryHeaps[type.heapIndex].size) return std::nullopt; // more would be invalid usage
    auto info = make<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
    info.allocationSize = bytes;
    info.memoryTypeIndex = memoryType;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    if (mFn.vkAllocateMemory(mDevice, &info, nullptr, &memory) != VK_SUCCESS) return std::nullopt;

    void* mapped = nullptr;
    if ((type.propertyFlags & kMappable) == kMappable) {
        if (mFn.vkMapMemory(mDevice, memory, 0, VK_WHOLE_SIZE, 0, &mapped) != VK_SUCCESS) mapped = nullptr;
    }
    return MemoryChunk{ bitsOf(memory), static_cast<std::byte*>(mapped) };
}

void Memory::release(MemoryChunk chunk) { mFn.vkFreeMemory(mDevice, (VkDeviceMemory)chunk.id, nullptr); }

} // namespace filament_core::backend::vulkan
