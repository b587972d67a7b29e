// SPDX-License-Identifier: Apache-2.0
/// foreignColorSpace: the colour space that an image file declares, if it is not sRGB.
///   In      a PNG (cICP, iCCP, sRGB, gAMA and cHRM, in this order), JPEG, WebP or AVIF (ICC profile).
///   Out     words for a warning: "the ICC profile 'Display P3'". Nothing if the file declares nothing, sRGB, or what
///           no one tells from it (its primaries to 0.01 of x, y or XYZ, its transfer function to 0.01).
///   Limits  profiles of 4 MiB; only matrices and curves are compared, a profile of tables is foreign.
///   Thread  any; pure.   Fails: never, for any bytes; what is damaged declares nothing.
///   Sources W3C, PNG Third Edition, 11.3.2 and 4.3; ICC.1:2022, 7 to 10; Annex B (JPEG); WebP Container Specification.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace filament_core::assets {

std::optional<std::string> foreignColorSpace(std::span<const std::byte> file);

/// As foreignColorSpace(), of an ICC profile alone.
std::optional<std::string> foreignIccProfile(std::span<const std::byte> profile);

} // namespace filament_core::assets
