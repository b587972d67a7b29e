// SPDX-License-Identifier: Apache-2.0
/// PixelGrid: which boxes are so small that no triangle inside of them can cover the centre of a pixel: drawing them
/// changes nothing. With one sample a pixel a device draws a triangle where it covers centres (Vulkan 1.3, section
/// 28.8; OpenGL ES 3.2, section 13.7).
///   In      boxes relative to the camera, in world axes, that contain all vertices.
///   Bits    the same on every CPU: Simd.h.
///   Margin  kMarginPixels on every side: for vertices that are rounded to 1/256 pixel, and for the rounding of their
///           matrices.
///   Thread  any; pure.   Memory: none.   Fails: never; a box that is not a number may cover anything.
///   Cost    mayMiss8(): 1 ns a box; missesAll(): bench/filament_core/prepare, cullSmall.
#pragma once

#include "base/math/Math.h"
#include "base/math/Simd.h"

#include <array>

namespace filament_core::prepare {

class PixelGrid {
public:
    static constexpr float kMarginPixels = 1.0f / 64;

    /// No box misses anything.
    PixelGrid() = default;
    PixelGrid(float4x4 const& clipFromWorld, uint2 size);

    /// Bit i: box i is at most about two pixels large, so that missesAll() may be true. Others are never tested.
    uint32_t mayMiss8(std::array<simd::Float8, 3> const& center, std::array<simd::Float8, 3> const& halfExtent) const;
    bool missesAll(float3 center, float3 halfExtent) const;

    bool isEmpty() const { return mSquaredScale == 0; }

private:
    float3 mX{ 0.0f }, mY{ 0.0f }, mW{ 0.0f }; // rows of clipFromWorld
    float3 mOffset{ 0.0f };                    // what they add, in the same order
    float2 mHalfSize{ 0.0f };                  // pixels
    float mSquaredScale = 0;                   // radius in pixels = scale * metres / w; 0: nothing misses
};

} // namespace filament_core::prepare
