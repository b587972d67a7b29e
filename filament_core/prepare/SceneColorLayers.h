// SPDX-License-Identifier: Apache-2.0
/// sceneColorLayers: the copies of the scene colour for refraction, and the draws over each copy.
///   Thread  any; pure.   Memory: the arena.   Fails: never.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/FramePacket.h"
#include "filament_core/prepare/ViewConstants.h"
#include "filament_core/scene/Renderables.h"

#include <span>

namespace filament_core::prepare {

/// In the order of drawing: as many as Quality::refractionLayers says, or as objects refract, if these are fewer. Over
/// the first lie all objects that have none of their own, over the last also transparent ones.
///   order    all that is drawn, in order: refracting objects from back to front if there may be several copies
///   blended  ViewPacket::blended, made from `order`
std::span<const SceneColorCopy> sceneColorLayers(Arena& arena, scene::Renderables const& renderables,
                                                 std::span<const SortItem> order, std::span<const DrawCall> blended,
                                                 ViewSpace const& space, uint2 view, uint32_t mostLayers);

} // namespace filament_core::prepare
