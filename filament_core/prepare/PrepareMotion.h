// SPDX-License-Identifier: Apache-2.0
/// prepareMotion: which opaque objects in view did not stay where they were, so that the motion of the camera alone
/// does not give their motion vectors.
///   In      the main view, and the previous frame.
///   Out     a view of kind Motion: these objects, each with two records: now, and the frame before. Those of one draw
///           of the image are instances here. What moves them: transform, skin, morph targets, a vertex block that
///           reads the time, a place in the view of a camera that moved.
///   Thread  the app thread.   Memory: the arena.   Bits: the order of the main view.   Fails: std::bad_alloc.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/LastFrame.h"

namespace filament_core::prepare {

struct PreparedMotion {
    ViewPacket view;                 ///< no draws: nothing moved
    std::span<const uint32_t> slots; ///< of Deformations that moved, or whose objects did
};

PreparedMotion prepareMotion(Arena& arena, scene::SceneData const& scene, ViewPacket const& main, LastFrame const& last,
                             LastView const& seen);

/// Appends the state of `slots` in the previous frame to `list`.
void placeLastDeformations(Arena& arena, scene::SceneData const& scene, std::span<const uint32_t> slots,
                           LastFrame const& last, DeformationList& list);

} // namespace filament_core::prepare
