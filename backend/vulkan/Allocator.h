// SPDX-License-Identifier: Apache-2.0
/// Allocator: device memory for buffers and images, cut out of large blocks.
///   In      a size, an alignment, a memory type, and whether the resource is linear (buffers) or optimal (images).
///   Out     an Allocation: memory object, offset and, if the memory can be mapped, a host pointer that stays valid.
///   Thread  one at a time.
///   Memory  blocks of AllocatorOptions::blockBytes per memory type and kind; requests above half a block get memory of
///           their own. Linear and optimal resources never share a block, which satisfies bufferImageGranularity.
///           One empty block per pool is kept, so that a resource made and destroyed every frame costs no system call.
///   Fails   allocate() answers nothing when the source refuses even the exact size.
///   Cost    a lookup in the blocks of one pool, then RangeAllocator.
/// MemorySource: where blocks come from: vkAllocateMemory, or a test.
#pragma once

#include "backend/vulkan/RangeAllocator.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace filament_core::backend::vulkan {

struct MemoryChunk {
    uint64_t id = 0;             ///< a VkDeviceMemory
    std::byte* mapped = nullptr; ///< null: the host cannot see it
};

class MemorySource {
public:
    virtual ~MemorySource() = default;
    /// Nothing if the device is out of this type of memory.
    virtual std::optional<MemoryChunk> allocate(uint32_t memoryType, uint64_t bytes) = 0;
    virtual void release(MemoryChunk chunk) = 0;
};

enum class ResourceKind : uint8_t { Linear, Optimal };

struct MemoryRequest {
    uint64_t bytes = 0;
    uint64_t alignment = 1;
    uint32_t memoryType = 0;
    ResourceKind kind = ResourceKind::Linear;
};

struct MemoryBlock;

/// A plain value; give it back with Allocator::free().
struct Allocation {
    uint64_t memory = 0; ///< MemoryChunk::id
    uint64_t offset = 0;
    uint64_t bytes = 0;
    std::byte* mapped = nullptr;  ///< at `offset`
    MemoryBlock* block = nullptr; ///< null: memory of its own
    uint32_t node = 0;
};

struct AllocatorOptions {
    uint64_t blockBytes = uint64_t{ 64 } << 20;
};

struct AllocatorStatistics {
    uint64_t usedBytes = 0;     ///< requested
    uint64_t reservedBytes = 0; ///< taken from the source
    uint32_t blocks = 0;
    uint32_t dedicated = 0; ///< allocations with memory of their own
};

class Allocator {
public:
    explicit Allocator(MemorySource& source, AllocatorOptions options = {});
    ~Allocator(); ///< every allocation has been freed
    Allocator(Allocator const&) = delete;
    Allocator& operator=(Allocator const&) = delete;

    std::optional<Allocation> allocate(MemoryRequest const& request);
    void free(Allocation const& allocation);
    AllocatorStatistics const& statistics() const { return mStatistics; }

private:
    using Pool = std::vector<std::unique_ptr<MemoryBlock>>;

    std::optional<Allocation> allocateDedicated(MemoryRequest const& request);
    std::optional<Allocation> allocateIn(MemoryBlock& block, MemoryRequest const& request);
    MemoryBlock* addBlock(uint32_t pool, MemoryRequest const& request);
    void releaseSpareBlocks(uint32_t pool);
    void releaseBlock(MemoryBlock& block);

    MemorySource& mSource;
    AllocatorOptions mOptions;
    AllocatorStatistics mStatistics;
    std::vector<Pool> mPools; // index: memory type * 2 + kind
};

} // namespace filament_core::backend::vulkan
