// SPDX-License-Identifier: Apache-2.0
/// PixelReads: pixels on their way from the device to the app; implements the tickets of Renderer.
///   Thread  the app thread.
///   Memory  one entry per ticket, until it is taken.
///   Fails   ask(): a ticket of 0 if memory runs out; take() then returns an image without bytes at once. For pixels
///           that never arrive, because the device refused the image or was lost, take() returns an image without bytes
///           and wait() an error. An unknown ticket is a bug of the caller.
#pragma once

#include "filament_core/engine/EngineImpl.h"

#include <filament_core/Renderer.h>

#include <map>
#include <optional>

namespace filament_core::engine {

class PixelReads {
public:
    explicit PixelReads(Engine::Impl& engine) : mEngine(engine) {}

    PixelTicket ask(TextureState const& texture, uint8_t level = 0, uint16_t layer = 0);
    std::optional<Image> take(PixelTicket ticket);
    Result<Image> wait(PixelTicket ticket);

private:
    struct Read {
        Image image;            ///< without its bytes
        bool isRefused = false; ///< the engine could not create the texture: there is nothing to wait for
    };
    using Pending = std::map<uint64_t, Read>;

    void record(backend::CmdReadTexture const& read);
    Pending::iterator find(PixelTicket ticket);

    Engine::Impl& mEngine;
    Pending mPending;
};

/// For an image that the device could not create.
Error noImage(uint32_t width, uint32_t height);

} // namespace filament_core::engine
