// SPDX-License-Identifier: Apache-2.0
/// Buffer: a VkBuffer with its memory, and which of its bytes transfers have written lately.
///   Thread  the driver thread.
///   Memory  Device memory, mapped when the device has one that is both local and host-visible.
///   Fails   create(): OutOfMemory with name and size, InvalidArgument for size 0.
#pragma once

#include "backend/api/Descriptions.h"
#include "backend/vulkan/Device.h"

#include <algorithm>

namespace filament_core::backend::vulkan {

struct BufferOptions {
    uint64_t bytes = 0;
    VkBufferUsageFlags usage = 0;
    MemoryPurpose purpose = MemoryPurpose::Device;
    std::string_view debugName;
};

class Buffer final : public DeviceObject {
public:
    static Result<std::unique_ptr<Buffer>> create(Device& device, BufferOptions const& options);
    static Result<std::unique_ptr<Buffer>> create(Device& device, BufferDesc const& desc);
    ~Buffer() override;

    VkBuffer handle() const { return mHandle; }
    uint64_t bytes() const { return mBytes; }
    std::byte* mapped() const { return mAllocation.mapped; } ///< null: use a staging buffer

    /// Whether a command recorded so far may read or write it. Until then the host may write mapped() directly.
    bool isUsed = false;

    // Bytes that transfers of one epoch of Barriers have written: their hull, which errs towards a barrier.
    bool overlapsWrites(uint64_t epoch, uint64_t begin, uint64_t end) const {
        return mWriteEpoch == epoch && begin < mWriteEnd && mWriteBegin < end;
    }
    void addWrite(uint64_t epoch, uint64_t begin, uint64_t end) {
        const bool isFirst = mWriteEpoch != epoch;
        mWriteBegin = isFirst ? begin : std::min(mWriteBegin, begin);
        mWriteEnd = isFirst ? end : std::max(mWriteEnd, end);
        mWriteEpoch = epoch;
    }

private:
    explicit Buffer(Device& device) : mDevice(device) {}

    Device& mDevice;
    VkBuffer mHandle = VK_NULL_HANDLE;
    Allocation mAllocation;
    uint64_t mBytes = 0;
    uint64_t mWriteEpoch = 0, mWriteBegin = 0, mWriteEnd = 0;
};

} // namespace filament_core::backend::vulkan
