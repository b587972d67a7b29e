// SPDX-License-Identifier: Apache-2.0
#include <filament/Image.h>

#include "base/Assert.h"
#include "filament_core/assets/image/ImageWriter.h"

namespace filament {

Result<void> savePng(std::filesystem::path const& path, Image const& image, OutputSpace space) {
    FILAMENT_ASSERT(image.format == Format::RGBA8 || image.format == Format::RGB10A2,
                    "a PNG is written from RGBA8 or RGB10A2 pixels");
    if (image.format == Format::RGB10A2)
        return assets::writePng16(path, image.width, image.height, image.pixels, space);
    return assets::writePng(path, image.width, image.height, image.pixels, space);
}

Result<void> saveExr(std::filesystem::path const& path, Image const& image) {
    FILAMENT_ASSERT(image.format == Format::RGBA16F, "an EXR is written from RGBA16F pixels");
    return assets::writeExr(path, image.width, image.height, std::span<const std::byte>(image.pixels));
}

} // namespace filament
