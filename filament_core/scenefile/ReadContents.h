// SPDX-License-Identifier: Apache-2.0
/// readContents: the tree of a scene file as values. docs/scene-files.md describes the keys.
///   Fails   InvalidArgument: `where`, key, what is valid there; Unsupported: a newer version.
///   Thread  any; pure.
#pragma once

#include "filament_core/scenefile/JsonReader.h"

#include <filament_core/SceneFile.h>

namespace filament_core::scenefile {

Result<SceneFileContents> readContents(Json const& tree, std::string const& where);
/// The JSON schema of what readContents() reads, with its head.
Json sceneSchema();

} // namespace filament_core::scenefile
