// SPDX-License-Identifier: Apache-2.0
/// Report: what a bake wrote, for people and for programs: report.json, report.md, and of each page lightmap.png or
/// occlusion.png, and error.png.
///   Image   the lightmap, or OcclusionImage::visible. What is stored: of occlusion StoredLightmap::read alone.
///   Out     the same bytes for the same bake.
///   Fails   Unreadable with the path.
#pragma once

#include "tools/bake/BakeScene.h"
#include "tools/bake/LightmapImage.h"

namespace filament_core::bake {

/// Of one chart.
struct ChartSummary {
    uint32_t texels = 0;
    uint32_t hidden = 0;      ///< of them, that see backs of surfaces: the light of the others alone counts
    double meanLux = 0;       ///< luminance
    double relativeError = 0; ///< root mean square of the texels' standard errors, over the mean
    double samples = 0;       ///< a texel

    uint32_t seen() const { return texels - hidden; }
    double errorLux() const { return relativeError * meanLux; }
};
std::vector<ChartSummary> summarize(Atlas const& atlas, std::span<const AtlasTexel> texels,
                                    std::span<const TexelLight> lights);

/// What a report says in numbers.
struct LightmapReport {
    bool isLight = true; ///< false: ambient occlusion, and "lux" in names means the visible part of the hemisphere
    std::vector<ChartSummary> charts;
    ChartSummary whole; ///< of all of them
    HeldOutReport heldOut;
};
/// `lights`: of the texels, then of the held-out points.
LightmapReport reportOf(Options const& options, BakeScene const& bake, std::span<const TexelLight> lights,
                        LightmapImage const& image, StoredLightmap const& stored);
const char* titleOf(LightmapReport const& report);
/// A few lines.
std::string summaryOf(Options const& options, BakeScene const& bake, LightmapImage const& image,
                      StoredLightmap const& stored, LightmapReport const& report);
/// RGBA8 of the texels' standard errors; white is a tenth of `meanLux`.
std::vector<std::byte> errorPicture(BakeScene const& bake, std::span<const TexelLight> lights, double meanLux);
/// RGBA8 of OcclusionImage::visible: white is all of the hemisphere.
std::vector<std::byte> greysOf(LightmapImage const& visible);

/// Of a page: "lightmap.png", "lightmap-1.png", ...
std::string pictureName(const char* stem, uint32_t page);
/// One for each page into Options::out; `pixels`, RGBA8, has them below each other.
Result<void> writePictures(Options const& options, const char* stem, LightmapImage const& image,
                           std::vector<std::byte> const& pixels);

/// `lights`: as of reportOf().
Result<void> writeReport(Options const& options, BakeScene const& bake, std::span<const TexelLight> lights,
                         LightmapImage const& image, StoredLightmap const& stored);

} // namespace filament_core::bake
