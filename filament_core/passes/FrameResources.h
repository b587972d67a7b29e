// SPDX-License-Identifier: Apache-2.0
/// FrameResources: what the passes of a frame need of the engine. The engine fills it for every frame; passes know
/// nothing else of it.
///   Life    the values: one frame. What they name: longer than the frame takes on the device.
///   Thread  a plain value, read-only once filled.
#pragma once

#include "filament_core/passes/DispatchCache.h"
#include "filament_core/passes/EffectMaterials.h"
#include "filament_core/passes/FrameData.h"
#include "filament_core/passes/PipelineSource.h"

#include <array>

namespace filament_core::passes {

/// The textures that lit materials read of their surroundings; every handle but the last is set.
struct LightingTextures {
    backend::TextureHandle specular, dfg, irradiance;
    backend::TextureHandle probes; ///< array of cubes, the environment's first; none: no probe is in view
};

/// Bloom::dirt.
struct DirtTexture {
    backend::TextureHandle texture; ///< none: the lens is clean
    uint2 size{ 1, 1 };
    uint32_t levels = 1;
};

/// They clamp to the edge.
struct FrameSamplers {
    backend::SamplerHandle nearest, bilinear;                            ///< of the first level
    backend::SamplerHandle nearestOfLevels, bilinearOfLevels, trilinear; ///< of levels: the nearest one
};

struct FrameResources {
    PipelineSource pipelines;
    LightingTextures lighting{};
    FrameSamplers samplers{};
    EffectMaterials* effects = nullptr;
    DispatchCache* dispatches = nullptr;
    backend::TextureHandle white{};                  ///< 2D, of one opaque white texel
    backend::BufferHandle noFogCells;                ///< storage, of one float4: where no fog is lit
    backend::BufferHandle lastFogLight, fogLight;    ///< storage: FogHistory; noFogCells without
    backend::BufferHandle instanceIds;               ///< vertices; see kFirstPairId (DrawRecorder.h)
    scene::MaterialInstance const* motion = nullptr; ///< draws motion; null: none is asked for
    /// Leave depths of levels of detail that fade, by their front faces and by both; null: none fades.
    std::array<scene::MaterialInstance const*, 2> levelFade{};
    scene::Material const* skybox = nullptr;    ///< full-screen material; null: the scene has no sky
    scene::Material const* farDepth = nullptr;  ///< full-screen material that empties tiles, and all but caps of slabs;
                                                ///< null: unused
    scene::Material const* sunDisc = nullptr;   ///< full-screen material; null: no disc is in view
    scene::Material const* debugView = nullptr; ///< full-screen material; null: no debug view
    scene::Material const* edges = nullptr;     ///< whose fragment stage numbers triangles; null: none is asked for
    scene::MaterialInstance const* debugTested = nullptr;  ///< draw rectangles of DebugDraw that surfaces hide
    scene::MaterialInstance const* debugThrough = nullptr; ///< and those that they do not
    uint32_t debugLayout = 0;                              ///< of these rectangles, into GeometryLayouts
    scene::MaterialInstance const* splats = nullptr;       ///< draws FramePacket::splats; null: there are none
    uint32_t splatLayout = 0;                              ///< of their quads, into GeometryLayouts
    backend::TextureHandle shadowAtlas{};   ///< of ShadowPacket::atlasSize texels a side; none without shadow maps
    backend::TextureHandle shadowMoments{}; ///< of the same size; none if the filter reads depths
    backend::TextureHandle toneTable{};     ///< of the view's mapper (ToneTable.h); none: it is computed
    DirtTexture dirt{};                     ///< that scatters light in this frame
    bool hasHalfFloats = false;             ///< shaders may compute in 16 bits
};

} // namespace filament_core::passes
