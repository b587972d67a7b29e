// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/RangeAllocator.h"

#include "base/Assert.h"

#include <algorithm>
#include <bit>

namespace filament_core::backend::vulkan {
namespace {

uint64_t alignUp(uint64_t value, uint64_t alignment) { return (value + alignment - 1) & ~(alignment - 1); }

} // namespace

RangeAllocator::RangeAllocator(uint64_t bytes) : mSize(bytes & ~(kGranule - 1)), mFreeBytes(mSize) {
    for (auto& level : mHeads) level.fill(kNone);
    if (mSize > 0) link(makeNode(0, mSize));
}

RangeAllocator::Bin RangeAllocator::binOf(uint64_t bytes) {
    const uint64_t granules = bytes / kGranule;
    if (granules < kSteps) return { 0, static_cast<uint32_t>(granules) };
    const auto top = static_cast<uint32_t>(std::bit_width(granules)) - 1;
    return { top - kStepBits + 1, static_cast<uint32_t>(granules >> (top - kStepBits)) & (kSteps - 1) };
}

RangeAllocator::Bin RangeAllocator::binThatFits(uint64_t bytes) {
    // Rounding the size up to the next step selects a bin in which every range is large enough.
    const uint64_t granules = bytes / kGranule;
    if (granules < kSteps) return binOf(bytes);
    const auto top = static_cast<uint32_t>(std::bit_width(granules)) - 1;
    return binOf(alignUp(granules, uint64_t{ 1 } << (top - kStepBits)) * kGranule);
}

uint32_t RangeAllocator::findFree(uint64_t bytes) const {
    const Bin bin = binThatFits(bytes);
    if (bin.level >= kLevels) return kNone;
    const auto steps = static_cast<uint8_t>(mStepMasks[bin.level] & (0xFFu << bin.step));
    if (steps != 0) return mHeads[bin.level][static_cast<size_t>(std::countr_zero(steps))];
    const uint64_t levels = bin.level + 1 < kLevels ? mLevels & (~uint64_t{ 0 } << (bin.level + 1)) : 0;
    if (levels == 0) return kNone;
    const auto level = static_cast<size_t>(std::countr_zero(levels));
    return mHeads[level][static_cast<size_t>(std::countr_zero(mStepMasks[level]))];
}

std::optional<RangeAllocator::Range> RangeAllocator::allocate(uint64_t bytes, uint64_t alignment) {
    FILAMENT_ASSERT(bytes > 0 && std::has_single_bit(alignment),
                    "an allocation has a size and a power-of-two alignment");
    if (bytes > mSize || alignment > mSize) return std::nullopt;
    const uint64_t size = alignUp(bytes, kGranule);
    // Offsets are multiples of the granule, so aligning one skips at most this much.
    const uint64_t slack = alignment > kGranule ? alignment - kGranule : 0;
    uint32_t node = findFree(size + slack);
    if (node == kNone) return std::nullopt;

    unlink(node);
    const uint64_t head = alignUp(mNodes[node].offset, std::max(alignment, kGranule)) - mNodes[node].offset;
    if (head > 0) {
        const uint32_t aligned = splitBehind(node, head);
        link(node);
        node = aligned;
    }
    if (mNodes[node].size > size) link(splitBehind(node, size));
    mFreeBytes -= size;
    return Range{ mNodes[node].offset, node };
}

void RangeAllocator::free(uint32_t node) {
    FILAMENT_ASSERT(node < mNodes.size() && !mNodes[node].isFree && mNodes[node].size > 0, "a range is freed once");
    mFreeBytes += mNodes[node].size;
    // The next range first: merging with the previous one ends this node.
    const uint32_t next = mNodes[node].next;
    if (next != kNone && mNodes[next].isFree) {
        unlink(next);
        mergeWithNext(node);
    }
    const uint32_t previous = mNodes[node].previous;
    if (previous != kNone && mNodes[previous].isFree) {
        unlink(previous);
        node = mergeWithNext(previous);
    }
    link(node);
}

uint32_t RangeAllocator::freeRangeCount() const {
    return static_cast<uint32_t>(std::ranges::count_if(mNodes, [](Node const& node) { return node.isFree; }));
}

uint32_t RangeAllocator::makeNode(uint64_t offset, uint64_t size) {
    uint32_t node = static_cast<uint32_t>(mNodes.size());
    if (mUnusedNodes.empty()) {
        mNodes.emplace_back();
        mUnusedNodes.reserve(mNodes.capacity()); // ranges are freed in destructors: recycle() must not allocate
    } else {
        node = mUnusedNodes.back();
        mUnusedNodes.pop_back();
    }
    mNodes[node] = Node{ .offset = offset, .size = size };
    return node;
}

void RangeAllocator::recycle(uint32_t node) {
    mNodes[node] = {};
    mUnusedNodes.push_back(node);
}

void RangeAllocator::link(uint32_t node) {
    const Bin bin = binOf(mNodes[node].size);
    uint32_t& head = mHeads[bin.level][bin.step];
    mNodes[node].isFree = true;
    mNodes[node].previousFree = kNone;
    mNodes[node].nextFree = head;
    if (head != kNone) mNodes[head].previousFree = node;
    head = node;
    mStepMasks[bin.level] = static_cast<uint8_t>(mStepMasks[bin.level] | (1u << bin.step));
    mLevels |= uint64_t{ 1 } << bin.level;
}

void RangeAllocator::unlink(uint32_t node) {
    Node& free = mNodes[node];
    const Bin bin = binOf(free.size);
    if (free.nextFree != kNone) mNodes[free.nextFree].previousFree = free.previousFree;
    if (free.previousFree != kNone) {
        mNodes[free.previousFree].nextFree = free.nextFree;
    } else {
        mHeads[bin.level][bin.step] = free.nextFree;
        if (free.nextFree == kNone) {
            mStepMasks[bin.level] = static_cast<uint8_t>(mStepMasks[bin.level] & ~(1u << bin.step));
            if (mStepMasks[bin.level] == 0) mLevels &= ~(uint64_t{ 1 } << bin.level);
        }
    }
    free.isFree = false;
}

uint32_t RangeAllocator::splitBehind(uint32_t node, uint64_t bytes) {
    // Nodes are named by index, because making one may move them all.
    const uint32_t rest = makeNode(mNodes[node].offset + bytes, mNodes[node].size - bytes);
    mNodes[rest].previous = node;
    mNodes[rest].next = mNodes[node].next;
    if (mNodes[node].next != kNone) mNodes[mNodes[node].next].previous = rest;
    mNodes[node].next = rest;
    mNodes[node].size = bytes;
    return rest;
}

uint32_t RangeAllocator::mergeWithNext(uint32_t node) {
    const uint32_t gone = mNodes[node].next;
    mNodes[node].size += mNodes[gone].size;
    mNodes[node].next = mNodes[gone].next;
    if (mNodes[gone].next != kNone) mNodes[mNodes[gone].next].previous = node;
    recycle(gone);
    return node;
}

} // namespace filament_core::backend::vulkan
