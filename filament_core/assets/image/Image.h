// SPDX-License-Identifier: Apache-2.0
/// Image: decoded pixels in memory, tightly packed, row 0 at the top, mip levels in sequence.
#pragma once

#include "backend/api/Format.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace filament_core::assets {

/// `data` holds level 0, then level 1, ...; each level has `layers` images of size max(1, size >> level).
struct Image {
    uint32_t width = 0, height = 0;
    uint32_t layers = 1; ///< 6 for a cube: +x -x +y -y +z -z
    uint32_t levels = 1;
    backend::Format format = backend::Format::RGBA8;
    std::vector<std::byte> data;

    uint64_t levelOffset(uint32_t level) const; ///< bytes from the start of `data`
    uint64_t levelBytes(uint32_t level) const;  ///< all layers of one level
};

} // namespace filament_core::assets
