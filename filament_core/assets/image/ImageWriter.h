// SPDX-License-Identifier: Apache-2.0
/// Writes images: PNG for display, OpenEXR and Radiance .hdr for scene-linear light. Also reads PNG.
///   In      tightly packed pixels, row 0 is the top row; the span's size is checked against width and height.
///   Out     a complete file or none: written under another name and renamed. PNG codes are those of the pixels.
///           EXR pixels are linear Rec. 709, and are marked so.
///   Thread  any; no shared state.
///   Memory  at most a second copy of the image.
///   Fails   Unreadable with path and reason; an empty image is the caller's bug.
///   Cost    PNG uses zlib's fastest level: 1280 x 720 in about 15 ms; files are a third larger than at the default
///           level.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/image/HdrImage.h"
#include "filament_core/assets/image/Image.h"

#include <filament_core/DisplayTransform.h>

#include <filesystem>
#include <span>

namespace filament_core::assets {

struct ExrSource;

/// RGBA8, 4 bytes per pixel. The file says that they are codes of `space`.
Result<void> writePng(std::filesystem::path const& path, uint32_t width, uint32_t height,
                      std::span<const std::byte> rgba8, OutputSpace space = OutputSpace::Srgb);

/// RGB10A2, 4 bytes per pixel, as 16 bits of red, green and blue: a code c becomes round(c * 65535 / 1023), of which
/// the file says that ten bits are significant (sBIT). Alpha is left out: a display has none.
Result<void> writePng16(std::filesystem::path const& path, uint32_t width, uint32_t height,
                        std::span<const std::byte> rgb10a2, OutputSpace space = OutputSpace::Srgb);

/// Any PNG as RGBA8, one level.
Result<Image> readPng(std::filesystem::path const& path);

enum class ExrPrecision : uint8_t { Half, Float };

/// RGB in ZIP-compressed scan lines. Half floats are clamped at 65504.
Result<void> writeExr(std::filesystem::path const& path, uint32_t width, uint32_t height,
                      std::span<const float3> pixels, ExrPrecision precision = ExrPrecision::Half);
/// RGBA16F pixels (8 bytes each) bit for bit, with alpha.
Result<void> writeExr(std::filesystem::path const& path, uint32_t width, uint32_t height,
                      std::span<const std::byte> rgba16f);

/// Of several layers, bit for bit. `channels`: as encodeExr() takes them (ExrWriter.h).
Result<void> writeExr(std::filesystem::path const& path, uint32_t width, uint32_t height,
                      std::span<const ExrSource> channels);

/// RGBE with run lengths: 8 bits of mantissa shared by three components, 1e-38 to 1e38. Negative components become 0.
Result<void> writeHdr(std::filesystem::path const& path, HdrImage const& image);

} // namespace filament_core::assets
