// SPDX-License-Identifier: Apache-2.0
/// decodeTexture: an image of a model as texels, with the levels that its file has.
///   In      the bytes of a PNG, JPEG, WebP, AVIF, KTX 2.0 or DDS file; `name` is used in error messages.
///   Out     RGBA8; of images with more bits a channel (PNG of 16, AVIF of 10 and 12) all of them, if they are
///           requested. Blocks of BC7, if they are requested. One level of images; of KTX 2.0 and DDS the levels of
///           the file if they end with 1 x 1 or if floats are asked for, otherwise its first. A DDS of two channels is
///           a normal map: blue becomes the third coordinate.
///   Thread  any; no shared state.
///   Limits, fails  as decodeImage(), decodeKtx2() and decodeDds(). Cubes, arrays, and texels of KTX 2.0 and DDS with
///           more than 8 bits are Unsupported.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/image/Image.h"
#include "filament_core/assets/image/ImageDecoder.h"

#include <optional>
#include <span>
#include <string_view>

namespace filament_core::assets {

struct DecodedTexture {
    Image image; ///< RGBA8 or BC7, also of colours; RGBA16F or BC6HUfloat if asked for; empty if `deep` is not
    std::optional<bool> isSrgb{}; ///< what the file says of its colours, if it says it
    DeepImage deep{};             ///< an image with more than 8 bits a channel
};

enum class TextureDepth : uint8_t {
    EightBits, ///< images with more are rounded
    AllBits,
    Floats, ///< also those of KTX 2.0, as RGBA16F in DecodedTexture::image
};

enum class TextureBlocks : uint8_t {
    Decoded,
    KeptBc7, ///< BC7 stays compressed, if the file has all levels and its texels need no rearrangement
    KeptBc6, ///< BC6H of a KTX 2.0 file stays compressed, if floats are asked for and nothing needs rearrangement
};

/// `maxSize`: larger levels of the file are skipped; an image is not downscaled. 0: no limit.
Result<DecodedTexture> decodeTexture(std::span<const std::byte> bytes, std::string_view name, uint32_t maxSize = 0,
                                     TextureDepth depth = TextureDepth::EightBits,
                                     TextureBlocks blocks = TextureBlocks::Decoded);

/// All levels of a decoded texture: those that it has, or those of withMipMaps(). Starts with the first one that is not
/// larger than `maxSize`. RGBA8Srgb or BC7Srgb of colours, RGBA8 or BC7 of data, RGBA16F of deep images.
Image withAllLevels(DecodedTexture texture, bool isColor, uint32_t maxSize);

} // namespace filament_core::assets
