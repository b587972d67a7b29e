// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/Image.h"

#include "base/Assert.h"

#include <algorithm>

namespace filament_core::assets {

uint64_t Image::levelBytes(uint32_t level) const {
    FILAMENT_ASSERT(level < 32, "an image has fewer than 32 levels");
    return layers * backend::imageBytes(format, std::max(1u, width >> level), std::max(1u, height >> level));
}

uint64_t Image::levelOffset(uint32_t level) const {
    uint64_t offset = 0;
    for (uint32_t i = 0; i < level; ++i) offset += levelBytes(i);
    return offset;
}

} // namespace filament_core::assets
