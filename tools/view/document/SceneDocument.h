// SPDX-License-Identifier: Apache-2.0
/// SceneDocument: a scene file (docs/scene-files.md) as a document, to look at it and edit it.
///   Fails   Unsupported: what no document can show, by its key: several models or copies, objects, skies, images of
///           lights, captured probes, origins, overlays.
///   Thread  any.
#pragma once

#include "tools/view/document/Document.h"

#include <filament_core/SceneFile.h>

namespace filament_core::view {

Result<Document> documentOf(SceneFile const& file);

} // namespace filament_core::view
