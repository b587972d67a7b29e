// SPDX-License-Identifier: Apache-2.0
/// GltfFile: --save-gltf of filament-render.
///   Out     the file, with the camera of the picture as "view". Warnings are printed.
///   Thread  the app thread.   Fails: as saveGltf().
#pragma once

#include "tools/filament-render/Options.h"

#include <filament_core/Scene.h>

namespace filament_core::tools {

/// Nothing without the option, and for other backends than the first: all have the same scene. `environment`: names it.
Result<void> saveGltfFile(Options const& options, Backend backend, Scene const& scene, Camera const& camera,
                          std::string const& environment);

} // namespace filament_core::tools
