// SPDX-License-Identifier: Apache-2.0
/// ImageTarget: the target of Renderer::renderToImage(), as a swap chain of one image.
///   Memory  one image, recreated when the size changes.
///   Thread  the app thread.   Fails: std::bad_alloc; there is no image then.
#pragma once

#include "filament_core/engine/EngineImpl.h"

#include <utility>

namespace filament_core::engine {

class ImageTarget {
public:
    explicit ImageTarget(Engine::Impl& engine) : mEngine(engine) {}
    /// Before the engine ends, or the image is no longer needed.
    void destroy() noexcept { mEngine.destroy(std::exchange(mChain, {})); }
    ImageTarget(ImageTarget const&) = delete;
    ImageTarget& operator=(ImageTarget const&) = delete;

    SwapChain of(uint2 size);

private:
    Engine::Impl& mEngine;
    SwapChain mChain;
};

} // namespace filament_core::engine
