// SPDX-License-Identifier: Apache-2.0
/// DocumentScene: what a document shows as a scene file, for the library and the other programs (docs/scene-files.md).
///   Out     the file, and in words what it cannot hold: edits of the model, bookmarks, camera paths.
///   Fails   InvalidArgument: the part that no scene file takes.
///   Thread  any.
#pragma once

#include "tools/view/document/Document.h"

#include <filament_core/SceneFile.h>

#include <string>
#include <vector>

namespace filament_core::view {

struct DocumentScene {
    SceneFile file{};
    std::vector<std::string> missing{}; ///< "edits of materials"
};

/// `prefersModels` of the environment: names no file, so that the model's own comes first. `modelHasLight`: whether it
/// has one.
Result<DocumentScene> sceneOf(Document const& document, bool modelHasLight);

} // namespace filament_core::view
