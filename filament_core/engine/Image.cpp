// SPDX-License-Identifier: Apache-2.0
#include <filament_core/Color.h>
#include <filament_core/Image.h>
#include <filament_core/StraightAlpha.h>
#include <filament_core/TexelBytes.h>

#include "backend/api/Format.h"
#include "base/Assert.h"
#include "base/OutOfMemory.h"
#include "base/math/Half.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/ExrWriter.h"
#include "filament_core/assets/image/ImageWriter.h"
#include "filament_core/assets/image/PictureDecoder.h"

#include <algorithm>
#include <cmath>
#include <cstring>
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

uint32_t texelBytes(Format format) {
    backend::FormatInfo const& info = backend::formatInfo(format);
    return info.blockSize == 1 ? info.bytesPerBlock : 0;
}

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

namespace {

std::string nameOf(ExrLayer const& layer, std::string_view channel) {
    return layer.name.empty() ? std::string(channel) : layer.name + '.' + std::string(channel);
}

/// Adds the channels of a layer to those of the layers before it.
Result<void> addLayer(ExrLayer const& layer, Image const& first, std::vector<assets::ExrSource>& channels) {
    FILAMENT_ASSERT(layer.image, "a layer of an EXR has an image");
    Image const& image = *layer.image;
    const bool isHalf = image.format == Format::RGBA16F;
    if (!isHalf && image.format != Format::RGBA32F)
        return fail(ErrorCode::InvalidArgument, "layer '{}' of an EXR is not RGBA16F or RGBA32F", layer.name);
    if (image.width != first.width || image.height != first.height)
        return fail(ErrorCode::InvalidArgument, "layer '{}' of an EXR has {} x {} pixels, the first one {} x {}",
                    layer.name, image.width, image.height, first.width, first.height);
    if (layer.channels.size() > 4)
        return fail(ErrorCode::InvalidArgument, "layer '{}' of an EXR has {} channels of an image that has four",
                    layer.name, layer.channels.size());
    const size_t sampleBytes = isHalf ? 2 : 4;
    const std::byte* samples = image.pixels.data();
    for (const std::string_view channel : layer.channels) {
        const std::string name = nameOf(layer, channel);
        if (name.empty() || name.size() > assets::kMaxExrName)
            return fail(ErrorCode::InvalidArgument, "channel '{}' of an EXR does not have 1 to {} letters", name,
                        assets::kMaxExrName);
        if (std::ranges::find(channels, name, &assets::ExrSource::name) != channels.end())
            return fail(ErrorCode::InvalidArgument, "an EXR has channel '{}' once only", name);
        channels.push_back({ name, isHalf ? assets::ExrType::Half : assets::ExrType::Float, samples, 4 * sampleBytes });
        samples += sampleBytes;
    }
    return {};
}

Result<void> saveLayers(std::filesystem::path const& path, std::span<const ExrLayer> layers) {
    std::vector<assets::ExrSource> channels;
    for (ExrLayer const& layer : layers) {
        if (Result<void> added = addLayer(layer, *layers.front().image, channels); !added) return added;
    }
    if (channels.empty()) return fail(ErrorCode::InvalidArgument, "'{}' has no channel to save", path.native());
    Image const& first = *layers.front().image;
    FILAMENT_ASSERT(first.width > 0 && first.height > 0, "an EXR has at least one pixel");
    return assets::writeExr(path, first.width, first.height, channels);
}

} // namespace

Result<void> saveExr(std::filesystem::path const& path, std::span<const ExrLayer> layers) {
    return orOutOfMemory("image", path.native(), [&] { return saveLayers(path, layers); });
}

namespace {

void divideCodes(std::span<std::byte> texel) {
    const auto codeOf = [](std::byte code) { return static_cast<float>(std::to_integer<int>(code)); };
    const float alpha = codeOf(texel[3]);
    if (alpha == 255) return; // the codes as they are
    float3 codes(0);
    if (alpha > 0) {
        const float3 light =
                color::linearFromSrgb(float3(codeOf(texel[0]), codeOf(texel[1]), codeOf(texel[2])) / 255.0f);
        codes = 255.0f * color::srgbFromLinear(min(light * (255 / alpha), 1.0f));
    }
    for (int c = 0; c < 3; ++c) texel[static_cast<size_t>(c)] = static_cast<std::byte>(std::lround(codes[c]));
}

void divideHalves(std::span<std::byte> texel) {
    constexpr float kMost = 65504; // of halves
    std::array<uint16_t, 4> halves;
    std::memcpy(halves.data(), texel.data(), sizeof(halves));
    const float alpha = floatFromHalf(halves[3]);
    for (uint16_t& half : std::span(halves).first(3))
        half = alpha > 0 ? halfFromFloat(std::clamp(floatFromHalf(half) / alpha, -kMost, kMost)) : uint16_t{ 0 };
    std::memcpy(texel.data(), halves.data(), sizeof(halves));
}

void divideFloats(std::span<std::byte> texel) {
    std::array<float, 4> floats;
    std::memcpy(floats.data(), texel.data(), sizeof(floats));
    for (float& number : std::span(floats).first(3)) number = floats[3] > 0 ? number / floats[3] : 0;
    std::memcpy(texel.data(), floats.data(), sizeof(floats));
}

} // namespace

Image straightAlpha(Image image) {
    const bool isCodes = image.format == Format::RGBA8 || image.format == Format::RGBA8Srgb;
    FILAMENT_ASSERT(isCodes || image.format == Format::RGBA16F || image.format == Format::RGBA32F,
                    "an image with straight alpha is RGBA8, RGBA8Srgb, RGBA16F or RGBA32F");
    const size_t bytes = texelBytes(image.format);
    const auto divide = isCodes ? divideCodes : image.format == Format::RGBA16F ? divideHalves : divideFloats;
    for (size_t at = 0; at + bytes <= image.pixels.size(); at += bytes)
        divide(std::span(image.pixels).subspan(at, bytes));
    return image;
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
