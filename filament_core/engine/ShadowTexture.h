// SPDX-License-Identifier: Apache-2.0
/// ShadowTexture: the textures of a renderer's shadow maps, depth and moments, and their contents.
///   Use     use() while a frame is planned, with the needs of its packet; forget() before that is recorded, keep()
///           once it is.
///   Memory  one D32F texture of the last requested size, with a stencil for slabs, and one of moments if requested.
///           They go when kIdleFrames frames had no shadows.
///   Thread  the app thread; creations are recorded into Engine::Impl::pending.
///   Fails   std::bad_alloc; the texture then holds nothing, and the next frame draws all maps.
#pragma once

#include "filament_core/engine/EngineImpl.h"
#include "filament_core/prepare/ShadowMaps.h"

namespace filament_core::engine {

class ShadowTexture {
public:
    explicit ShadowTexture(Engine::Impl& engine) : mEngine(engine) {}
    void destroy() { release(); }

    /// For prepareFrame().
    prepare::ShadowAtlas const& held() const { return mHeld; }
    /// Resets the state: positions of maps depend on earlier frames.
    void beginAnew();
    /// Creates missing textures for a packet with maps.
    void use(prepare::ShadowPacket const& shadows);
    backend::TextureHandle depths() const { return mDepths; }
    backend::TextureHandle moments() const { return mMoments; }
    /// From now on the textures' contents are unknown, if the frame draws a map.
    void forget(prepare::ShadowPacket const& shadows);
    /// The frame draws the maps of its packet.
    void keep(prepare::ShadowPacket const& shadows);

private:
    static constexpr uint32_t kIdleFrames = 120;

    void release();
    backend::TextureHandle create(backend::DeviceTextureDesc const& desc);

    Engine::Impl& mEngine;
    prepare::ShadowAtlas mHeld;
    backend::TextureHandle mDepths, mMoments;
    uint32_t mSize = 0;
    prepare::ShadowMoments mKind = prepare::ShadowMoments::None;
    bool mHasStencil = false;
    uint32_t mIdleFrames = 0;
};

} // namespace filament_core::engine
