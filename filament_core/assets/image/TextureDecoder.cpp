// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/TextureDecoder.h"

#include "filament_core/assets/image/ImageDecoder.h"
#include "filament_core/assets/image/Ktx2Decoder.h"
#include "filament_core/assets/image/MipMaps.h"

#include <algorithm>
#include <utility>

namespace filament_core::assets {
namespace {

Result<void> checkShape(Ktx2File const& file, std::string_view name) {
    if (!file.isCube && !file.isArray) return {};
    return fail(ErrorCode::Unsupported, "image '{}' is {}; export it as a two-dimensional texture", name,
                file.isCube ? "a cube" : "an array");
}

Result<void> checkTexels(Image const& image, std::string_view name) {
    if (image.format != backend::Format::RGBA8 && image.format != backend::Format::RGBA8Srgb)
        return fail(
                ErrorCode::Unsupported,
                "image '{}' has more than 8 bits a channel, which materials of models do not read; export it as UASTC",
                name);
    return {};
}

} // namespace

Result<DecodedTexture> decodeTexture(std::span<const std::byte> bytes, std::string_view name, uint32_t maxSize,
                                     TextureDepth depth) {
    if (!isKtx2(bytes)) {
        if (!isPngOrJpeg(bytes) && !isWebp(bytes) && !isAvif(bytes))
            return fail(ErrorCode::Unsupported,
                        "image '{}' is none of PNG, JPEG, WebP, AVIF and KTX2; convert it to one of them", name);
        if (depth == TextureDepth::AllBits && isDeepImage(bytes)) {
            Result<DeepImage> deep = decodeDeepImage(bytes, name);
            if (!deep) return deep.error();
            return DecodedTexture{ .image = {}, .deep = std::move(*deep) };
        }
        Result<Image> image = decodeImage(bytes, name);
        if (!image) return image.error();
        return DecodedTexture{ .image = std::move(*image) };
    }
    const Result<Ktx2File> file = readKtx2(bytes, name);
    if (!file) return file.error();
    if (Result<void> checked = checkShape(*file, name); !checked) return checked.error();
    const uint32_t all = backend::fullMipCount(file->width, file->height);
    const bool isWhole = file->levels.size() == all;
    Result<Ktx2Texture> texture = decodeKtx2(bytes, name, { .maxSize = isWhole ? maxSize : 0, .isOneLevel = !isWhole });
    if (!texture) return texture.error();
    if (Result<void> checked = checkTexels(texture->image, name); !checked) return checked.error();
    texture->image.format = backend::Format::RGBA8;
    return DecodedTexture{ .image = std::move(texture->image), .isSrgb = texture->isSrgb };
}

Image withAllLevels(DecodedTexture texture, bool isColor, uint32_t maxSize) {
    if (!texture.deep.codes.empty()) return withMipMaps(texture.deep, isColor, maxSize);
    Image image = std::move(texture.image);
    if (image.levels == 1) return withMipMaps(std::move(image), isColor, maxSize);
    image.format = isColor ? backend::Format::RGBA8Srgb : backend::Format::RGBA8;
    dropLargeLevels(image, maxSize);
    return image;
}

} // namespace filament_core::assets
