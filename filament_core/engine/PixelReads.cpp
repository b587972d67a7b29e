// SPDX-License-Identifier: Apache-2.0
#include "filament_core/engine/PixelReads.h"

#include "backend/stream/RecordingGuards.h"
#include "base/OutOfMemory.h"
#include "base/Result.h"

#include <algorithm>
#include <utility>

namespace filament_core::engine {

using namespace backend;

Error noImage(uint32_t width, uint32_t height) {
    return fail(ErrorCode::DeviceUnavailable,
                "the device has no image of {} x {} texels; Engine::takeErrors() names the cause", width, height);
}

PixelTicket PixelReads::ask(TextureState const& texture, uint8_t level, uint16_t layer) {
    return mEngine.orNone("reading pixels", texture.name, [&]() -> PixelTicket {
        const Ticket ticket = mEngine.stream->nextTicket();
        const Rect all{ 0, 0, std::max(1u, texture.desc.width >> level), std::max(1u, texture.desc.height >> level) };
        mPending[ticket.value] = { { .width = all.width, .height = all.height, .format = texture.desc.format },
                                   !texture.handle };
        if (!texture.handle) return { ticket.value };
        record({ texture.handle, level, layer, all, ticket });
        return { ticket.value };
    });
}

/// If this throws, no trace of the request is left.
void PixelReads::record(CmdReadTexture const& read) {
    try {
        FrameCommands commands(*mEngine.stream);
        mEngine.drainPending(*commands);
        commands->record(read);
    } catch (std::bad_alloc const&) {
        mPending.erase(read.ticket.value);
        throw;
    }
}

PixelReads::Pending::iterator PixelReads::find(PixelTicket ticket) {
    const auto entry = mPending.find(ticket.value);
    FILAMENT_ASSERT(entry != mPending.end(), "a ticket is taken once, from the renderer that gave it");
    return entry;
}

std::optional<Image> PixelReads::take(PixelTicket ticket) {
    if (!ticket) return Image{}; // memory ran out when it was requested
    const auto entry = find(ticket);
    auto bytes = mEngine.stream->takeReadback({ ticket.value });
    const bool neverComes = entry->second.isRefused || mEngine.stream->isDeviceLost();
    if (!bytes && !neverComes) return std::nullopt;
    Image image = std::move(entry->second.image);
    if (bytes) image.pixels = std::move(*bytes);
    mPending.erase(entry);
    return image;
}

Result<Image> PixelReads::wait(PixelTicket ticket) {
    if (!ticket) return outOfMemory("read pixels: not asked");
    const auto entry = find(ticket);
    Image image = std::move(entry->second.image);
    const bool isRefused = entry->second.isRefused;
    mPending.erase(entry);
    return orOutOfMemory("read pixels", {}, [&]() -> Result<Image> {
        if (!isRefused) {
            auto bytes = mEngine.stream->waitReadback({ ticket.value });
            if (!bytes) return bytes.error();
            image.pixels = std::move(*bytes);
        }
        // A read of an image that the device refused returns no bytes, so that no caller waits for ever.
        if (image.pixels.empty()) return noImage(image.width, image.height);
        return std::move(image);
    });
}

} // namespace filament_core::engine
