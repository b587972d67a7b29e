// SPDX-License-Identifier: Apache-2.0
/// packImages: two maps with different channels in one image, as the glTF extensions laid them out to be shared.
///   In      two images of one level, RGBA8, as decoded. Where their sizes differ both become as wide as the wider and
///           as high as the higher, by linear interpolation in linear light; at the edges the last texel counts.
///   Out     one level, RGBA8. RedGreen: red of the first, green of the second, for numbers. ColorAlpha: RGB of the
///           first, in sRGB, and alpha of the second.
///   Thread  any; integers only: the same bits everywhere.
///   Memory  the result, and an image of its size for each that is resized.
#pragma once

#include "filament_core/assets/image/Image.h"

namespace filament::assets {

enum class PackLayout : uint8_t { RedGreen, ColorAlpha };

Image packImages(Image first, Image second, PackLayout layout);

} // namespace filament::assets
