// SPDX-License-Identifier: Apache-2.0
/// PixelReads: the pixels of images, on their way from the device to the app. What Renderer says of its tickets.
///   Thread  the app thread.
///   Memory  an entry a ticket, until it is taken.
///   Fails   ask(): a ticket of 0 where memory runs out, take() then gives an image without bytes at once. Pixels that
///           never come, of an image that the device refused or on a lost device: an image without bytes from take(),
///           an error from wait(). A ticket that is not under way is a caller's bug.
#pragma once

#include "filament_core/engine/EngineImpl.h"

#include <filament/Renderer.h>

#include <map>
#include <optional>

namespace filament::engine {

class PixelReads {
public:
    explicit PixelReads(Engine::Impl& engine) : mEngine(engine) {}

    PixelTicket ask(TextureState const& texture);
    std::optional<Image> take(PixelTicket ticket);
    Result<Image> wait(PixelTicket ticket);

private:
    using Pending = std::map<uint64_t, Image>;

    void record(backend::Ticket ticket, backend::TextureHandle texture, backend::Rect const& all);
    Pending::iterator find(PixelTicket ticket);
    bool isRefused(Image const& image) const;

    Engine::Impl& mEngine;
    Pending mPending; ///< everything but the bytes
};

/// Of an image that the device could not make.
Error noImage(uint32_t width, uint32_t height);

} // namespace filament::engine
