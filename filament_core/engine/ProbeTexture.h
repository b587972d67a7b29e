// SPDX-License-Identifier: Apache-2.0
/// ProbeTexture: a renderer's array of cubes: the environment's, then those of the probes of its view.
///   Use     use() while a frame is planned, with its packet; copy() while it is recorded, before its passes; keep()
///           once it is recorded.
///   Memory  kProbeLayers cubes of the environment's size while a view uses probes. They go when kIdleFrames frames
///           used none.
///   Thread  the app thread; creations are recorded into Engine::Impl::pending.
///   Fails   std::bad_alloc; the array then holds nothing, and the next frame copies all cubes.
#pragma once

#include "filament_core/engine/EngineImpl.h"
#include "filament_core/prepare/ProbePacket.h"

namespace filament_core::engine {

class ProbeTexture {
public:
    explicit ProbeTexture(Engine::Impl& engine);
    void destroy() { release(); }

    /// For prepareFrame().
    prepare::HeldProbes const& held() const { return mHeld; }
    void use(prepare::ProbePacket const& probes);
    backend::TextureHandle texture() const { return mTexture; }
    /// Copies what the array lacks. From now on its contents are unknown.
    void copy(prepare::ProbePacket const& probes, backend::CommandBuffer& commands);
    void keep(prepare::ProbePacket const& probes);

private:
    static constexpr uint32_t kIdleFrames = 120;

    void release();

    Engine::Impl& mEngine;
    prepare::HeldProbes mHeld;
    backend::TextureHandle mTexture;
    uint32_t mIdleFrames = 0;
};

} // namespace filament_core::engine
