// SPDX-License-Identifier: Apache-2.0
/// Options: what filament-render's command line asks for, checked.
///   Fails   parseOptions: InvalidArgument in one line that names the option, the value and what would be right.
#pragma once

#include "filament_core/base/Result.h"

#include <filament/Engine.h>
#include <filament/Light.h>
#include <filament/View.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace filament::tools {

enum class PictureFormat : uint8_t { Png, Exr };

struct Options {
    std::filesystem::path model;       ///< empty: the showcase
    std::filesystem::path environment; ///< empty: none, or the showcase's sky
    std::vector<Backend> backends{ Backend::Vulkan, Backend::Gles };
    std::string requireDevice;
    uint2 size{ 1280, 720 };
    uint32_t frames = 1;
    bool fit = true;
    double3 eye{ 0.9, 0.6, 1.5 }, at{ 0.0 };
    float fovDegrees = 40;
    Exposure exposure{ .aperture = 16, .shutterSeconds = 0.008f, .iso = 100 };
    Lux iblIntensity{ 30'000 };
    std::optional<SunLight> sun;
    bool skybox = true; ///< where there is an environment
    ColorGrading colorGrading{ .toneMapper = ToneMapper::Aces, .dither = false };
    uint32_t tolerance = 0; ///< in 1/255
    std::filesystem::path out = "out";
    PictureFormat format = PictureFormat::Png;
    bool timing = false, explain = false, trace = false;
    bool listDevices = false;
};

/// No value: the help text was asked for and is printed.
Result<std::optional<Options>> parseOptions(int argc, const char* const* argv);

} // namespace filament::tools
