// SPDX-License-Identifier: Apache-2.0
/// Atlas: the surfaces of a scene as charts in square images of one size, its pages.
///   In      surfaces in world space; texels per metre, and how large the image may become.
///   Out     for each surface its vertices anew (those on the border of several charts once for each), with texture
///           coordinates in [0, 1]^2, row 0 at v = 0.
///   Levels  the box of a chart, with its padding, begins and ends at whole texels of the coarsest level, and has half
///           such a texel of padding at least: bilinear filtering at any level reads texels of one box alone.
///   Pages   as few as hold the charts. Where one number is asked for a row, pages lie below each other: row y is row
///           y % side of page y / side. A chart lies on one page; a surface may lie on several.
///   Fails   InvalidArgument if the charts do not fit: it names the density at which they may.
///   Thread  makeAtlas(): any; surfaces are cut in parallel. The same atlas for any number of workers.
#pragma once

#include "base/Result.h"
#include "base/math/Math.h"
#include "jobsystem/JobSystem.h"
#include "tools/bake/Charts.h"

#include <span>
#include <vector>

namespace filament_core::bake {

inline constexpr uint32_t kPadding = 2;    ///< texels around each chart, at least
inline constexpr uint32_t kMostLevels = 6; ///< padding of 16 texels

/// Texels around each chart, for so many levels.
constexpr uint32_t paddingOf(uint32_t levels) { return levels < 4 ? kPadding : 1u << (levels - 2); }

/// One primitive at one node.
struct BakeSurface {
    std::vector<double3> positions; ///< world, metres
    std::vector<double3> normals;   ///< world, unit; empty: those of the faces
    std::vector<uint32_t> indices;  ///< three for each triangle, counter-clockwise from its front
};

struct AtlasSurface {
    std::vector<uint32_t> sources; ///< by new vertex: the vertex of the BakeSurface
    std::vector<float2> uvs;       ///< by new vertex
    std::vector<uint32_t> indices; ///< new vertices, in the order of the surface's triangles
    std::vector<uint32_t> pages;   ///< by triangle
};

/// Where a chart is.
struct AtlasChart {
    uint32_t surface = 0;
    uint2 place{ 0 }, size{ 0 }; ///< texels, with the padding; the row counts all pages
    uint2 inner{ 0 };            ///< texels without it
    uint32_t padding = kPadding;
    Chart chart;      ///< corners in metres
    double scale = 1; ///< of its density: times Atlas::texelsPerMeter
    /// In texels of all pages.
    double2 corner(size_t i, double texelsPerMeter) const {
        return double2(place) + double(padding) + chart.corners[i] * (texelsPerMeter * scale);
    }
};

struct Atlas {
    uint32_t side = 0; ///< texels; a multiple of those of a texel of the coarsest level
    uint32_t pages = 1;
    uint32_t levels = 1; ///< for which charts are padded
    double texelsPerMeter = 0;
    std::vector<AtlasChart> charts;     ///< of the first surface first
    std::vector<AtlasSurface> surfaces; ///< as many as there were
};

struct AtlasOptions {
    double texelsPerMeter = 16;
    uint32_t maxSide = 4096; ///< of a page
    uint32_t maxPages = 1;
    uint32_t levels = 1; ///< [1, kMostLevels]
    ChartOptions charts{};
    std::vector<double> scales{}; ///< AtlasChart::scale of each chart (Densities.h); empty: 1
};

Result<Atlas> makeAtlas(std::span<const BakeSurface> surfaces, AtlasOptions const& options, jobs::JobSystem& jobs);

} // namespace filament_core::bake
