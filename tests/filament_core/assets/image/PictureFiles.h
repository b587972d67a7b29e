// SPDX-License-Identifier: Apache-2.0
/// Small PNG and JPEG files of every kind, with the pixels that they hold.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace filament_core::assets::test {

struct PngKind {
    int colorType = 2; ///< of the specification: 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGBA
    int depth = 8;
    bool interlaced = false;
    bool transparentColor = false; ///< a tRNS chunk
};
std::vector<PngKind> pngKinds();
std::string pngKindName(PngKind const& kind);

struct PngFile {
    std::vector<std::byte> bytes, rgba;
    std::vector<uint16_t> deep; ///< of the pixels with 16 bits a channel
};
PngFile makePng(PngKind const& kind, uint32_t width, uint32_t height);

struct JpegKind {
    int components = 3; ///< 1 grey, 3 YCbCr, 4 CMYK
    bool progressive = false;
    bool subsampled = false; ///< chroma at half the size in both directions
};
std::vector<JpegKind> jpegKinds();
std::string jpegKindName(JpegKind const& kind);
/// What makeJpeg() compresses, as RGB codes.
std::array<double, 3> jpegPixel(JpegKind const& kind, uint32_t x, uint32_t y);
std::vector<std::byte> makeJpeg(JpegKind const& kind, uint32_t width, uint32_t height);

/// The index of a JPEG's first marker FF `code`.
size_t findSegment(std::vector<std::byte> const& file, uint8_t code);

} // namespace filament_core::assets::test
