// SPDX-License-Identifier: Apache-2.0
/// MipMaps: the full mip chain of an 8-bit RGBA image.
///   In      level 0, tightly packed, in sRGB (colour) or as plain numbers (data); alpha is always linear.
///   Out     all levels in sequence, each the area-weighted mean of the one above it, in linear light for colours. For
///           odd sizes every texel of a level covers exactly its share of the level above, and no texel is dropped.
///           Levels are chained in 16 bits and rounded to 8 only for output, so rounding does not add up. Alpha is
///           straight: the colour of transparent texels counts, as glTF's OPAQUE materials show it.
///   Thread  any; the same bits everywhere (integers, and floats without transcendental functions).
///   Memory  the chain, 4/3 of level 0, and 8 B per texel of level 1 while it runs.
///   Cost    bench/filament_core/assets/GltfBench.cpp
#pragma once

#include "filament_core/assets/image/Image.h"
#include "filament_core/assets/image/ImageDecoder.h"

namespace filament_core::assets {

/// `base` has one level, format RGBA8, and any number of layers: each gets its own chain. The result has format
/// RGBA8Srgb for colours and RGBA8 for data. It starts with the first level that is not larger than `maxSize` in any
/// direction (0: no limit).
Image withMipMaps(Image base, bool isColor, uint32_t maxSize = 0);

/// Of an image with more than 8 bits a channel, as RGBA16F: light of colours, code / 65535 of data. The first
/// level has the nearest halves; the others are means of 16-bit light, which are exact to 1/65535.
Image withMipMaps(DeepImage const& base, bool isColor, uint32_t maxSize = 0);

/// Drops the levels that are larger than `maxSize` in any direction (0: none).
void dropLargeLevels(Image& image, uint32_t maxSize);

} // namespace filament_core::assets
