// SPDX-License-Identifier: Apache-2.0
/// SceneAssets: turns the text of a scene file into files, lights and a camera, for every program that draws such
/// scenes.
///   Model        objects to build, "showcase", "asset:PATH", or a path relative to the scene file.
///   Environment  "sky" (analytic, without its sun), "sunny" (with it), "white" (radiance 1 everywhere), "studio"
///                (dim, with four lamps of up to 300 times its radiance), "showcase", or a path as above. None: the
///                image-based light that the model's file names, if it does. "sky": an object with "sun", "turbidity",
///                "groundAlbedo", "altitudeMeters", "disc" and "height" of SkyDesc, in place of "file".
///   Memory       built files are written once into the folder `work`; several processes may do so at once.
///   Thread       any.
///   Fails        errors of the builders and the file system. For a missing asset see missingFile().
#pragma once

#include "toolkit/scenes/SceneFile.h"

#include <filament_core/Box.h>

namespace filament_core::tools {

/// The folder for built files, and the folder of "asset:"; empty: none.
struct SceneFolders {
    std::filesystem::path work, assets;
};

/// The first missing file of a case; empty: none is missing.
std::string missingFile(SceneSpec const& spec, std::filesystem::path const& assets);

Result<std::filesystem::path> modelFile(SceneSpec const& spec, SceneFolders const& folders);
/// Empty: the case names no environment.
Result<std::filesystem::path> environmentFile(SceneSpec const& spec, SceneFolders const& folders);

/// The lights of the case at their final positions, with its origin added; none has its profile.
std::vector<LightDesc> placedLights(SceneSpec const& spec);
/// The file of the profile of a light; empty: none.
std::filesystem::path profileFile(SceneSpec const& spec, size_t light, SceneFolders const& folders);
/// The image of a light; without a file: none.
LightImageFile imageFile(SceneSpec const& spec, size_t light, SceneFolders const& folders);
/// Adds the lights of the case, with their profiles and images.
Result<void> addLights(Engine& engine, Scene& scene, SceneSpec const& spec, SceneFolders const& folders);
/// Adds the irradiance grids of the case, with its origin.
Result<void> addGrids(Scene& scene, SceneSpec const& spec, SceneFolders const& folders);
/// The transform of each copy of the model.
std::vector<double4x4> placedCopies(SceneSpec const& spec);
/// `bounds`: of the whole scene, for a case without a camera.
Camera cameraOf(SceneSpec const& spec, Box const& bounds);

} // namespace filament_core::tools
