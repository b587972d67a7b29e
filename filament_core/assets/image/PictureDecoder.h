// SPDX-License-Identifier: Apache-2.0
/// decodePicture: any image file in memory as the pixels of a texture; what loadImage() of <filament_core/Image.h>
/// calls.
///   In      the bytes of a PNG, JPEG, WebP, AVIF, KTX 2.0, DDS, .hdr or .exr; `name` is used in error messages.
///   Out     one level. Codes of 8 bits stay: RGBA8Srgb of colours, RGBA8 of data. Of 16 bits: light, or code / 65535
///           of data, as floats. Floats are those of the file, but infinite ones are 65504, and no colour is
///           negative. With `isFull` floats are RGBA32F, otherwise RGBA16F. KTX 2.0 files say themselves whether their
///           codes are sRGB: RGBA8Srgb, RGBA8 or floats, whatever `isColor` is; so do DDS files of an sRGB format.
///           Their first level counts.
///   Thread  any; the table of 16-bit codes is computed once.
///   Limits, fails  as decodeImage() and decodeHdrImage(); Unsupported for anything else.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/image/Image.h"

#include <span>
#include <string_view>

namespace filament_core::assets {

struct PictureOptions {
    bool isColor = true;
    bool isFull = false;
};

Result<Image> decodePicture(std::span<const std::byte> bytes, std::string_view name,
                            PictureOptions const& options = {});

} // namespace filament_core::assets
