// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/PictureDecoder.h"

#include "base/Log.h"
#include "base/math/Half.h"
#include "filament_core/assets/image/ChannelTransfer.h"
#include "filament_core/assets/image/ColorProfile.h"
#include "filament_core/assets/image/DdsDecoder.h"
#include "filament_core/assets/image/HdrReader.h"
#include "filament_core/assets/image/ImageDecoder.h"
#include "filament_core/assets/image/Ktx2Decoder.h"

#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace filament_core::assets {
namespace {

/// RGBA pixels of floats or halves, one after the other.
class FloatPixels {
public:
    FloatPixels(uint32_t width, uint32_t height, bool isFull) {
        mImage.width = width, mImage.height = height;
        mImage.format = isFull ? backend::Format::RGBA32F : backend::Format::RGBA16F;
        mImage.data.resize(mImage.levelBytes(0));
    }
    void add(float4 pixel) {
        for (int c = 0; c < 4; ++c) {
            if (mImage.format == backend::Format::RGBA32F)
                append(pixel[c]);
            else
                append(halfFromFloat(pixel[c]));
        }
    }
    Image take() { return std::move(mImage); }

private:
    template <class T>
    void append(T value) {
        std::memcpy(mImage.data.data() + mAt, &value, sizeof(value));
        mAt += sizeof(value);
    }

    Image mImage;
    size_t mAt = 0;
};

Image fromDeepCodes(DeepImage const& deep, PictureOptions const& options) {
    FloatPixels pixels(deep.width, deep.height, options.isFull);
    std::vector<float> const& light = lightOfDeepCodes();
    for (size_t i = 0; i < deep.codes.size(); i += 4) {
        const uint16_t* const code = &deep.codes[i];
        const auto component = [&](int c) { return options.isColor ? light[code[c]] : shareOfDeepCode(code[c]); };
        pixels.add({ component(0), component(1), component(2), shareOfDeepCode(code[3]) });
    }
    return pixels.take();
}

Result<Image> decodeDeep(std::span<const std::byte> bytes, std::string_view name, PictureOptions const& options) {
    const Result<DeepImage> picture = decodeDeepImage(bytes, name);
    if (!picture) return picture.error();
    return fromDeepCodes(*picture, options);
}

Result<Image> decodeFloats(std::span<const std::byte> bytes, std::string_view name, PictureOptions const& options) {
    const Result<HdrImage> picture = decodeHdrImage(bytes, name);
    if (!picture) return picture.error();
    for (std::string const& line : picture->warnings) log(Severity::Warning, "'{}': {}", name, line);
    FloatPixels pixels(picture->width, picture->height, options.isFull);
    for (float3 const& pixel : picture->pixels) pixels.add(float4(pixel, 1));
    return pixels.take();
}

template <class T>
void raiseToZero(std::span<std::byte> data, auto&& isNegative) {
    for (size_t at = 0; at + sizeof(T) <= data.size(); at += sizeof(T)) {
        T value;
        std::memcpy(&value, &data[at], sizeof(value));
        if (isNegative(value)) std::memset(&data[at], 0, sizeof(value));
    }
}

/// No light is negative; directions and other data may be.
Image withoutNegativeLight(Image image, PictureOptions const& options) {
    if (options.isColor && image.format == backend::Format::RGBA16F)
        raiseToZero<uint16_t>(image.data, [](uint16_t half) { return (half & 0x8000) != 0; });
    if (options.isColor && image.format == backend::Format::RGBA32F)
        raiseToZero<float>(image.data, [](float value) { return std::signbit(value); });
    return image;
}

Result<Image> decodeLevel(std::span<const std::byte> bytes, std::string_view name, PictureOptions const& options) {
    const Result<Ktx2File> file = readKtx2(bytes, name);
    if (!file) return file.error();
    if (file->layers > 1)
        return fail(ErrorCode::Unsupported, "image '{}' has {} pictures ({}); export one of them", name, file->layers,
                    file->isCube ? "a cube" : "an array");
    Result<Ktx2Texture> texture = decodeKtx2(bytes, name, { .isFull = options.isFull, .isOneLevel = true });
    if (!texture) return texture.error();
    return withoutNegativeLight(std::move(texture->image), options);
}

/// A DDS says only of some formats that their codes are sRGB: of others, the caller knows.
Result<Image> decodeSurface(std::span<const std::byte> bytes, std::string_view name, PictureOptions const& options) {
    Result<DdsTexture> texture = decodeDds(bytes, name, { .isFull = options.isFull, .isOneLevel = true });
    if (!texture) return texture.error();
    if (texture->image.format == backend::Format::RGBA8 && options.isColor)
        texture->image.format = backend::Format::RGBA8Srgb;
    return withoutNegativeLight(std::move(texture->image), options);
}

} // namespace

Result<Image> decodePicture(std::span<const std::byte> bytes, std::string_view name, PictureOptions const& options) {
    if (isHdrImage(bytes)) return decodeFloats(bytes, name, options);
    if (isKtx2(bytes)) return decodeLevel(bytes, name, options);
    if (isDds(bytes)) return decodeSurface(bytes, name, options);
    if (!isPngOrJpeg(bytes) && !isWebp(bytes) && !isAvif(bytes))
        return fail(ErrorCode::Unsupported,
                    "image '{}' is none of PNG, JPEG, WebP, AVIF, KTX2, DDS, HDR and EXR; convert it to one of them",
                    name);
    if (const auto space = options.isColor ? foreignColorSpace(bytes) : std::nullopt)
        log(Severity::Warning, "'{}' declares {}, but its colours are taken as those of sRGB; convert it to sRGB", name,
            *space);
    if (isDeepImage(bytes)) return decodeDeep(bytes, name, options);
    Result<Image> picture = decodeImage(bytes, name);
    if (picture && options.isColor) picture->format = backend::Format::RGBA8Srgb;
    return picture;
}

} // namespace filament_core::assets
