// SPDX-License-Identifier: Apache-2.0
/// FrameResources: what the passes of a frame need of the engine. The engine fills it for every frame; passes know
/// nothing else of it.
///   Life    the values: one frame. What they name: longer than the frame takes on the device.
///   Thread  a plain value, read-only once filled.
#pragma once

#include "filament_core/passes/FrameData.h"
#include "filament_core/passes/PipelineSource.h"

namespace filament::passes {

/// The textures that lit materials read of their surroundings; every handle is set.
struct LightingTextures {
    backend::TextureHandle specular, dfg, irradiance;
    backend::SamplerHandle trilinear; ///< of the specular levels
    backend::SamplerHandle bilinear;  ///< of the others, and of the sky: one level each
};

struct ToneMap {
    scene::Material const* material = nullptr; ///< tonemap, specialised to the mapper of the view
    backend::TextureHandle table{};            ///< where it looks colours up (ToneTable.h), if it does; always set
};

struct FrameResources {
    PipelineSource pipelines;
    LightingTextures lighting{};
    backend::SamplerHandle nearestSampler;
    backend::BufferHandle instanceIds;       ///< vertices: 0, 1, 2, ... kObjectsPerWindow - 1
    scene::Material const* skybox = nullptr; ///< full-screen material; null: the scene has no sky
    ToneMap toneMap;                         ///< null where the picture stays scene-linear
    bool hasHalfFloats = false;              ///< shaders may compute in 16 bits
};

} // namespace filament::passes
