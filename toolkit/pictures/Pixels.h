// SPDX-License-Identifier: Apache-2.0
/// Pixels: what images and attachments hold, as numbers, and the first pixel in which two of them differ.
///   In      pictures: RGBA8, RGBA8Srgb, RGB10A2, RGBA16F; texels: any format; tightly packed.
///   Thread  any; pure.
///   Fails   checkPicture(), checkPair(): InvalidArgument in one line.
#pragma once

#include "base/Result.h"

#include <filament_core/Image.h>
#include <filament_core/Math.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>

namespace filament_core::tools {

inline size_t pixelCount(Image const& image) { return size_t{ image.width } * image.height; }

/// Refuses other formats, and bytes that are not those of the size.
Result<void> checkPicture(Image const& image);
/// Two pictures of one size and format.
Result<void> checkPair(Image const& a, Image const& b);

/// Texel `index`: codes divided by the largest one (sRGB is not decoded), or floats. Components that the format lacks
/// are 0.
std::array<float, 4> texel(Format format, std::span<const std::byte> bytes, size_t index);
inline std::array<float, 4> pixelAt(Image const& image, size_t index) {
    return texel(image.format, image.pixels, index);
}

struct PixelDifference {
    uint32_t x = 0, y = 0; ///< from the left and from the top
    std::array<float, 4> a{}, b{};
    uint64_t count = 0; ///< texels that differ
};
/// The first texel in reading order whose bits differ. Byte counts must agree.
std::optional<PixelDifference> firstDifference(Format format, uint32_t width, std::span<const std::byte> a,
                                               std::span<const std::byte> b);

/// "(0.5, 0.25, 0, 1)"
std::string textOf(std::array<float, 4> const& value);

/// A part of an image of 4 bytes a pixel; none: it does not lie in the image.
std::optional<Image> partOf(Image const& image, uint2 offset, uint2 size);

} // namespace filament_core::tools
