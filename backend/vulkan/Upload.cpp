// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Upload.h"

#include <cstring>

namespace filament_core::backend::vulkan {

std::optional<StagedBytes> Upload::stage(std::span<const std::byte> bytes) {
    const std::optional<StagedBytes> staged = reserve(bytes.size());
    if (staged) std::memcpy(staged->host, bytes.data(), bytes.size());
    return staged;
}

std::optional<StagedBytes> Upload::reserve(uint64_t bytes) {
    while (bytes <= kLargestRingBytes / 2) {
        if (auto staged = reserveInRing(bytes)) return staged;
        if (!growRing()) break;
    }
    return reserveOwnBuffer(bytes);
}

std::optional<StagedBytes> Upload::reserveInRing(uint64_t bytes) {
    if (!mRing || bytes > mCursor.size() / 2) return std::nullopt;
    mCursor.release(mSubmissions.finishedSerial());
    const auto offset = mCursor.allocate(bytes, mDevice.physical().copyOffsetAlignment, mSubmissions.recordingSerial());
    if (!offset) return std::nullopt;
    return StagedBytes{ mRing->handle(), *offset, mRing->mapped() + *offset };
}

bool Upload::growRing() {
    const uint64_t bytes = mRing ? mRing->bytes() * 2 : kFirstRingBytes;
    if (bytes > kLargestRingBytes) return false;
    std::unique_ptr<Buffer> ring = makeBuffer(bytes);
    if (!ring) return false;
    // Copies that are in flight still read the old ring.
    mSubmissions.keep(std::move(mRing));
    mRing = std::move(ring);
    mCursor = RingCursor(bytes);
    return true;
}

std::optional<StagedBytes> Upload::reserveOwnBuffer(uint64_t bytes) {
    std::unique_ptr<Buffer> buffer = makeBuffer(bytes);
    if (!buffer) return std::nullopt;
    const StagedBytes staged{ buffer->handle(), 0, buffer->mapped() };
    mSubmissions.keep(std::move(buffer));
    return staged;
}

std::unique_ptr<Buffer> Upload::makeBuffer(uint64_t bytes) const {
    auto buffer =
            Buffer::create(mDevice, { bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, MemoryPurpose::Upload, "staging" });
    if (!buffer || !buffer.value()->mapped()) return nullptr;
    return std::move(buffer).value();
}

} // namespace filament_core::backend::vulkan
