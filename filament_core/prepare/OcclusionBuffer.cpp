// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/OcclusionBuffer.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace filament_core::prepare {
namespace {

constexpr size_t kOccludersOfJob = 8;
constexpr size_t kTileRowsOfJob = 2;
// Devices draw what reaches farther than this by cutting it, which rounds its edges anew. Mesa's begins at 2^15 pixels.
constexpr double kGuardBandPixels = 1 << 14;
// Devices add depths up from such terms in floats.
constexpr double kRounding = 4.0 / (1 << 24);

/// A triangle on the screen.
struct ScreenTriangle {
    std::array<double, 3> x, y;               ///< pixels; inside is where all edge functions are positive
    std::array<double, 3> margin;             ///< by which an edge function has to be larger
    double depth = 0, depthX = 0, depthY = 0; ///< at (0, 0), and what a pixel to the right and down adds
    int32_t top = 0, end = 0;                 ///< rows with centres inside
};

struct ClipCorner {
    double4 at{ 0.0 };
    bool isOpen = false; ///< nothing is drawn beyond the edge to the next corner
};

/// At most one corner more than a triangle has.
struct ClipPolygon {
    std::array<ClipCorner, 4> corners;
    uint32_t count = 0;
    void add(ClipCorner const& corner) { corners[count++] = corner; }
};

/// Sutherland and Hodgman 1974, against the near plane: z <= w.
ClipPolygon inFrontOfNear(std::array<ClipCorner, 3> const& triangle) {
    ClipPolygon polygon;
    for (uint32_t i = 0; i < 3; ++i) {
        ClipCorner const& from = triangle[i];
        ClipCorner const& to = triangle[(i + 1) % 3];
        const double a = from.at.w - from.at.z, b = to.at.w - to.at.z;
        if (a >= 0) polygon.add(from);
        if ((a >= 0) == (b >= 0)) continue;
        // A cut that leaves the front begins the edge along the near plane.
        polygon.add({ from.at + (to.at - from.at) * (a / (a - b)), a >= 0 || from.isOpen });
    }
    return polygon;
}

/// Olano and Greer 1997, "Triangle Scan Conversion using 2D Homogeneous Coordinates": the sign of this determinant is
/// the side that is seen, also of triangles that are partly behind the camera. Positive: clockwise with y down.
double facing(double4 const& a, double4 const& b, double4 const& c) {
    return a.x * (b.y * c.w - c.y * b.w) - b.x * (a.y * c.w - c.y * a.w) + c.x * (a.y * b.w - b.y * a.w);
}

class OccluderSetup {
public:
    OccluderSetup(PlacedOccluder const& occluder, uint2 size) : mOccluder(occluder), mSize(size) {}

    /// `clip`: room for the corners. `drawn`: for one byte a triangle. Returns how many it wrote to `out`.
    uint32_t write(std::span<double4> clip, std::span<uint8_t> drawn, ScreenTriangle* out) const {
        OccluderMesh const& mesh = *mOccluder.mesh;
        for (size_t i = 0; i < mesh.positions.size(); ++i)
            clip[i] = mOccluder.clipFromObject * double4(double3(mesh.positions[i]), 1);
        // All sides come first: whether an edge is open depends on whether the triangle beyond it is drawn.
        for (size_t i = 0; i < mesh.triangles.size(); ++i) {
            auto const& corners = mesh.triangles[i].corners;
            drawn[i] = isDrawn(facing(clip[corners[0]], clip[corners[1]], clip[corners[2]]));
        }
        uint32_t count = 0;
        for (size_t i = 0; i < mesh.triangles.size(); ++i) {
            if (drawn[i]) count += add(mesh.triangles[i], clip, drawn, out + count);
        }
        return count;
    }

private:
    bool isDrawn(double side) const {
        if (mOccluder.faces == DrawnFaces::All) return side != 0;
        // Front faces are counter-clockwise in the world, where y is up.
        const bool wantsPositive = (mOccluder.faces == DrawnFaces::Front) == mOccluder.mirrored;
        return wantsPositive ? side > 0 : side < 0;
    }

    uint32_t add(OccluderMesh::Triangle const& triangle, std::span<const double4> clip, std::span<const uint8_t> drawn,
                 ScreenTriangle* out) const {
        std::array<ClipCorner, 3> corners;
        bool isCut = false;
        for (uint32_t i = 0; i < 3; ++i) {
            const uint16_t neighbor = triangle.neighbors[i];
            corners[i] = { clip[triangle.corners[i]], neighbor == OccluderMesh::kNone || !drawn[neighbor] };
            if (!(corners[i].at.z > 0)) return 0; // at the far plane
            isCut = isCut || corners[i].at.z > corners[i].at.w;
        }
        if (isCut)
            for (ClipCorner& corner : corners) corner.isOpen = true;
        const ClipPolygon polygon = inFrontOfNear(corners);
        uint32_t count = 0;
        for (uint32_t i = 1; i + 1 < polygon.count; ++i) {
            // The edges between the triangles of the fan are not open: the device draws one polygon.
            const std::array fan{ polygon.corners[0], polygon.corners[i], polygon.corners[i + 1] };
            const std::array open{ i == 1 && fan[0].isOpen, fan[1].isOpen, i + 2 == polygon.count && fan[2].isOpen };
            count += project({ fan[0].at, fan[1].at, fan[2].at }, open, out[count]);
        }
        return count;
    }

    bool project(std::array<double4, 3> const& clip, std::array<bool, 3> open, ScreenTriangle& out) const {
        std::array<double, 3> z;
        bool isHuge = false;
        for (uint32_t i = 0; i < 3; ++i) {
            out.x[i] = (clip[i].x / clip[i].w * 0.5 + 0.5) * mSize.x;
            out.y[i] = (clip[i].y / clip[i].w * 0.5 + 0.5) * mSize.y;
            z[i] = clip[i].z / clip[i].w;
            if (!std::isfinite(out.x[i]) || !std::isfinite(out.y[i]) || !std::isfinite(z[i])) return false;
            isHuge = isHuge || std::max(std::abs(out.x[i]), std::abs(out.y[i])) > kGuardBandPixels;
        }
        const double abX = out.x[1] - out.x[0], abY = out.y[1] - out.y[0];
        const double acX = out.x[2] - out.x[0], acY = out.y[2] - out.y[0];
        const double area = abX * acY - acX * abY;
        if (area == 0) return false;
        out.depthX = ((z[1] - z[0]) * acY - (z[2] - z[0]) * abY) / area;
        out.depthY = ((z[2] - z[0]) * abX - (z[1] - z[0]) * acX) / area;
        constexpr double kMargin = OcclusionBuffer::kMarginPixels;
        const double slope = (std::abs(out.depthX) + std::abs(out.depthY)) * kMargin;
        out.depth = z[0] - out.depthX * out.x[0] - out.depthY * out.y[0];
        const double terms = std::abs(out.depth) + std::abs(out.depthX) * mSize.x + std::abs(out.depthY) * mSize.y;
        out.depth -= slope + terms * kRounding;
        if (area < 0) { // edge functions are positive inside
            std::swap(out.x[1], out.x[2]), std::swap(out.y[1], out.y[2]);
            std::swap(open[0], open[2]);
        }
        for (uint32_t i = 0; i < 3; ++i) {
            const uint32_t next = (i + 1) % 3;
            const double length = std::abs(out.x[next] - out.x[i]) + std::abs(out.y[next] - out.y[i]);
            out.margin[i] = open[i] || isHuge ? length * kMargin : 0;
        }
        const auto [top, bottom] = std::ranges::minmax(out.y);
        out.top = static_cast<int32_t>(std::clamp(std::ceil(top - 0.5), 0.0, double(mSize.y)));
        out.end = static_cast<int32_t>(std::clamp(std::floor(bottom - 0.5) + 1, 0.0, double(mSize.y)));
        return out.top < out.end;
    }

    PlacedOccluder const& mOccluder;
    uint2 mSize;
};

/// Draws row `y`, whose `width` depths begin at `row`.
void drawRow(ScreenTriangle const& triangle, int32_t y, uint32_t width, DepthError error, float* row) {
    const double middle = y + 0.5;
    double left = 0.5, right = width - 0.5; // centres
    for (uint32_t i = 0; i < 3; ++i) {
        const uint32_t next = (i + 1) % 3;
        const double dx = triangle.x[next] - triangle.x[i], dy = triangle.y[next] - triangle.y[i];
        // dx * (middle - y) - dy * (x - x of the corner) >= margin
        const double rest = dx * (middle - triangle.y[i]) + dy * triangle.x[i] - triangle.margin[i];
        if (dy > 0) right = std::min(right, rest / dy);
        if (dy < 0) left = std::max(left, rest / dy);
        if (dy == 0 && rest < 0) return;
    }
    // Before they become integers: beside an edge that is nearly level, `left` may be larger than any.
    if (!(left <= right)) return;
    const auto first = static_cast<int32_t>(std::ceil(left - 0.5)),
               last = static_cast<int32_t>(std::floor(right - 0.5));
    if (first > last) return;
    const double begin = triangle.depth + triangle.depthX * (first + 0.5) + triangle.depthY * middle;
    const auto depth = static_cast<float>(begin), step = static_cast<float>(triangle.depthX);
    for (int32_t i = 0; i <= last - first; ++i) {
        // A product for each pixel: the error of a running sum would grow along the row.
        const float here = (depth + step * static_cast<float>(i)) * (1 - error.relative) - error.absolute;
        row[first + i] = std::max(row[first + i], here);
    }
}

uint32_t tilesFor(uint32_t pixels) { return (pixels + OcclusionBuffer::kTile - 1) / OcclusionBuffer::kTile; }

} // namespace

OcclusionBuffer::OcclusionBuffer(jobs::JobSystem& jobs, Arena& arena, uint2 size,
                                 std::span<const PlacedOccluder> occluders, DepthError error)
        : mSize(size), mError(error), mRow(tilesFor(size.x) * kTile), mTileCount{ tilesFor(size.x), tilesFor(size.y) },
          mDepths(arena.arrayForOverwrite<float>(size_t{ mRow } * mTileCount.y * kTile)),
          mTiles(arena.arrayForOverwrite<float>(size_t{ mTileCount.x } * mTileCount.y)) {
    const auto firstCorners = arena.arrayForOverwrite<uint32_t>(occluders.size());
    const auto firstTriangles = arena.arrayForOverwrite<uint32_t>(occluders.size());
    const auto counts = arena.arrayForOverwrite<uint32_t>(occluders.size());
    uint32_t corners = 0, triangles = 0;
    for (size_t i = 0; i < occluders.size(); ++i) {
        firstCorners[i] = corners, firstTriangles[i] = triangles;
        corners += static_cast<uint32_t>(occluders[i].mesh->positions.size());
        triangles += static_cast<uint32_t>(occluders[i].mesh->triangles.size());
    }
    const auto clip = arena.arrayForOverwrite<double4>(corners);
    const auto drawn = arena.arrayForOverwrite<uint8_t>(triangles);
    const auto screen =
            arena.arrayForOverwrite<ScreenTriangle>(2 * size_t{ triangles }); // the near plane makes two of one
    jobs::parallelFor<"occluders">(jobs, occluders.size(), kOccludersOfJob, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            counts[i] = OccluderSetup(occluders[i], mSize)
                                .write(clip.subspan(firstCorners[i]), drawn.subspan(firstTriangles[i]),
                                       &screen[2 * size_t{ firstTriangles[i] }]);
    });

    jobs::parallelFor<"occlusion">(jobs, mTileCount.y, kTileRowsOfJob, [&](size_t begin, size_t end) {
        const auto top = static_cast<int32_t>(begin * kTile), bottom = static_cast<int32_t>(end * kTile);
        // Each job visits all triangles and draws their part in its own rows: no two jobs write to the same pixel.
        std::ranges::fill(mDepths.subspan(begin * kTile * mRow, (end - begin) * kTile * mRow), 0.0f);
        for (size_t i = 0; i < occluders.size(); ++i) {
            for (ScreenTriangle const& triangle : screen.subspan(2 * size_t{ firstTriangles[i] }, counts[i])) {
                for (int32_t y = std::max(top, triangle.top); y < std::min(bottom, triangle.end); ++y)
                    drawRow(triangle, y, mSize.x, mError, &mDepths[static_cast<size_t>(y) * mRow]);
            }
        }
        for (size_t row = begin; row < end; ++row) {
            for (uint32_t column = 0; column < mTileCount.x; ++column) {
                float farthest = 1e30f;
                // Pixels beside the view hide nothing and show nothing.
                const size_t endY = std::min<size_t>((row + 1) * kTile, mSize.y);
                const uint32_t endX = std::min((column + 1) * kTile, mSize.x);
                for (size_t y = row * kTile; y < endY; ++y)
                    for (uint32_t x = column * kTile; x < endX; ++x)
                        farthest = std::min(farthest, mDepths[y * mRow + x]);
                mTiles[row * mTileCount.x + column] = farthest;
            }
        }
    });
}

bool OcclusionBuffer::hides(float4x4 const& clipFromWorld, float3 center, float3 halfExtent) const {
    const float4 middle = clipFromWorld * float4(center, 1);
    const std::array axes{ clipFromWorld[0] * halfExtent.x, clipFromWorld[1] * halfExtent.y,
                           clipFromWorld[2] * halfExtent.z };
    float2 least(1e30f), most(-1e30f);
    float nearest = 0;
    for (uint32_t corner = 0; corner < 8; ++corner) {
        const float4 at = middle + axes[0] * (corner & 1 ? 1.0f : -1.0f) + axes[1] * (corner & 2 ? 1.0f : -1.0f) +
                          axes[2] * (corner & 4 ? 1.0f : -1.0f);
        if (!(at.z < at.w)) return false; // at the near plane, behind the camera, or not a number
        const float2 place = float2(at) / at.w;
        least = glm::min(least, place), most = glm::max(most, place);
        nearest = std::max(nearest, at.z / at.w);
    }
    nearest = nearest * (1 + mError.relative) + mError.absolute;
    const float2 size(mSize);
    const float2 from = (least * 0.5f + 0.5f) * size - 1.5f, to = (most * 0.5f + 0.5f) * size + 1.5f;
    if (!(from.x < size.x && from.y < size.y && to.x > 0 && to.y > 0)) return false;
    const auto tileOf = [](float pixel, uint32_t tiles) {
        return std::min(static_cast<uint32_t>(std::max(pixel, 0.0f)) / kTile, tiles - 1);
    };
    const uint32_t left = tileOf(from.x, mTileCount.x), right = tileOf(std::min(to.x, size.x), mTileCount.x);
    const uint32_t top = tileOf(from.y, mTileCount.y), bottom = tileOf(std::min(to.y, size.y), mTileCount.y);
    for (uint32_t y = top; y <= bottom; ++y) {
        for (uint32_t x = left; x <= right; ++x) {
            if (!(nearest < mTiles[size_t{ y } * mTileCount.x + x])) return false;
        }
    }
    return true;
}

} // namespace filament_core::prepare
