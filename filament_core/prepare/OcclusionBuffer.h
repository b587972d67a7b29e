// SPDX-License-Identifier: Apache-2.0
/// OcclusionBuffer: the depth of large triangles in a view, drawn by the CPU, and which boxes lie behind it: drawing
/// those changes nothing. Every pixel of the view is tested at its centre, where a device with one sample a pixel
/// shades (Vulkan 1.3, section 28.8; OpenGL ES 3.2, section 13.7); so nothing is missed between coarse cells, as
/// conservative buffers of few pixels do (Hasselgren, Andersson and Akenine-Moller 2016, "Masked Software Occlusion
/// Culling", whose tiles of farthest depths are these).
///   In      triangles that the device draws without holes, and boxes that contain what it draws.
///   Bits    the same for any number of workers: a pixel keeps the nearest of its depths, in whatever order they come.
///   Exact   an edge beyond which nothing of its mesh is drawn loses kMarginPixels, and so does depth along its slope,
///           because devices round corners to 1/256 pixel. A box counts as hidden only if the pixels around it are
///           covered, too. Triangles that the device may cut (at the near plane, or beyond its guard band) lose the
///           margin at all edges.
///   Thread  jobs over triangles and over rows.   Memory: the arena, 4 bytes a pixel.   Fails: std::bad_alloc.
#pragma once

#include "base/Arena.h"
#include "base/math/Math.h"
#include "filament_core/scene/Affine.h"
#include "filament_core/scene/OccluderMesh.h"
#include "jobsystem/JobSystem.h"

#include <span>

namespace filament_core::prepare {

/// How far a device's depth may be from the exact one: by rounding matrices, interpolation and formats of 24 bits.
struct DepthError {
    float relative = 0, absolute = 0;
};
inline constexpr DepthError kPerspectiveDepthError{ 2e-5f, 2e-7f };
/// Parallel depths are sums of terms of up to 1, whose rounding does not shrink with the sum.
inline constexpr DepthError kParallelDepthError{ 2e-5f, 1e-5f };
/// Of shadow maps of lamps, in floats: the near plane is so near that all depths are tiny.
inline constexpr DepthError kScaleFreeDepthError{ 1e-3f, 0 };

/// Which faces of an occluder are drawn, by the order of their corners on the screen.
enum class DrawnFaces : uint8_t { All, Front, Back };

struct PlacedOccluder {
    OccluderMesh const* mesh = nullptr;
    double4x4 clipFromObject{ 1.0 }; ///< reversed depth, row 0 of the image at y = -1
    DrawnFaces faces = DrawnFaces::Front;
    bool mirrored = false; ///< clipFromObject swaps front and back
};

class OcclusionBuffer {
public:
    static constexpr float kMarginPixels = 1.0f / 64;
    static constexpr uint32_t kTile = 8; ///< pixels, in both directions

    OcclusionBuffer(jobs::JobSystem& jobs, Arena& arena, uint2 size, std::span<const PlacedOccluder> occluders,
                    DepthError error = kPerspectiveDepthError);

    /// Whether all of a box, relative to the camera in world axes, lies behind occluders.
    bool hides(float4x4 const& clipFromWorld, float3 center, float3 halfExtent) const;
    /// How near what covers a pixel is: at least this, in reversed depth; 0: nothing covers it. For tests.
    float depthAt(uint2 pixel) const { return mDepths[size_t{ pixel.y } * mRow + pixel.x]; }

private:
    uint2 mSize;
    DepthError mError;
    uint32_t mRow; ///< pixels of a row in memory: whole tiles
    uint2 mTileCount;
    std::span<float> mDepths; ///< reversed: 0 is infinitely far
    std::span<float> mTiles;  ///< the farthest of each tile
};

} // namespace filament_core::prepare
