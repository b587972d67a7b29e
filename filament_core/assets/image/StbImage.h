// SPDX-License-Identifier: Apache-2.0
/// decodeImage: a PNG or JPEG file in memory as RGBA8 pixels.
///   In      the file's bytes; `name` is used in error messages.
///   Out     one level, format RGBA8 (the caller knows whether it is sRGB); missing alpha is 255, grey is copied to all
///           colours, 16-bit channels are reduced to 8.
///   Thread  any; no shared state.
///   Memory  at most 1 GiB of pixels (16384 x 16384); the size is checked before anything is allocated.
///   Fails   Corrupt or Unsupported with the reason; never crashes, for any bytes.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/image/Image.h"

#include <span>
#include <string_view>

namespace filament::assets {

Result<Image> decodeImage(std::span<const std::byte> bytes, std::string_view name);

} // namespace filament::assets
