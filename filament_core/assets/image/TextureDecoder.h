// SPDX-License-Identifier: Apache-2.0
/// decodeTexture: an image of a model as RGBA8 texels, with the levels that its file has.
///   In      the bytes of a PNG, JPEG, WebP or KTX 2.0 file; `name` is used in error messages.
///   Out     RGBA8. One level of pictures; of KTX 2.0 the levels of the file if they end with 1 x 1, otherwise its
///           first.
///   Thread  any; no shared state.
///   Limits, fails  as decodeImage() and decodeKtx2(). Cubes, arrays, and texels of more than 8 bits are Unsupported.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/image/Image.h"

#include <optional>
#include <span>
#include <string_view>

namespace filament::assets {

struct DecodedTexture {
    Image image;
    std::optional<bool> isSrgb; ///< what the file says of its colours, if it says it
};

/// `maxSize`: larger levels of the file are left out; a picture is not made smaller. 0: no limit.
Result<DecodedTexture> decodeTexture(std::span<const std::byte> bytes, std::string_view name, uint32_t maxSize = 0);

/// All levels of a decoded texture: those that it has, or those of withMipMaps(). Starts with the first one that is not
/// larger than `maxSize`.
Image withAllLevels(Image image, bool isColor, uint32_t maxSize);

} // namespace filament::assets
