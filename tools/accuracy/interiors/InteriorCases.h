// SPDX-License-Identifier: Apache-2.0
/// InteriorCases: the rooms in which baked light is compared with the path tracer, and how their light is baked.
///   Thread  any; pure.
#pragma once

#include "toolkit/interiors/Interiors.h"

#include <filament_core/Camera.h>

#include <optional>
#include <string>
#include <vector>

namespace filament_core::accuracy {

/// How the light of the room comes into a frame. The probes' are reflections; where a grid or a lightmap is, diffuse
/// light is its own.
enum class LightTechnique : uint8_t { Environment, Probes, Grid, GridAndProbes, Lightmap, LightmapAndProbes };
inline constexpr size_t kLightTechniques = 6;
const char* toString(LightTechnique technique); ///< "lightmap and probes"

struct LightBox {
    double3 center{ 0.0 };
    float3 half{ 1.0f };
};

struct InteriorCase {
    std::string name, title;
    std::optional<interiors::Interior> room; ///< generated; none: that of the asset
    std::string asset, environment;          ///< paths below the folder of assets; with `room` unused
    std::string without;                     ///< a material whose meshes are left out of the asset
    std::vector<interiors::InteriorCamera> cameras;
    Exposure exposure{};
    LightBox grid{};                ///< reaches into the walls
    std::vector<LightBox> probes;   ///< captured in the middle
    double texelsPerMeter = 16;     ///< of the lightmap
    uint32_t texelSamples = 256;    ///< paths, at most
    double gridSpacing = 1;         ///< metres
    uint32_t mostProbes = 2000;     ///< of the grid
    uint32_t samplesPerPixel = 128; ///< of the path tracer
};

std::vector<InteriorCase> interiorCases();

} // namespace filament_core::accuracy
