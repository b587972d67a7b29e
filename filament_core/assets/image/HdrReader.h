// SPDX-License-Identifier: Apache-2.0
/// Reads high dynamic range images: Radiance .hdr (RGBE) and OpenEXR .exr.
///   In      a file, or its bytes and a name for error messages. The content decides the format, not the extension.
///   Out     HdrImage, sanitised: NaN, infinite and negative components are replaced and counted in `repairs`.
///   .hdr    flat, old and new run lengths; rows top-down or bottom-up; EXPOSURE and COLORCORR lines are divided out;
///           not XYZE.
///   .exr    one part of scan lines or tiles, of which the largest level is read; half or float; every compression of
///           OpenEXR 3.1, lossy ones with the same bits on every CPU; channels R, G, B or Y. Not deep or subsampled.
///           The image is the display window, black where the data window does not cover it.
///   Colour  other primaries than those of Rec. 709 (PRIMARIES, "chromaticities") are converted, white to white.
///   Thread  any; no shared state.
///   Limits  kMaxHdrSide per side, kMaxHdrPixels in all; checked before memory is allocated.
///   Fails   NotFound, Unreadable, Corrupt, Unsupported, OutOfMemory: one line with file, reason and cure. Never
///           crashes.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/image/HdrImage.h"

#include <filesystem>
#include <span>
#include <string_view>

namespace filament_core::assets {

inline constexpr uint32_t kMaxHdrSide = 16384;
inline constexpr uint64_t kMaxHdrPixels = uint64_t(1) << 26; ///< 16384 x 4096: 768 MiB of floats

/// Whether the first bytes are those of an .hdr or .exr.
bool isHdrImage(std::span<const std::byte> bytes);

Result<HdrImage> readHdrImage(std::filesystem::path const& path);
Result<HdrImage> decodeHdrImage(std::span<const std::byte> bytes, std::string_view name);

/// Size and warnings without the pixels, of a file that decodeHdrImage() decodes.
HdrImage readHdrHeader(std::span<const std::byte> bytes);

} // namespace filament_core::assets
