// SPDX-License-Identifier: Apache-2.0
/// packImages: combines two maps with different channels into one image, in the layout that the glTF extensions define.
///   In      two images of one size and one level, RGBA8, as decoded.
///   Out     one level, RGBA8. RedGreen: red of the first and green of the second, for numbers. ColorAlpha: RGB of the
///           first, in sRGB, and alpha of the second.
///   Thread  any.   Memory: that of the first.
#pragma once

#include "filament_core/assets/image/Image.h"

namespace filament_core::assets {

enum class PackLayout : uint8_t { RedGreen, ColorAlpha };

Image packImages(Image first, Image const& second, PackLayout layout);

/// RGBA16F whose alpha is the red of an RGBA8 image of its size, of which it has as many levels: code / 255.
Image withAlphaOf(Image halves, Image const& red);

} // namespace filament_core::assets
