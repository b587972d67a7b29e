// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/TextureDecoder.h"

#include "filament_core/assets/image/ImageDecoder.h"
#include "filament_core/assets/image/Ktx2Decoder.h"
#include "filament_core/assets/image/MipMaps.h"

#include <algorithm>
#include <utility>

namespace filament::assets {
namespace {

Result<void> checkTexture(Ktx2Texture const& texture, std::string_view name) {
    Image const& image = texture.image;
    if (texture.isCube || texture.isArray)
        return fail(ErrorCode::Unsupported, "image '{}' is {}; export it as a two-dimensional texture", name,
                    texture.isCube ? "a cube" : "an array");
    if (image.format != backend::Format::RGBA8 && image.format != backend::Format::RGBA8Srgb)
        return fail(
                ErrorCode::Unsupported,
                "image '{}' has more than 8 bits a channel, which materials of models do not read; export it as UASTC",
                name);
    return {};
}

} // namespace

Result<DecodedTexture> decodeTexture(std::span<const std::byte> bytes, std::string_view name, uint32_t maxSize) {
    if (!isKtx2(bytes)) {
        if (!isPngOrJpeg(bytes) && !isWebp(bytes))
            return fail(ErrorCode::Unsupported,
                        "image '{}' is none of PNG, JPEG, WebP and KTX2; convert it to one of them", name);
        Result<Image> image = decodeImage(bytes, name);
        if (!image) return image.error();
        return DecodedTexture{ std::move(*image), std::nullopt };
    }
    const Result<Ktx2File> file = readKtx2(bytes, name);
    if (!file) return file.error();
    const uint32_t all = backend::fullMipCount(file->width, file->height);
    const bool isWhole = file->levels.size() == all;
    Result<Ktx2Texture> texture = decodeKtx2(bytes, name, { .maxSize = isWhole ? maxSize : 0, .isOneLevel = !isWhole });
    if (!texture) return texture.error();
    if (Result<void> checked = checkTexture(*texture, name); !checked) return checked.error();
    texture->image.format = backend::Format::RGBA8;
    return DecodedTexture{ std::move(texture->image), texture->isSrgb };
}

Image withAllLevels(Image image, bool isColor, uint32_t maxSize) {
    if (image.levels == 1) return withMipMaps(std::move(image), isColor, maxSize);
    image.format = isColor ? backend::Format::RGBA8Srgb : backend::Format::RGBA8;
    return image;
}

} // namespace filament::assets
