// SPDX-License-Identifier: Apache-2.0
/// Textures: the images of the showcase, generated from formulas. All of them tile.
///   Out     RGBA8 pixels, row 0 at the top. Colours are sRGB codes; normals point along +Z, +Y up in the image
///           (glTF's convention); surface maps hold roughness in G and metalness in B.
///   Thread  any; pure functions.  Cost: 20 to 60 ms for 512 x 512 texels on one core.
#pragma once

#include "base/math/Math.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace filament_core::showcase {

struct Picture {
    uint32_t size = 0; ///< width and height
    std::vector<std::byte> pixels;
};

/// The appearance of a surface; images that it does not need are empty.
struct TextureSet {
    Picture color, normal, surface, emission;
};

TextureSet brickTextures(uint32_t size);        ///< color, normal, surface: 4 x 8 bricks in running bond
TextureSet woodTextures(uint32_t size);         ///< color, surface: growth rings cut along the trunk
TextureSet terrazzoTextures(uint32_t size);     ///< color, surface: chips in cement
TextureSet checkerTextures(uint32_t size);      ///< color, surface: 8 x 8 squares of gold and black lacquer
TextureSet dimpleTextures(uint32_t size);       ///< normal: hollows in rows, each shifted by half a hollow
TextureSet latticeTextures(uint32_t size);      ///< color with holes in its alpha: 8 x 8 round holes
TextureSet stainedGlassTextures(uint32_t size); ///< color with alpha, surface: cells of glass in lead
TextureSet lavaTextures(uint32_t size);         ///< color, surface, emission: glowing cracks in rock
TextureSet brushedTextures(uint32_t size);      ///< surface: streaks of roughness along u

} // namespace filament_core::showcase
