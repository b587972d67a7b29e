// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/TexturePacking.h"

#include "base/Assert.h"
#include "base/math/Half.h"

#include <cstring>

namespace filament_core::assets {

Image packImages(Image first, Image const& second, PackLayout layout) {
    constexpr size_t kChannels = 4;
    for (Image const* image : { static_cast<Image const*>(&first), &second }) {
        FILAMENT_ASSERT(image->format == backend::Format::RGBA8 && image->levels == 1 && image->layers == 1 &&
                                !image->data.empty() && image->data.size() == image->levelBytes(0),
                        "packImages takes two RGBA8 images of one level");
    }
    FILAMENT_ASSERT(first.width == second.width && first.height == second.height, "packed images have one size");
    const size_t taken = layout == PackLayout::ColorAlpha ? 3 : 1;
    for (size_t i = taken; i < first.data.size(); i += kChannels) first.data[i] = second.data[i];
    return first;
}

Image withAlphaOf(Image halves, Image const& red) {
    FILAMENT_ASSERT(halves.format == backend::Format::RGBA16F && red.format == backend::Format::RGBA8 &&
                            halves.data.size() == 2 * red.data.size(),
                    "withAlphaOf takes images of one size, the first with halves");
    for (size_t i = 0; i < red.data.size(); i += 4) {
        const uint16_t alpha = halfFromFloat(static_cast<float>(std::to_integer<int>(red.data[i])) / 255);
        std::memcpy(&halves.data[2 * i + 6], &alpha, sizeof(alpha));
    }
    return halves;
}

} // namespace filament_core::assets
