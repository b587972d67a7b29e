// SPDX-License-Identifier: Apache-2.0
/// SceneFileRun: draws a scene file (docs/scene-files.md) instead of the model, the light and the view of a command
/// line.
///   In      Options::model, a .json, and Options::sceneEdits: keys and values for SceneFile::set().
///   Thread  one run at a time.
///   Fails   errors of the file and of what it names; DeviceUnavailable.
#pragma once

#include "tools/filament-render/BackendRun.h"

namespace filament_core::tools {

bool isSceneFile(std::filesystem::path const& file);
Result<BackendRun> runSceneFile(Options const& options, Backend backend);

} // namespace filament_core::tools
