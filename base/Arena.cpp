// SPDX-License-Identifier: Apache-2.0
#include "base/Arena.h"

#include <algorithm>
#include <cstdint>

namespace filament_core {
namespace {

size_t paddingFor(const std::byte* at, size_t alignment) {
    const auto address = reinterpret_cast<uintptr_t>(at);
    return (alignment - address % alignment) % alignment;
}

} // namespace

void* Arena::allocate(size_t bytes, size_t alignment) {
    for (; mCurrent < mBlocks.size(); ++mCurrent) {
        Block& block = mBlocks[mCurrent];
        const size_t padding = paddingFor(block.data.get() + block.used, alignment);
        if (block.used + padding + bytes <= block.size) {
            void* result = block.data.get() + block.used + padding;
            block.used += padding + bytes;
            return result;
        }
    }
    addBlock(std::max(mBlockBytes, bytes + alignment));
    return allocate(bytes, alignment);
}

void Arena::addBlock(size_t bytes) {
    mBlocks.push_back({ std::make_unique_for_overwrite<std::byte[]>(bytes), bytes, 0 });
    mCurrent = mBlocks.size() - 1;
}

// Replaces several blocks by one of their total size: with several, the unused end of each block would be wasted in
// every later frame.
void Arena::reset() {
    if (mBlocks.size() > 1) {
        const size_t bytes = bytesReserved();
        mBlocks.clear();
        addBlock(bytes);
    }
    for (Block& block : mBlocks) block.used = 0;
    mCurrent = 0;
}

size_t Arena::bytesUsed() const {
    size_t sum = 0;
    for (Block const& block : mBlocks) sum += block.used;
    return sum;
}

size_t Arena::bytesReserved() const {
    size_t sum = 0;
    for (Block const& block : mBlocks) sum += block.size;
    return sum;
}

} // namespace filament_core
