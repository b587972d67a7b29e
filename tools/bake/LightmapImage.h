// SPDX-License-Identifier: Apache-2.0
/// LightmapImage: baked texels as an image that the engine samples.
///   Out     RGBA16F with the levels of the atlas: irradiance over `intensity`, and in alpha the part of the sky that
///           is seen. The intensity is a power of two at which the brightest texel lies below 2^kTopExponent: so halves
///           keep ten bits of every texel down to 2^-29 of that.
///   Filled  texels that mostly see backs of surfaces, as inside of walls, and those that no surface has: from the
///           nearest texels of the same chart, ring by ring, each the mean of its neighbours that have light.
///   Levels  a texel is the mean of the light of the surface that it covers: texels of level 0 count whose centres lie
///           on their chart and whose light was traced. Where it covers none, it is the mean of the filled ones.
///   Thread  any; pure.
#pragma once

#include "filament_core/assets/image/Image.h"
#include "tools/bake/BakeLight.h"

namespace filament_core::bake {

inline constexpr double kMostBacks = 0.5; ///< a texel that sees more of them is filled
inline constexpr int kTopExponent = 14;

struct LightmapImage {
    uint32_t side = 0; ///< of a page
    uint32_t pages = 1;
    std::vector<double4> texels;               ///< lux, and openness; row 0 at v = 0; of all pages, below each other
    std::vector<std::vector<double4>> smaller; ///< levels 1, 2, ...
    double intensity = 1;                      ///< lux
    uint64_t hidden = 0;                       ///< texels that see backs
    uint64_t filled = 0;                       ///< of charts, hidden ones among them
};

LightmapImage makeImage(Atlas const& atlas, std::span<const AtlasTexel> texels, std::span<const TexelLight> lights);

/// A lightmap that shows the charts instead of light: a colour for each, texels as a checkerboard, padding darker. The
/// levels below the first are red, green, blue, yellow and violet. The mean is about `lux`, so that the exposure of the
/// light suits it. Openness is 1.
LightmapImage makeChartImage(Atlas const& atlas, double lux);

/// As RGBA16F, all levels, with the pages below each other.
assets::Image halvesOf(LightmapImage const& image);
/// One of these pages.
assets::Image onePage(assets::Image const& all, uint32_t page);
/// What bilinear filtering finds at a place of its first level, in texels; over the intensity.
double4 lookUp(assets::Image const& halves, double2 place);
/// RGBA8 sRGB, brightest at 1: for reports. Pages below each other.
std::vector<std::byte> previewOf(LightmapImage const& image);

} // namespace filament_core::bake
