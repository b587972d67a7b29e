// SPDX-License-Identifier: Apache-2.0
/// Upload: host memory that the GPU copies from.
///   In      a number of bytes.  Out: where to write them, and the buffer and offset to copy from; valid until the
///           submission being recorded has finished.
///   Thread  the driver thread.
///   Memory  one mapped ring of 4 MiB that doubles up to 32 MiB if it is too small for the data in flight; beyond that,
///           and for anything larger than half a ring, a separate buffer.
///   Fails   stage() returns nothing if the device has no memory left.
#pragma once

#include "backend/vulkan/Buffer.h"
#include "backend/vulkan/RingCursor.h"
#include "backend/vulkan/Submissions.h"

#include <optional>

namespace filament_core::backend::vulkan {

struct StagedBytes {
    VkBuffer buffer = VK_NULL_HANDLE;
    uint64_t offset = 0;
    std::byte* host = nullptr;
};

class Upload {
public:
    static constexpr uint64_t kFirstRingBytes = uint64_t{ 4 } << 20;
    static constexpr uint64_t kLargestRingBytes = uint64_t{ 32 } << 20;

    Upload(Device& device, Submissions& submissions) : mDevice(device), mSubmissions(submissions) {}

    /// Copies `bytes` to where the GPU can read them.
    std::optional<StagedBytes> stage(std::span<const std::byte> bytes);

    uint64_t ringBytes() const { return mRing ? mRing->bytes() : 0; }

private:
    std::optional<StagedBytes> reserve(uint64_t bytes);
    std::optional<StagedBytes> reserveInRing(uint64_t bytes);
    std::optional<StagedBytes> reserveOwnBuffer(uint64_t bytes);
    bool growRing();
    std::unique_ptr<Buffer> makeBuffer(uint64_t bytes) const;

    Device& mDevice;
    Submissions& mSubmissions;
    std::unique_ptr<Buffer> mRing;
    RingCursor mCursor{ 0 };
};

} // namespace filament_core::backend::vulkan
