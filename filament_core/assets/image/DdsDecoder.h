// SPDX-License-Identifier: Apache-2.0
/// decodeDds: the texels of a DirectDraw Surface.
///   In      the bytes of the file, untrusted; `name` is used in error messages.
///   Reads   BC1 to BC7; plain formats of 1 to 4 channels with up to 32 bits, described by a DXGI format or by masks,
///           with colours or grey. Not premultiplied alpha, palettes or YUV.
///   Out     RGBA8 where 8 bits hold all of it, RGBA8Srgb if the file says sRGB; otherwise RGBA16F, or on request
///           RGBA32F. Channels that a format does not have are 0, alpha is 1. Row 0 is at the top. On request BC7 or
///           BC7Srgb instead, without decoding (Ktx2Options::keepsBc7).
///   Thread  any; no shared state.   Memory: the result.
///   Limits  two dimensions, without cubes and arrays; 16384 a side.
///   Fails   Corrupt or Unsupported: one line with the file, the field and the cure. The length of every level that is
///           wanted is checked before memory is allocated.
///   Sources "DDS_HEADER", "DDS_PIXELFORMAT", "DDS_HEADER_DXT10" and "DXGI_FORMAT" of Microsoft's documentation
#pragma once

#include "base/Result.h"
#include "filament_core/assets/image/Ktx2Decoder.h"

#include <filament_core/Math.h>

#include <optional>
#include <span>
#include <string_view>

namespace filament_core::assets {

struct DdsTexture {
    Image image;                  ///< the levels of the file that are wanted, in sequence
    std::optional<bool> isSrgb{}; ///< nothing: its format leaves it open, as most writers do
    bool isRg = false;            ///< it has red and green only
};

bool isDds(std::span<const std::byte> bytes);
/// As its header says; {0, 0} if there is none.
uint2 ddsSize(std::span<const std::byte> bytes);

/// Ktx2Options::maxSize skips levels only if the file has all, down to 1 x 1. Without all of them it has one level.
Result<DdsTexture> decodeDds(std::span<const std::byte> bytes, std::string_view name, Ktx2Options const& options = {});

} // namespace filament_core::assets
