// SPDX-License-Identifier: Apache-2.0
/// SceneFileParts: the parts of a scene file as objects of an engine, once their files are found. For buildScene(), and
/// for programs that keep what several scenes load.
///   Thread  that of the engine.
///   Fails   errors of loading and capturing.
#pragma once

#include "base/Result.h"

#include <filament_core/Engine.h>
#include <filament_core/Environment.h>
#include <filament_core/LightProfile.h>
#include <filament_core/Scene.h>
#include <filament_core/SceneFile.h>

#include <filesystem>
#include <map>
#include <utility>

namespace filament_core::scenebuild {

/// Adds lights to a scene, and loads each of their files once.
class SceneFileLights {
public:
    SceneFileLights(Engine& engine, Scene& scene) : mEngine(engine), mScene(scene) {}
    /// Empty paths: none. The light is in its final place.
    Result<void> add(LightDesc light, std::filesystem::path const& profile, std::filesystem::path const& image,
                     LightImageShape shape);

private:
    Engine& mEngine;
    Scene& mScene;
    std::map<std::filesystem::path, Owned<LightProfile>> mProfiles; ///< lights keep what they need of them
    std::map<std::pair<std::filesystem::path, LightImageShape>, Owned<LightImage>> mImages;
};

/// Adds to the place of a light, or to that of anything with `centerWorld`.
void moveBy(double3 const& meters, LightDesc& light);
/// `file`: that of the grid; empty: it has its probes.
Result<IrradianceGridDesc> readSceneGrid(SceneFileGrid const& grid, std::filesystem::path const& file);
/// What the engine sees from the place of a probe, filtered. `view`: as it is drawn; multiplies the place's intensity.
Result<Environment> captureSceneProbe(Engine& engine, Scene const& scene, ReflectionProbeDesc& place, View const& view,
                                      EnvironmentLoadOptions const& options);
/// Without an eye: from the front, slightly from the right and above, with all of `bounds` in view.
Camera cameraOf(SceneFileCamera const& camera, double3 const& origin, Exposure const& exposure, Box const& bounds);

} // namespace filament_core::scenebuild
