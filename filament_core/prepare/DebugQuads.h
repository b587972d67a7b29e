// SPDX-License-Identifier: Apache-2.0
/// debugQuads: what a DebugDraw holds, as rectangles in clip space.
///   Lines   rectangles around the part of a segment that is in front of the near plane and near the view, of constant
///           width in pixels. The depth is linear on the screen, as that of a triangle through both ends.
///   Text    a rectangle for each run of pixels of the font, on whole pixels.
///   Nearer  what is tested lies 2^-11 of its distance nearer than it is, so that outlines of surfaces are seen.
///   Bits    computed in double precision on the app thread: the same for all APIs.
///   Memory  the arena: 112 B a rectangle.   Fails: std::bad_alloc.
#pragma once

#include "base/Arena.h"
#include "filament_core/prepare/ViewInput.h"

#include <filament_core/DebugDraw.h>

#include <span>

namespace filament_core::prepare {

struct DebugVertex {
    float3 position{ 0 }; ///< clip space, w = 1
    float4 color{ 0 };    ///< multiplied by its alpha
};

struct DebugQuads {
    std::span<const DebugVertex> vertices; ///< four a rectangle, around it
    uint32_t tested = 0;                   ///< rectangles that surfaces hide; the others follow

    uint32_t count() const { return static_cast<uint32_t>(vertices.size() / 4); }
};

/// Of a view without jitter.
DebugQuads debugQuads(Arena& arena, DebugDraw const& draw, ViewInput const& view);

} // namespace filament_core::prepare
