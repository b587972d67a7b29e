// SPDX-License-Identifier: Apache-2.0
/// withColorSpace: a PNG whose chunks say which colour space its codes belong to.
///   In      a complete PNG as libpng or encodePng16() writes it.
///   Out     the same with its colour chunks (sRGB, gAMA, cHRM, iCCP, cICP) replaced. sRGB: the PNG as it is.
///   Fails   never.   Memory: a second copy of the file.
#pragma once

#include <filament_core/DisplayTransform.h>

#include <cstddef>
#include <vector>

namespace filament_core::assets {

std::vector<std::byte> withColorSpace(std::vector<std::byte> png, OutputSpace space);

} // namespace filament_core::assets
