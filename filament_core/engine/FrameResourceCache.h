// SPDX-License-Identifier: Apache-2.0
/// FrameResourceCache: the engine's own materials, tables and samplers that a renderer's frames are drawn with.
///   In      requirements of a view and its scene.   Out: passes::FrameResources.
///   Memory  an entry for each material. Missing ones are created and recorded into `pending` of the engine; finding
///           existing resources allocate nothing.
///   Thread  the app thread.   Fails: std::bad_alloc; objects created so far serve the next frame.
#pragma once

#include "filament_core/engine/EffectMaterialCache.h"
#include "filament_core/passes/FrameResources.h"

#include <array>

namespace filament_core::engine {

class FrameResourceCache {
public:
    explicit FrameResourceCache(Engine::Impl& engine) : mEngine(engine), mEffects(engine) {}

    /// `isToneMapped`: the image goes through the view's tone mapper.
    passes::FrameResources find(View const& view, prepare::FramePacket const& packet, passes::PipelineSource pipelines,
                                bool isToneMapped);

private:
    passes::FrameSamplers samplers();
    passes::LightingTextures lighting(View const& view, prepare::EnvironmentPacket const& environment);
    backend::TextureHandle toneTable(View const& view, prepare::FramePacket const& packet);
    passes::DirtTexture dirt(prepare::FramePacket const& packet);
    scene::Material const* skybox(bool isRgbm, bool hasGround);
    scene::Material const* farDepth();
    scene::Material const* sunDisc();
    scene::Material const* edges();
    scene::Material const* debugView(DebugView debugView, bool isEncoded);

    Engine::Impl& mEngine;
    std::array<scene::Material const*, 4> mSkyboxes{}; // by isRgbm and hasGround
    scene::Material const* mFarDepth = nullptr;
    scene::Material const* mSunDisc = nullptr;
    scene::Material const* mEdges = nullptr;
    std::array<scene::Material const*, 2 * kDebugViewCount>
            mDebugViews{}; // by DebugView and whether the target is encoded
    EffectMaterialCache mEffects;
};

} // namespace filament_core::engine
