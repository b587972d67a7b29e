// SPDX-License-Identifier: Apache-2.0
/// SceneFilePasses: "postProcess" of a scene file as passes of a view.
///   In      a package of domain postprocess, and its values as words: numbers separated by commas, "true", "false";
///           textures are image files.
///   Fails   NotFound: a parameter or constant that the material does not have, with the nearest one; InvalidArgument:
///           words that are not as many numbers as its type has. Errors of packages and images.
///   Thread  that of the engine.
#pragma once

#include "base/Result.h"

#include <filament_core/BuildScene.h>

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

namespace filament_core::scenebuild {

using ImagePath = std::function<Result<std::filesystem::path>(std::string const& name)>;

/// Appends the pass to those of the scene. `name`: of the material, for messages.
Result<void> addPass(Engine& engine, SceneFilePass const& pass, std::span<const std::byte> package,
                     std::string const& name, ImagePath const& imagePath, BuiltScene& built);

} // namespace filament_core::scenebuild
