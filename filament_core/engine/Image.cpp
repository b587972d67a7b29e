// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Image.h>

#include "base/Assert.h"
#include "base/OutOfMemory.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "filament_core/assets/image/PictureDecoder.h"

#include <utility>

namespace filament_core {
namespace {

Result<Image> decodeAsOptionsSay(std::span<const std::byte> file, std::string_view name,
                                 ImageLoadOptions const& options) {
    auto picture = assets::decodePicture(
            file, name, { .isColor = options.content == ImageContent::Color, .isFull = options.fullFloats });
    if (!picture) return picture.error();
    return Image{ .width = picture->width,
                  .height = picture->height,
                  .format = picture->format,
                  .pixels = std::move(picture->data) };
}

} // namespace

Result<Image> loadImage(std::span<const std::byte> file, std::string_view name, ImageLoadOptions const& options) {
    return orOutOfMemory("image", name, [&] { return decodeAsOptionsSay(file, name, options); });
}

Result<Image> loadImage(std::filesystem::path const& path, ImageLoadOptions const& options) {
    return orOutOfMemory("image", path.native(), [&]() -> Result<Image> {
        const Result<std::vector<std::byte>> file = assets::readFileBytes(path);
        if (!file) return file.error();
        return decodeAsOptionsSay(*file, path.native(), options);
    });
}

TextureDesc textureOf(Image const& image, std::string_view name) {
    return { .format = image.format,
             .width = image.width,
             .height = image.height,
             .generateMips = true,
             .pixels = image.pixels,
             .name = std::string(name) };
}

Result<void> savePng(std::filesystem::path const& path, Image const& image, OutputSpace space) {
    FILAMENT_ASSERT(image.format == Format::RGBA8 || image.format == Format::RGB10A2 ||
                            (image.format == Format::RGBA8Srgb && space == OutputSpace::Srgb),
                    "a PNG is written from RGBA8 or RGB10A2 pixels, or from RGBA8Srgb pixels as sRGB");
    if (image.format == Format::RGB10A2)
        return assets::writePng16(path, image.width, image.height, image.pixels, space);
    return assets::writePng(path, image.width, image.height, image.pixels, space);
}

Result<void> saveExr(std::filesystem::path const& path, Image const& image) {
    FILAMENT_ASSERT(image.format == Format::RGBA16F, "an EXR is written from RGBA16F pixels");
    return assets::writeExr(path, image.width, image.height, std::span<const std::byte>(image.pixels));
}

} // namespace filament_core
