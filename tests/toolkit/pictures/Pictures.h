// SPDX-License-Identifier: Apache-2.0
/// Generated images for the tests of comparisons.
#pragma once

#include <filament_core/Image.h>

#include <array>

namespace filament_core::tools {

/// One opaque colour everywhere, sRGB codes.
inline Image flat(std::array<uint8_t, 3> const& color, uint32_t side = 32) {
    Image image{ .width = side, .height = side };
    for (uint32_t i = 0; i < side * side; ++i) {
        for (const uint8_t value : color) image.pixels.push_back(std::byte{ value });
        image.pixels.push_back(std::byte{ 255 });
    }
    return image;
}

inline Image grey(uint8_t value, uint32_t side = 32) { return flat({ value, value, value }, side); }

} // namespace filament_core::tools
