// SPDX-License-Identifier: Apache-2.0
/// encodePng16: display values of ten bits as a PNG of 16 bits a channel, which holds PQ without visible steps.
///   In      RGB10A2 as devices store it: red in the lowest bits of a little-endian word. Alpha is left out.
///   Out     a complete PNG without chunks of colour but `sRGB`: red, green and blue, a code c as
///           round(c * 65535 / 1023), and `sBIT`, which says that ten bits are significant.
///   Thread  any; pure.   Memory: two copies of the image.   Fails: std::bad_alloc.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::assets {

/// width * height * 4 bytes, fewer than 2^32 / 6 pixels.
std::vector<std::byte> encodePng16(uint32_t width, uint32_t height, std::span<const std::byte> rgb10a2);

} // namespace filament_core::assets
