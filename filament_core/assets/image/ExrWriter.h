// SPDX-License-Identifier: Apache-2.0
/// encodeExr: an image as an OpenEXR file of scan lines. Private to this folder.
///   In      samples pixel after pixel, as they lie in memory; row 0 is the top row.
///   Out     a complete file of version 2: the eight attributes that each must have, the chromaticities of linear
///           Rec. 709, and blocks of 16 rows, compressed with ZIP, or as they are where that would not make them
///           smaller. Samples keep their bits, also those of infinities and NaNs. The same image and version of zlib
///           give the same bytes.
///   Thread  any; pure.
///   Memory  the file, and a few times one block.
///   Fails   std::bad_alloc.
#pragma once

#include "filament_core/assets/image/ExrBlock.h"

#include <string>
#include <string_view>
#include <vector>

namespace filament_core::assets {

/// Of width and height: a block then has less than 2 GiB, which its size in the file can express.
constexpr uint32_t kMaxExrSide = uint32_t{ 1 } << 22;

struct ExrPixels {
    uint32_t width = 0, height = 0; ///< 1 to kMaxExrSide
    std::string_view channels;      ///< of a pixel, a letter each, in the order of memory: "RGB", "RGBA", "Y"
    ExrType type = ExrType::Half;
    std::span<const std::byte> samples; ///< width * height * channels of them
};

std::vector<std::byte> encodeExr(ExrPixels const& pixels);

constexpr size_t kMaxExrName = 31; ///< letters of a channel's name

/// One channel of an image of several layers: "normal.X".
struct ExrSource {
    std::string name; ///< 1 to kMaxExrName letters, unlike all others
    ExrType type = ExrType::Half;
    const std::byte* samples = nullptr; ///< the first; row 0 is the top row
    size_t pitch = 0;                   ///< bytes from a pixel to the next one, also at the end of a row
};

std::vector<std::byte> encodeExr(uint32_t width, uint32_t height, std::span<const ExrSource> channels);

} // namespace filament_core::assets
