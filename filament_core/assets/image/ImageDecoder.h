// SPDX-License-Identifier: Apache-2.0
/// decodeImage: a PNG, JPEG, WebP or AVIF file in memory as RGBA8 pixels.
///   In      the file's bytes; `name` is used in error messages.
///   Out     one level, format RGBA8 (the caller knows whether it is sRGB); missing alpha is 255, grey is copied to all
///           colours. Colour profiles and gamma are ignored, as glTF 2.0, 3.8.3 demands; ColorProfile.h names them.
///           PNG: the pixels of the specification (ISO/IEC 15948); 16-bit channels are rounded to 8 (13.12);
///           decodeDeepPng() keeps them.
///           JPEG: the accurate integer DCT and triangle-filtered chroma of libjpeg-turbo, whose bits do not depend on
///           the processor; baseline and progressive; CMYK as Adobe's programs write it, inverted.
///           WebP: lossy and lossless, as libwebp decodes them, whose bits do not depend on the processor; no
///           animations.
///           AVIF: 8, 10 and 12 bits, turned and mirrored as the file says; deeper codes are rounded to 8 bits;
///           decodeDeepAvif() keeps them. AV1 defines the decoded planes exactly, and the conversion to RGB is our own
///           (AvifDecoder.cpp), whose bits do not depend on the processor. Colours of sRGB or BT.709, whose codes are
///           taken as those of sRGB. No animations, crops, colours multiplied by alpha, or other colour spaces.
///   Thread  any; no shared state.
///   Memory  at most 1 GiB of pixels (16384 x 16384), and of progressive JPEGs twice that while decoding; the size is
///           checked before anything is allocated.
///   Limits  an AVIF has at most 2^26 pixels, because the codec holds them several times. A JPEG has at most 500 scans:
///           each costs a pass over the whole image, and some bytes in the file.
///   Fails   Corrupt or Unsupported with the reason and the byte at which the decoder stopped; never crashes, for any
///           bytes. Data that is damaged or ends early is an error.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/image/Image.h"

#include <filament_core/Math.h>

#include <span>
#include <string_view>
#include <vector>

namespace filament_core::assets {

inline constexpr uint32_t kMaxImageSide = 16384;

/// Whether the first bytes are those of a PNG or JPEG.
bool isPngOrJpeg(std::span<const std::byte> bytes);

bool isWebp(std::span<const std::byte> bytes);
/// As its header says; {0, 0} if there is none.
uint2 webpSize(std::span<const std::byte> bytes);

bool isAvif(std::span<const std::byte> bytes);
/// Its ICC profile; empty without one.
std::vector<std::byte> avifProfile(std::span<const std::byte> bytes);
/// As its header says, turned; {0, 0} if there is none.
uint2 avifSize(std::span<const std::byte> bytes);

Result<Image> decodeImage(std::span<const std::byte> bytes, std::string_view name);

/// An image of more than 8 bits a channel, scaled to 16: four numbers a pixel, in the byte order of the machine.
struct DeepImage {
    uint32_t width = 0, height = 0;
    std::vector<uint16_t> codes;
};

/// Whether it is a PNG whose header states 16 bits.
bool isDeepPng(std::span<const std::byte> bytes);
/// All 16 bits of it; limits and errors as decodePng(). Of other depths, the codes scaled to 16 bits.
Result<DeepImage> decodeDeepPng(std::span<const std::byte> bytes, std::string_view name);

/// Whether it is an AVIF whose header states more than 8 bits.
bool isDeepAvif(std::span<const std::byte> bytes);
Result<DeepImage> decodeDeepAvif(std::span<const std::byte> bytes, std::string_view name);

/// Whether it is one of both.
bool isDeepImage(std::span<const std::byte> bytes);
/// isDeepImage() has been called.
Result<DeepImage> decodeDeepImage(std::span<const std::byte> bytes, std::string_view name);

/// The errors of decodeImage() that the header shows.
Result<void> checkPngOrJpeg(std::span<const std::byte> bytes, std::string_view name);
/// Called by decodeImage() according to the first bytes of the file.
Result<Image> decodePng(std::span<const std::byte> bytes, std::string_view name);
Result<Image> decodeJpeg(std::span<const std::byte> bytes, std::string_view name);
Result<Image> decodeWebp(std::span<const std::byte> bytes, std::string_view name);
Result<Image> decodeAvif(std::span<const std::byte> bytes, std::string_view name);

} // namespace filament_core::assets
