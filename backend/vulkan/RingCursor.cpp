// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/RingCursor.h"

namespace filament_core::backend::vulkan {

std::optional<uint64_t> RingCursor::allocate(uint64_t bytes, uint64_t alignment, uint64_t serial) {
    if (bytes > mSize) return std::nullopt;
    uint64_t start = (mHead + alignment - 1) / alignment * alignment;
    if (start % mSize + bytes > mSize) start = (start / mSize + 1) * mSize; // never split: skip the rest of the ring
    // Head and tail are not reduced modulo the size, so that a full ring differs from an empty one.
    if (start + bytes - mTail > mSize) return std::nullopt;
    mHead = start + bytes;
    if (!mMarks.empty() && mMarks.back().serial == serial) {
        mMarks.back().end = mHead;
    } else {
        mMarks.push_back({ serial, mHead });
    }
    return start % mSize;
}

void RingCursor::release(uint64_t finishedSerial) {
    while (!mMarks.empty() && mMarks.front().serial <= finishedSerial) {
        mTail = mMarks.front().end;
        mMarks.pop_front();
    }
    if (mMarks.empty()) mHead = mTail = 0; // an empty ring starts again at 0, so that the whole size is available
}

} // namespace filament_core::backend::vulkan
