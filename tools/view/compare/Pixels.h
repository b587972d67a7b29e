// SPDX-License-Identifier: Apache-2.0
/// Pixels: what pictures that the engine returns hold, as numbers.
///   In      RGBA8, RGBA8Srgb, RGB10A2, RGBA16F; tightly packed.  Thread: any; pure.
#pragma once

#include "base/Result.h"

#include <filament/Image.h>

#include <array>
#include <cstddef>
#include <optional>

namespace filament::view {

inline size_t pixelCount(Image const& image) { return size_t{ image.width } * image.height; }

/// InvalidArgument for other formats, and if the bytes are not those of the size.
Result<void> checkPicture(Image const& image);

/// Codes divided by the largest one (sRGB is not decoded), or light.
std::array<float, 4> pixelAt(Image const& image, size_t index);

/// A part of an image of 4 bytes a pixel; none: it does not lie in the image.
std::optional<Image> partOf(Image const& image, uint2 offset, uint2 size);

} // namespace filament::view
