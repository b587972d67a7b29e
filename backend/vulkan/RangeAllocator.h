// SPDX-License-Identifier: Apache-2.0
/// RangeAllocator: offsets inside one block of memory; independent of any device.
///   Source  two-level segregated fit: Masmano, Ripoll, Crespo, Real, "TLSF: a New Dynamic Memory Allocator for
///           Real-Time Systems", 2004. Free ranges are in bins of 8 steps per power of two; two bitmaps find the first
///           bin that certainly fits; neighbours merge when a range is freed.
///   In      bytes > 0 and a power-of-two alignment.  Out: an aligned offset and the node to free.
///   Thread  one at a time.
///   Memory  32 bytes of host memory per live or free range.
///   Limits  sizes are rounded up to kGranule; up to 1/8 of a block may be unusable for one request (the bin steps).
///   Fails   allocate() returns nothing if no free range certainly fits.
///   Cost    allocate and free: constant time, no loop over ranges.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace filament_core::backend::vulkan {

class RangeAllocator {
public:
    static constexpr uint64_t kGranule = 256; ///< the largest minUniformBufferOffsetAlignment that Vulkan allows

    struct Range {
        uint64_t offset = 0;
        uint32_t node = 0; ///< pass it to free()
    };

    explicit RangeAllocator(uint64_t bytes);

    std::optional<Range> allocate(uint64_t bytes, uint64_t alignment);
    void free(uint32_t node);

    uint64_t size() const { return mSize; }
    uint64_t freeBytes() const { return mFreeBytes; }
    bool isEmpty() const { return mFreeBytes == mSize; } ///< nothing is allocated
    uint32_t freeRangeCount() const;                     ///< 1 for a block whose free ranges all merged

private:
    static constexpr uint32_t kNone = ~0u;
    static constexpr uint32_t kStepBits = 3; // 8 bins per power of two
    static constexpr uint32_t kSteps = 1u << kStepBits;
    static constexpr uint32_t kLevels = 64;

    struct Node {
        uint64_t offset = 0, size = 0;                   // bytes
        uint32_t previous = kNone, next = kNone;         // neighbours in the block
        uint32_t previousFree = kNone, nextFree = kNone; // in the bin
        bool isFree = false;
    };
    struct Bin {
        uint32_t level = 0, step = 0;
    };

    static Bin binOf(uint64_t bytes);       // where a free range of this size is kept
    static Bin binThatFits(uint64_t bytes); // the first one whose ranges are all large enough
    uint32_t findFree(uint64_t bytes) const;
    uint32_t makeNode(uint64_t offset, uint64_t size);
    void recycle(uint32_t node);
    void link(uint32_t node);
    void unlink(uint32_t node);
    uint32_t splitBehind(uint32_t node, uint64_t bytes);
    uint32_t mergeWithNext(uint32_t node);

    uint64_t mSize = 0, mFreeBytes = 0;
    uint64_t mLevels = 0;                      // bit l: some step of level l is not empty
    std::array<uint8_t, kLevels> mStepMasks{}; // bit s: the bin is not empty
    std::array<std::array<uint32_t, kSteps>, kLevels> mHeads;
    std::vector<Node> mNodes;
    std::vector<uint32_t> mUnusedNodes;
};

} // namespace filament_core::backend::vulkan
