// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/TextureDecoder.h"

#include "filament_core/assets/image/DdsDecoder.h"
#include "filament_core/assets/image/ImageDecoder.h"
#include "filament_core/assets/image/Ktx2Decoder.h"
#include "filament_core/assets/image/MipMaps.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace filament_core::assets {
namespace {

Result<void> checkShape(Ktx2File const& file, std::string_view name) {
    if (!file.isCube && !file.isArray) return {};
    return fail(ErrorCode::Unsupported, "image '{}' is {}; export it as a two-dimensional texture", name,
                file.isCube ? "a cube" : "an array");
}

Result<void> checkTexels(Image const& image, std::string_view name, const char* cure) {
    if (backend::formatInfo(image.format).isFloat)
        return fail(ErrorCode::Unsupported,
                    "image '{}' has more than 8 bits a channel, which materials of models do not read; export it as {}",
                    name, cure);
    return {};
}

/// Files with two channels hold normals, whose third coordinate is positive: writers of DDS store normal maps as BC5.
void addThirdCoordinate(std::span<std::byte> texels) {
    const auto coordinate = [](std::byte code) { return static_cast<float>(code) / 255 * 2 - 1; };
    for (size_t i = 0; i < texels.size(); i += 4) {
        const float x = coordinate(texels[i]), y = coordinate(texels[i + 1]);
        const float z = std::sqrt(std::max(1 - x * x - y * y, 0.0f));
        texels[i + 2] = static_cast<std::byte>(std::lround((z + 1) / 2 * 255));
    }
}

/// The uses of a texture determine its transfer function.
void setTransfer(Image& image, bool isColor) {
    using backend::Format;
    if (backend::isCompressed(image.format))
        image.format = isColor ? Format::BC7Srgb : Format::BC7;
    else
        image.format = isColor ? Format::RGBA8Srgb : Format::RGBA8;
}

Result<DecodedTexture> decodeDdsTexture(std::span<const std::byte> bytes, std::string_view name, uint32_t maxSize,
                                        TextureBlocks blocks) {
    Result<DdsTexture> texture =
            decodeDds(bytes, name, { .maxSize = maxSize, .keepsBc7 = blocks == TextureBlocks::KeptBc7 });
    if (!texture) return texture.error();
    if (Result<void> checked = checkTexels(texture->image, name, "BC7"); !checked) return checked.error();
    setTransfer(texture->image, false);
    if (texture->isRg) addThirdCoordinate(texture->image.data);
    return DecodedTexture{ .image = std::move(texture->image), .isSrgb = texture->isSrgb };
}

} // namespace

Result<DecodedTexture> decodeTexture(std::span<const std::byte> bytes, std::string_view name, uint32_t maxSize,
                                     TextureDepth depth, TextureBlocks blocks) {
    if (isDds(bytes)) return decodeDdsTexture(bytes, name, maxSize, blocks);
    if (!isKtx2(bytes)) {
        if (!isPngOrJpeg(bytes) && !isWebp(bytes) && !isAvif(bytes))
            return fail(ErrorCode::Unsupported,
                        "image '{}' is none of PNG, JPEG, WebP, AVIF, KTX2 and DDS; convert it to one of them", name);
        if (depth != TextureDepth::EightBits && isDeepImage(bytes)) {
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
    // light keeps the levels of its file, though they may be few
    const bool isWhole = file->levels.size() == all || depth == TextureDepth::Floats;
    Result<Ktx2Texture> texture =
            decodeKtx2(bytes, name,
                       { .maxSize = isWhole ? maxSize : 0,
                         .isOneLevel = !isWhole,
                         .keepsBc7 = blocks == TextureBlocks::KeptBc7,
                         .keepsBc6 = blocks == TextureBlocks::KeptBc6 && depth == TextureDepth::Floats });
    if (!texture) return texture.error();
    const bool isFloat = backend::formatInfo(texture->image.format).isFloat;
    if (isFloat && depth == TextureDepth::Floats) return DecodedTexture{ .image = std::move(texture->image) };
    if (Result<void> checked = checkTexels(texture->image, name, "UASTC"); !checked) return checked.error();
    setTransfer(texture->image, false);
    return DecodedTexture{ .image = std::move(texture->image), .isSrgb = texture->isSrgb };
}

Image withAllLevels(DecodedTexture texture, bool isColor, uint32_t maxSize) {
    if (!texture.deep.codes.empty()) return withMipMaps(texture.deep, isColor, maxSize);
    Image image = std::move(texture.image);
    if (image.levels == 1 && !backend::isCompressed(image.format))
        return withMipMaps(std::move(image), isColor, maxSize);
    setTransfer(image, isColor);
    dropLargeLevels(image, maxSize);
    return image;
}

} // namespace filament_core::assets
