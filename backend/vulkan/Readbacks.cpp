// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/Readbacks.h"

#include <cstring>
#include <vector>

namespace filament_core::backend::vulkan {
namespace {

/// Bytes per texel in a copy: the depth aspect without stencil, D16 before it is widened.
uint64_t copiedBytes(Format format, Rect const& rect) {
    const uint64_t texels = uint64_t{ rect.width } * rect.height;
    if (format == Format::D16) return texels * 2;
    return hasDepth(format) ? texels * 4 : imageBytes(format, rect.width, rect.height);
}

/// The contract promises floats for every depth format.
std::vector<float> floatsFromUnorm16(std::byte const* bytes, size_t count) {
    std::vector<float> depths(count);
    for (size_t i = 0; i < count; ++i) {
        uint16_t value = 0;
        std::memcpy(&value, bytes + i * sizeof value, sizeof value);
        depths[i] = static_cast<float>(value) / 65535.0f;
    }
    return depths;
}

} // namespace

Result<std::unique_ptr<Buffer>> Readbacks::makeTarget(CmdReadTexture const& command, Texture const& texture) {
    const std::string name = fmt::format("read-back of '{}'", texture.name());
    return Buffer::create(mDevice, { copiedBytes(texture.format(), command.rect), VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                     MemoryPurpose::Readback, name });
}

Result<std::unique_ptr<Buffer>> Readbacks::makeTarget(CmdReadBuffer const& command) {
    return Buffer::create(mDevice, { command.size, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryPurpose::Readback,
                                     "read-back of a buffer" });
}

void Readbacks::add(Ticket ticket, Format format, std::unique_ptr<Buffer> target, uint64_t serial) {
    mWaiting.push_back({ ticket, format, std::move(target), serial });
}

void Readbacks::answer(uint64_t finishedSerial, ResultSink& sink) {
    while (!mWaiting.empty() && mWaiting.front().serial <= finishedSerial) {
        Waiting const& front = mWaiting.front();
        Buffer const& target = *front.target;
        if (!target.mapped()) {
            sink.onReadback(front.ticket, {}); // the driver failed to map it
        } else if (front.format == Format::D16) {
            const std::vector<float> depths = floatsFromUnorm16(target.mapped(), target.bytes() / 2);
            sink.onReadback(front.ticket, std::as_bytes(std::span(depths)));
        } else {
            sink.onReadback(front.ticket, { target.mapped(), target.bytes() });
        }
        mWaiting.pop_front();
    }
}

} // namespace filament_core::backend::vulkan
