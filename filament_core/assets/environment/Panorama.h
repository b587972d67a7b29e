// SPDX-License-Identifier: Apache-2.0
/// decodePanorama: the light around a scene from a file of HdrReader.h, for the baker and the path tracer alike.
///   Out     an equirectangular image. OpenEXR's cube maps ("envmap" 1: six faces, one below the other) become one of
///           four times their width, interpolated.
///   Warns   in the log, of what the header says and the light does not follow: see HdrImage::panoramaWarnings.
///   Limits  as decodeHdrImage(); faces of 2048 texels a side.
///   Fails   as decodeHdrImage(); Unsupported: a cube whose size is not that of six faces.
///   Thread  any; pure.
#pragma once

#include "base/Result.h"
#include "filament_core/assets/image/HdrImage.h"

#include <filesystem>
#include <span>
#include <string_view>

namespace filament_core::assets {

/// Does not warn: the result may be cached, and then the warnings are not less true.
Result<HdrImage> decodePanorama(std::span<const std::byte> bytes, std::string_view name);
void warnAboutPanorama(std::span<const std::byte> bytes, std::string_view name);

/// Both, for the file.
Result<HdrImage> readPanorama(std::filesystem::path const& path);

} // namespace filament_core::assets
