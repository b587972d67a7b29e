// SPDX-License-Identifier: Apache-2.0
/// FogHistory: the light of volumetric fog that a renderer's frames leave to each other (Fog::volumetricFrames).
///   Use     use() while a frame is planned; keep() once it is recorded.
///   Memory  two buffers of the last requested size, by turns that of this frame and that of the last one. They go when
///           kIdleFrames frames needed none.
///   Thread  the app thread; creations are recorded into Engine::Impl::pending.
///   Fails   std::bad_alloc; then nothing is kept, and the next frame begins anew.
#pragma once

#include "filament_core/engine/EngineImpl.h"

#include <array>

namespace filament_core::engine {

class FogHistory {
public:
    explicit FogHistory(Engine::Impl& engine) : mEngine(engine) {}
    void destroy() { release(); }

    /// 0 bytes: this frame needs none.
    void use(uint32_t bytes);
    /// Whether previous() is what a frame has written.
    bool isKept() const { return mIsKept; }
    backend::BufferHandle previous() const { return mBuffers[1 - mCurrent]; }
    backend::BufferHandle current() const { return mBuffers[mCurrent]; }
    /// The frame writes current().
    void keep(uint32_t bytes);

private:
    static constexpr uint32_t kIdleFrames = 120;

    void release();

    Engine::Impl& mEngine;
    std::array<backend::BufferHandle, 2> mBuffers{};
    uint32_t mBytes = 0, mCurrent = 0, mIdleFrames = 0;
    bool mIsKept = false;
};

} // namespace filament_core::engine
