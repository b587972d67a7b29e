// SPDX-License-Identifier: Apache-2.0
/// Options: the checked command line of filament-bake.
///   Fails   parseOptions: InvalidArgument in one line that names the option, the value and what is valid.
#pragma once

#include "base/Result.h"
#include "toolkit/program/Shard.h"
#include "tools/bake/Atlas.h"
#include "tools/bake/BakeLight.h"
#include "tools/bake/LightmapStore.h"

#include <filament_core/Light.h>

#include <filesystem>
#include <optional>
#include <vector>

namespace filament_core::bake {

/// What the HTML report shows (page/BakePage.h).
struct ReportOptions {
    std::filesystem::path file;     ///< empty: no report
    std::optional<double3> eye, at; ///< none: one that sees much of what was baked; the middle of it
    float fovDegrees = 50;
    uint2 size{ 480, 272 };
    uint32_t samples = 64; ///< of a pixel of the traced image
};

struct Options {
    std::filesystem::path model;
    std::filesystem::path environment; ///< empty: the model's own; "none": none
    Lux iblIntensity{ 30'000 };
    double rotationDegrees = 0; ///< of the environment around +Y
    std::optional<SunLight> sun;
    AtlasOptions atlas{};
    uint32_t texels = 0; ///< a budget that Densities.h spends; 0: charts have the density of `atlas`
    StorageChoice storage{};
    LightSettings light{ .exposure = { .aperture = 16, .shutterSeconds = 0.008f, .iso = 100 } };
    bool occlusionOfVertices = false;         ///< with LightSettings::occlusionMeters; else in textures
    bool showsCharts = false;                 ///< writes the model with its charts in place of light, too
    uint32_t heldOutPoints = 256;             ///< of surfaces, between texels, that judge the lightmap
    std::filesystem::path grid;               ///< of an irradiance grid (GridProgram.h); empty: bake a lightmap
    std::optional<tools::Shard> shard;        ///< bake this part alone, into a journal
    std::vector<std::filesystem::path> merge; ///< journals of parts; empty: bake
    std::filesystem::path out = "out";
    ReportOptions report{};
    int workers = -1; ///< as JobSystemOptions::workers
};

/// No value: the help text was requested and has been printed.
Result<std::optional<Options>> parseOptions(int argc, const char* const* argv);

} // namespace filament_core::bake
