// SPDX-License-Identifier: Apache-2.0
/// View: one camera onto a scene and how its picture is finished. A plain value.
#pragma once

#include <filament/Camera.h>
#include <filament/Objects.h>
#include <filament/Quality.h>

#include <optional>
#include <string_view>

namespace filament {

enum class ToneMapper : uint8_t {
    Linear, ///< clamp to [0, 1]
    Aces,   ///< Hill's fit of the ACES transforms: highlights desaturate
    Filmic, ///< Narkowicz 2015, the ACES curve per component
    Mobile, ///< x / (x + 0.155) * 1.019: transfer function included
};
const char* toString(ToneMapper toneMapper);
std::optional<ToneMapper> toneMapperFromName(std::string_view name);

struct ColorGrading {
    ToneMapper toneMapper = ToneMapper::Aces;
    bool dither = false; ///< one least significant bit of interleaved gradient noise before rounding to 8 bits
};

struct View {
    Camera camera{};
    uint2 size{ 1280, 720 }; ///< pixels, >= 1
    ColorGrading colorGrading{};
    Quality quality{};               ///< which approximations the shading makes
    float4 clearColor{ 0, 0, 0, 1 }; ///< scene-linear and pre-exposed: what is behind everything, without a skybox
    uint8_t samples = 1;             ///< MSAA: 1 or 4
    double timeSeconds = 0;          ///< handed to the materials
};

} // namespace filament
