// SPDX-License-Identifier: Apache-2.0
/// numberObjects: which object, material or material instance each draw of the main view belongs to, for the debug
/// views and AOVs that show it.
///   In      the packet, after all that chooses its draws.   Out: FramePacket::numbered, and DrawCall::firstField, so
///           that draws are recorded object by object, each with a record of its own: fragments find the number in its
///           center.w. Vertex stages, and the records of other frames, stay as they are.
///   Numbers from 1 on, exact up to 2^24. Of objects: 1 + the index of their handle. Of materials: their place among
///           those of the scene's renderables, in the order in which their first instances were made; so they depend on
///           the scene alone.
///   Memory  the arena: 512 B an object in view.   Thread: the app thread.   Fails: std::bad_alloc.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/FramePacket.h"

#include <optional>
#include <vector>

namespace filament_core::prepare {

void numberObjects(Arena& arena, scene::SceneData const& scene, FramePacket& packet);

/// Where the object of this number is among the scene's renderables; none: there is none.
std::optional<uint32_t> positionOf(scene::Renderables const& renderables, uint32_t object);

/// Those of the scene's renderables, in the order of their numbers.
std::vector<scene::MaterialInstance const*> instancesOf(scene::Renderables const& renderables);
std::vector<scene::Material const*> materialsOf(scene::Renderables const& renderables);

} // namespace filament_core::prepare
