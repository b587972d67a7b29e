// SPDX-License-Identifier: Apache-2.0
/// makeLineQuads: lines with a width in pixels, as triangles that a material with `wideLines : true` spreads.
///   Why     both APIs draw PrimitiveType::Lines one pixel wide; wider lines of their own are optional features.
///   Draws   every segment as a rectangle: constant width on the screen, ends cut off squarely, no joints in a strip.
///           The vertex block sets the width: `material.lineWidth`, in pixels, at most 1024; 1 by default; 0, negative
///           and NaN draw nothing. A block that moves `material.worldPosition` moves `material.lineEnd` likewise.
///   Limits  no bones or morph targets. Culling takes the box of the points: set RenderableDesc::culled to false, or
///           enlarge the box, if a line may lie just outside of the view. Mirrored objects need `culling : none`.
///   Thread  any; pure.
#pragma once

#include <filament_core/Format.h>
#include <filament_core/Math.h>
#include <filament_core/Objects.h>

#include <cstdint>
#include <span>
#include <vector>

namespace filament_core {

struct LineVertex {
    float3 position{ 0 }; ///< one end of the segment
    float4 color{ 1 };    ///< Attribute::Color, linear
    float4 otherEnd{ 0 }; ///< Attribute::Custom0; xyz: the other end, w: +1 or -1, the side
};

/// Four vertices and two triangles a segment, in the order of the segments.
struct LineQuads {
    std::vector<LineVertex> vertices;
    std::vector<uint32_t> indices;

    /// Refer to the vectors above; for Engine::create() while they live.
    VertexBufferDesc vertexBuffer() const;
    IndexBufferDesc indexBuffer() const;
};

/// `points`: two a segment for PrimitiveType::Lines (a last one without partner is ignored), one after the other for
/// LineStrip; other primitives are a bug of the caller. `colors`: linear, one a point; none: white. At most 2^30
/// segments. May throw std::bad_alloc.
LineQuads makeLineQuads(std::span<const float3> points, PrimitiveType primitive, std::span<const float4> colors = {});

} // namespace filament_core
