// SPDX-License-Identifier: Apache-2.0
/// Memory: the Allocator on a real device; chooses the memory type.
///   Thread  the driver thread.
///   Memory  mappable types are mapped once per block and stay mapped; only host-coherent memory is ever mapped.
///   Fails   allocate() returns nothing if no allowed memory type has room.
#pragma once

#include "backend/vulkan/Allocator.h"
#include "backend/vulkan/Api.h"

namespace filament_core::backend::vulkan {

/// The purpose of the memory; determines the order in which types are tried.
enum class MemoryPurpose : uint8_t {
    Device,    ///< the GPU reads and writes
    Transient, ///< tile memory, where it exists
    Upload,    ///< the host writes, the GPU reads; always mapped
    Readback,  ///< the GPU writes, the host reads; always mapped
};

/// The types of `typeBits` that serve the purpose, best first; their number in `count`.
struct MemoryTypeOrder {
    uint32_t types[VK_MAX_MEMORY_TYPES] = {};
    uint32_t count = 0;
};
MemoryTypeOrder memoryTypeOrder(VkPhysicalDeviceMemoryProperties const& memory, uint32_t typeBits,
                                MemoryPurpose purpose);

class Memory final : private MemorySource {
public:
    Memory(VolkDeviceTable const& fn, VkDevice device, VkPhysicalDeviceMemoryProperties const& properties);

    std::optional<Allocation> allocate(VkMemoryRequirements const& needs, ResourceKind kind, MemoryPurpose purpose);
    void free(Allocation const& allocation) { mAllocator.free(allocation); }
    AllocatorStatistics const& statistics() const { return mAllocator.statistics(); }

    static VkDeviceMemory handleOf(Allocation const& allocation);

private:
    std::optional<MemoryChunk> allocate(uint32_t memoryType, uint64_t bytes) override;
    void release(MemoryChunk chunk) override;

    VolkDeviceTable const& mFn;
    VkDevice mDevice;
    VkPhysicalDeviceMemoryProperties mProperties;
    Allocator mAllocator;
};

} // namespace filament_core::backend::vulkan
