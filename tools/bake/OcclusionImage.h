// SPDX-License-Identifier: Apache-2.0
/// OcclusionImage: baked ambient occlusion as glTF stores it (docs/baking.md).
///   Out     RGBA8, one level, the pages below each other: red is the visible part of the hemisphere, 0 to 255. Green
///           and blue are the mean open direction along u and against v, in the plane of the normal: codes 1 to 255 for
///           -1 to 1, 128 for none.
///   Levels  loaders make the smaller ones. Those for which the charts are padded mix texels of one chart alone.
///   Filled  as LightmapImage.h does; between charts the mean of all, which still smaller levels mix in.
///   Thread  any; pure.
#pragma once

#include "tools/bake/LightmapImage.h"

namespace filament_core::bake {

struct OcclusionImage {
    LightmapImage visible;        ///< what red says, in all four components; of intensity 1 and one level
    std::vector<std::byte> rgba8; ///< row 0 at v = 0
};

OcclusionImage makeOcclusionImage(std::span<const BakeSurface> surfaces, Atlas const& atlas,
                                  std::span<const AtlasTexel> texels, std::span<const TexelLight> lights);

/// Axes of a texture at a point of a surface: along u, and against v, unit and at right angles to the normal.
struct TextureFrame {
    double3 right{ 1, 0, 0 }, up{ 0, 1, 0 }, normal{ 0, 0, 1 };
};
TextureFrame frameOf(BakeSurface const& surface, AtlasSurface const& placed, AtlasTexel const& texel);

} // namespace filament_core::bake
