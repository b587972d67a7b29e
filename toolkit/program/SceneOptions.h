// SPDX-License-Identifier: Apache-2.0
/// SceneOptions: the options shared by all tools that draw a model: what, under which light, from where, how bright,
/// and where to put the picture. filament-render and filament-reference share this command line.
///   Fails   convertSceneOptions(): InvalidArgument in one line that names the option, the value and what is valid.
#pragma once

#include "base/Result.h"

#include <filament_core/Camera.h>
#include <filament_core/Environment.h>
#include <filament_core/Gltf.h>
#include <filament_core/Light.h>
#include <filament_core/View.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace filament_core::tools {

class CommandLine;

struct SceneOptions {
    std::filesystem::path model; ///< empty: the showcase
    std::string variant;         ///< of KHR_materials_variants; empty: the materials of the file
    /// Empty: the model's own (EXT_lights_image_based), or the showcase's sky without a sun; "none": none.
    std::filesystem::path environment;
    View view{}; ///< without its camera: --size, --tone-mapper, --preset, --quality, --set
    bool fit = true;
    double3 eye{ 0.9, 0.6, 1.5 }, at{ 0.0 };
    float fovDegrees = 40;
    Exposure exposure{ .aperture = 16, .shutterSeconds = 0.008f, .iso = 100 };
    Lux iblIntensity{ 30'000 };
    std::optional<SunLight> sun;
    bool skybox = true;                          ///< if there is an environment
    float groundHeightMeters = 0;                ///< EnvironmentSettings, at the lowest point of the model
    std::filesystem::path lookFile{};            ///< that view.display.look was read from; empty: none
    std::filesystem::path dirt;                  ///< --set bloom.dirt=FILE.png: of the lens; empty: none
    bool exactShaders = true;                    ///< --set exact=off
    EnvironmentLoadOptions environmentOptions{}; ///< --set environment.format=RGBM, environment.roughnessMapping=linear
    GltfLoadOptions modelOptions{};              ///< --set model.positions=half, model.tangents=snorm8
    std::filesystem::path out = "out";
};

/// The words of those options as given.
struct SceneWords {
    std::string model, environment, size = "1280x720", fov = "40", iblIntensity = "30000", skybox, ground = "0",
                                    toneMapper = "aces", look, dither, out = "out";
    std::vector<std::string> eye, at, exposure, sun;
    std::string preset, quality;
    std::vector<std::string> set; ///< name=value
};

void declareSceneOptions(CommandLine& app, SceneWords& words, SceneOptions& options);
Result<void> convertSceneOptions(SceneWords const& words, SceneOptions& options);

/// "640x360", the word of --size.
Result<void> convertSize(std::string const& word, uint2& size);

Camera cameraOf(SceneOptions const& options);

} // namespace filament_core::tools
