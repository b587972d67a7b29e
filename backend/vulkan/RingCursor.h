// SPDX-License-Identifier: Apache-2.0
/// RingCursor: where the next bytes of a ring buffer go, and which bytes the GPU has not read yet; independent of any
/// device.
///   In      the serial of the submission that will read the bytes; later the serial that has finished.
///   Thread  one at a time.
///   Memory  one entry per submission in flight.
///   Fails   allocate() returns nothing while the ring is too full; bytes > size() never fit.
///   Cost    constant.
#pragma once

#include "base/Fifo.h"

#include <cstdint>
#include <optional>

namespace filament_core::backend::vulkan {

class RingCursor {
public:
    /// `size` is a multiple of every alignment used later.
    explicit RingCursor(uint64_t size) : mSize(size) {}

    std::optional<uint64_t> allocate(uint64_t bytes, uint64_t alignment, uint64_t serial);

    /// Everything allocated for serials <= `finishedSerial` may be overwritten.
    void release(uint64_t finishedSerial);

    uint64_t size() const { return mSize; }
    uint64_t bytesInUse() const { return mHead - mTail; } ///< with padding

private:
    struct Mark {
        uint64_t serial = 0, end = 0;
    };

    uint64_t mSize;
    uint64_t mHead = 0, mTail = 0; // bytes since the beginning of time; the place in the ring is modulo mSize
    Fifo<Mark> mMarks;             // ascending
};

} // namespace filament_core::backend::vulkan
