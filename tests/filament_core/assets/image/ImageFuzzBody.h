// SPDX-License-Identifier: Apache-2.0
/// Shared by the fuzzer and the replay tests: for any bytes, decoding an image gives an error with the image's name,
/// or as many pixels as the header says; and the same twice.
#pragma once

#include "base/Assert.h"
#include "base/math/Half.h"
#include "filament_core/assets/environment/Panorama.h"
#include "filament_core/assets/image/ColorProfile.h"
#include "filament_core/assets/image/HdrReader.h"
#include "filament_core/assets/image/ImageDecoder.h"
#include "filament_core/assets/image/ImageSize.h"
#include "filament_core/assets/image/Ktx2File.h"
#include "filament_core/assets/image/PictureDecoder.h"
#include "filament_core/assets/image/TextureDecoder.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>

namespace filament_core::assets::test {

inline constexpr uint64_t kMaxFuzzedPixels = 1u << 20;

/// PNG, JPEG, WebP and AVIF. Returns whether it was an image.
inline bool fuzzImage(std::span<const std::byte> bytes) {
    isCutShortPng(bytes);
    foreignIccProfile(bytes);
    if (const auto space = foreignColorSpace(bytes))
        FILAMENT_ASSERT(space->find('\n') == std::string::npos, "a colour space is one line");
    const uint2 size = imageSize(bytes);
    if (uint64_t{ size.x } * size.y > kMaxFuzzedPixels) return false; // only slow
    const Result<Image> image = decodeImage(bytes, "fuzzed");
    // Whatever the first bytes say, the decoders themselves refuse what is not theirs.
    const int readers = decodePng(bytes, "fuzzed").ok() + decodeJpeg(bytes, "fuzzed").ok() +
                        decodeWebp(bytes, "fuzzed").ok() + (isAvif(bytes) && decodeAvif(bytes, "fuzzed").ok());
    FILAMENT_ASSERT(readers < 2 && image.ok() == (readers == 1), "one decoder reads what is a picture");
    if (!image) {
        FILAMENT_ASSERT(image.error().message.starts_with("image 'fuzzed' "), "an error names its picture");
        return false;
    }
    FILAMENT_ASSERT(image->data.size() == image->levelBytes(0), "every pixel is there");
    if (isDeepImage(bytes)) {
        const Result<DecodedTexture> deep = decodeTexture(bytes, "fuzzed", 0, TextureDepth::AllBits);
        FILAMENT_ASSERT(deep.ok() && deep->deep.codes.size() == image->data.size(),
                        "with all bits it is a picture, too");
    }
    const Result<Image> again = decodeImage(bytes, "fuzzed");
    FILAMENT_ASSERT(again.ok() && again->data == image->data, "decoding twice gives the same pixels");
    return true;
}

/// A few bytes may say that a display window is 2^26 pixels of black.
inline bool isHugeHdr(std::span<const std::byte> bytes) {
    const HdrImage header = readHdrHeader(bytes);
    return uint64_t{ header.width } * header.height > kMaxFuzzedPixels;
}

/// Radiance .hdr and OpenEXR. Returns whether it was an image.
inline bool fuzzHdrImage(std::span<const std::byte> bytes) {
    if (isHugeHdr(bytes)) return false; // only slow
    const Result<HdrImage> image = decodeHdrImage(bytes, "fuzzed");
    if (!image) {
        FILAMENT_ASSERT(image.error().message.starts_with("cannot decode 'fuzzed': "), "an error names its picture");
        FILAMENT_ASSERT(image.error().message.find('\n') == std::string::npos, "an error is one line");
        return false;
    }
    FILAMENT_ASSERT(image->pixels.size() == size_t{ image->width } * image->height, "every pixel is there");
    for (float3 const& pixel : image->pixels) {
        for (const float value : { pixel.x, pixel.y, pixel.z })
            FILAMENT_ASSERT(value >= 0 && std::isfinite(value), "every pixel is sanitised");
    }
    const Result<HdrImage> again = decodeHdrImage(bytes, "fuzzed");
    FILAMENT_ASSERT(again.ok() && std::memcmp(again->pixels.data(), image->pixels.data(),
                                              image->pixels.size() * sizeof(float3)) == 0,
                    "decoding twice gives the same pixels");
    const Result<HdrImage> panorama = decodePanorama(bytes, "fuzzed");
    FILAMENT_ASSERT(panorama.ok() || image->isCube, "only a cube is no panorama");
    for (float3 const& pixel : panorama ? panorama->pixels : std::vector<float3>{})
        FILAMENT_ASSERT(pixel.x >= 0 && pixel.y >= 0 && std::isfinite(pixel.z), "every pixel is light");
    for (std::string const& line : image->warnings)
        FILAMENT_ASSERT(line.find('\n') == std::string::npos, "a warning is one line");
    return true;
}

/// Any kind of image, as loadImage() decodes it.
inline void fuzzPicture(std::span<const std::byte> bytes) {
    if (isKtx2(bytes)) return; // tests/fuzz/TextureFuzzBody.h
    const uint2 size = imageSize(bytes);
    if (uint64_t{ size.x } * size.y > kMaxFuzzedPixels) return; // only slow
    if (isHugeHdr(bytes)) return;
    const Result<Image> full = decodePicture(bytes, "fuzzed", { .isColor = false, .isFull = true });
    for (const bool isColor : { false, true }) {
        const Result<Image> image = decodePicture(bytes, "fuzzed", { .isColor = isColor });
        FILAMENT_ASSERT(image.ok() == full.ok(), "a picture is one, whatever it is for");
        if (!image) {
            FILAMENT_ASSERT(image.error().message.find("'fuzzed'") != std::string::npos, "an error names its picture");
            FILAMENT_ASSERT(image.error().message.find('\n') == std::string::npos, "an error is one line");
            continue;
        }
        FILAMENT_ASSERT(image->width > 0 && image->height > 0 && image->data.size() == image->levelBytes(0),
                        "every pixel is there");
        const bool isFloat = image->format == backend::Format::RGBA16F;
        FILAMENT_ASSERT(isFloat == (full->format == backend::Format::RGBA32F), "only floats can be full");
        FILAMENT_ASSERT(isFloat || image->format == (isColor ? backend::Format::RGBA8Srgb : backend::Format::RGBA8),
                        "codes of 8 bits stay codes");
        for (size_t at = 0; isFloat && at < image->data.size(); at += 2) {
            uint16_t bits;
            std::memcpy(&bits, &image->data[at], sizeof(bits));
            const float value = floatFromHalf(bits);
            FILAMENT_ASSERT(std::isfinite(value), "every number is finite");
            FILAMENT_ASSERT(value >= 0 || !isColor, "no colour is negative");
        }
    }
}

} // namespace filament_core::assets::test
