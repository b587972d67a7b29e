// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Allocator.h"

#include "base/Assert.h"

#include <algorithm>

namespace filament_core::backend::vulkan {

struct MemoryBlock {
    MemoryChunk chunk;
    uint32_t pool;
    RangeAllocator ranges;
};

Allocator::Allocator(MemorySource& source, AllocatorOptions options) : mSource(source), mOptions(options) {}

Allocator::~Allocator() {
    FILAMENT_ASSERT(mStatistics.usedBytes == 0, "memory is given back before its allocator goes");
    for (Pool& pool : mPools) {
        for (auto& block : pool) releaseBlock(*block);
    }
}

std::optional<Allocation> Allocator::allocate(MemoryRequest const& request) {
    // A block never holds two of them, and nearly half of it could stay unused.
    if (request.bytes > mOptions.blockBytes / 2) return allocateDedicated(request);

    const uint32_t pool = request.memoryType * 2 + static_cast<uint32_t>(request.kind);
    if (mPools.size() <= pool) mPools.resize(pool + 1);
    for (auto& block : mPools[pool]) {
        if (auto allocation = allocateIn(*block, request)) return allocation;
    }
    if (MemoryBlock* block = addBlock(pool, request)) return allocateIn(*block, request);
    return allocateDedicated(request); // the last resort: exactly the required size
}

std::optional<Allocation> Allocator::allocateDedicated(MemoryRequest const& request) {
    const std::optional<MemoryChunk> chunk = mSource.allocate(request.memoryType, request.bytes);
    if (!chunk) return std::nullopt;
    mStatistics.usedBytes += request.bytes;
    mStatistics.reservedBytes += request.bytes;
    ++mStatistics.dedicated;
    return Allocation{ .memory = chunk->id, .bytes = request.bytes, .mapped = chunk->mapped };
}

std::optional<Allocation> Allocator::allocateIn(MemoryBlock& block, MemoryRequest const& request) {
    const auto range = block.ranges.allocate(request.bytes, request.alignment);
    if (!range) return std::nullopt;
    mStatistics.usedBytes += request.bytes;
    std::byte* mapped = block.chunk.mapped ? block.chunk.mapped + range->offset : nullptr;
    return Allocation{ block.chunk.id, range->offset, request.bytes, mapped, &block, range->node };
}

MemoryBlock* Allocator::addBlock(uint32_t pool, MemoryRequest const& request) {
    // A nearly full device may still have room for a smaller block.
    const uint64_t least = request.bytes + request.alignment;
    for (uint64_t bytes = mOptions.blockBytes; bytes >= least; bytes /= 4) {
        const std::optional<MemoryChunk> chunk = mSource.allocate(request.memoryType, bytes);
        if (!chunk) continue;
        mPools[pool].push_back(std::make_unique<MemoryBlock>(MemoryBlock{ *chunk, pool, RangeAllocator(bytes) }));
        mStatistics.reservedBytes += mPools[pool].back()->ranges.size();
        ++mStatistics.blocks;
        return mPools[pool].back().get();
    }
    return nullptr;
}

void Allocator::free(Allocation const& allocation) {
    mStatistics.usedBytes -= allocation.bytes;
    if (!allocation.block) {
        mStatistics.reservedBytes -= allocation.bytes;
        --mStatistics.dedicated;
        mSource.release({ allocation.memory, allocation.mapped });
        return;
    }
    allocation.block->ranges.free(allocation.node);
    if (allocation.block->ranges.isEmpty()) releaseSpareBlocks(allocation.block->pool);
}

void Allocator::releaseSpareBlocks(uint32_t pool) {
    bool keptOne = false;
    std::erase_if(mPools[pool], [&](std::unique_ptr<MemoryBlock> const& block) {
        if (!block->ranges.isEmpty()) return false;
        if (!keptOne) {
            keptOne = true;
            return false;
        }
        releaseBlock(*block);
        return true;
    });
}

void Allocator::releaseBlock(MemoryBlock& block) {
    mStatistics.reservedBytes -= block.ranges.size();
    --mStatistics.blocks;
    mSource.release(block.chunk);
}

} // namespace filament_core::backend::vulkan
