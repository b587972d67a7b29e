// SPDX-License-Identifier: Apache-2.0
/// MipTaps: the texels of a mip level that a texel of the next one covers, along one axis, and their shares.
#pragma once

#include <array>
#include <cstdint>

namespace filament_core::assets {

struct MipTaps {
    uint32_t first = 0, count = 1;
    std::array<uint32_t, 3> parts{ 1, 0, 0 }; ///< of `whole`
    uint32_t whole = 1;

    template <class Number>
    Number weight(uint32_t i) const {
        return static_cast<Number>(parts[i]) / static_cast<Number>(whole);
    }
};

/// n texels become m = max(1, n / 2): texel i covers [i n / m, (i + 1) n / m). For an odd n = 2m + 1 it touches three.
inline MipTaps mipTapsOf(uint32_t i, uint32_t sourceSize) {
    if (sourceSize == 1) return {};
    if (sourceSize % 2 == 0) return { 2 * i, 2, { 1, 1, 0 }, 2 };
    const uint32_t size = sourceSize / 2;
    return { 2 * i, 3, { size - i, size, i + 1 }, sourceSize };
}

} // namespace filament_core::assets
