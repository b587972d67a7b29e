// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/TexturePacking.h"

#include "base/Assert.h"

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

} // namespace filament_core::assets
