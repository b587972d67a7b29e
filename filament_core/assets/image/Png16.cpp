// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/Png16.h"

#include "filament_core/assets/image/PngChunks.h"
#include "filament_core/assets/image/Zlib.h"

#include <array>
#include <cstring>
#include <string_view>

namespace filament_core::assets {
namespace {

using PngBytes = std::vector<std::byte>;

constexpr size_t kPixelBytes = 6;
constexpr int kPngZlibLevel = 1; // the fastest

/// The three channels of a pixel, highest byte first.
void storePixel(uint32_t pixel, std::byte* to) {
    for (size_t c = 0; c < 3; ++c) {
        const uint32_t code = pixel >> (10 * c) & 1023;
        const uint32_t wide = (code * 65535 + 511) / 1023; // rounded
        to[2 * c] = static_cast<std::byte>(wide >> 8);
        to[2 * c + 1] = static_cast<std::byte>(wide & 0xFF);
    }
}

/// Rows as PNG compresses them: each byte less that of the pixel to its left (filter 1, "Sub", section 9.2).
PngBytes filteredRows(uint32_t width, uint32_t height, std::span<const std::byte> rgb10a2) {
    const size_t rowBytes = size_t{ width } * kPixelBytes;
    PngBytes row(kPixelBytes + rowBytes), rows; // before the first pixel are zeros
    rows.reserve((rowBytes + 1) * height);
    for (size_t y = 0; y < height; ++y) {
        for (size_t x = 0; x < width; ++x) {
            uint32_t pixel = 0;
            std::memcpy(&pixel, rgb10a2.data() + (y * width + x) * 4, sizeof(pixel));
            storePixel(pixel, row.data() + kPixelBytes * (x + 1));
        }
        rows.push_back(std::byte{ 1 });
        for (size_t i = kPixelBytes; i < row.size(); ++i) {
            const int difference = std::to_integer<int>(row[i]) - std::to_integer<int>(row[i - kPixelBytes]);
            rows.push_back(static_cast<std::byte>(difference & 0xFF));
        }
    }
    return rows;
}

} // namespace

std::vector<std::byte> encodePng16(uint32_t width, uint32_t height, std::span<const std::byte> rgb10a2) {
    constexpr std::string_view kSignature("\x89PNG\r\n\x1A\n", 8);
    constexpr std::array kDepthAndColor{ std::byte{ 16 }, std::byte{ 2 }, std::byte{ 0 }, std::byte{ 0 },
                                         std::byte{ 0 } }; // 16 bits, RGB, no other method of anything
    constexpr std::array kSignificant{ std::byte{ 10 }, std::byte{ 10 }, std::byte{ 10 } };
    constexpr std::array kPerceptual{ std::byte{ 0 } };
    const auto signature = std::as_bytes(std::span(kSignature));
    PngBytes png(signature.begin(), signature.end()), header;
    appendPngWord(header, width);
    appendPngWord(header, height);
    for (const std::byte byte : kDepthAndColor) header.push_back(byte);
    appendPngChunk(png, "IHDR", header);
    appendPngChunk(png, "sRGB", kPerceptual);
    appendPngChunk(png, "sBIT", kSignificant);
    appendPngChunk(png, "IDAT", deflateZlib(filteredRows(width, height, rgb10a2), kPngZlibLevel));
    appendPngChunk(png, "IEND", {});
    return png;
}

} // namespace filament_core::assets
