// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/ImageDecoder.h"

#include <webp/decode.h>

#include <cstring>

namespace filament_core::assets {
namespace {

const uint8_t* webpBytes(std::span<const std::byte> bytes) { return reinterpret_cast<const uint8_t*>(bytes.data()); }

const char* reasonOf(VP8StatusCode status) {
    switch (status) {
    case VP8_STATUS_OUT_OF_MEMORY:
        return "out of memory";
    case VP8_STATUS_NOT_ENOUGH_DATA:
    case VP8_STATUS_SUSPENDED:
        return "the file is cut short";
    case VP8_STATUS_UNSUPPORTED_FEATURE:
        return "it has parts that WebP does not know";
    default:
        return "its data are damaged";
    }
}

Error webpFailure(VP8StatusCode status, std::string_view name) {
    const ErrorCode code = status == VP8_STATUS_OUT_OF_MEMORY ? ErrorCode::OutOfMemory : ErrorCode::Corrupt;
    return fail(code, "image '{}' cannot be decoded: {}; export it again", name, reasonOf(status));
}

} // namespace

bool isWebp(std::span<const std::byte> bytes) {
    return bytes.size() >= 12 && std::memcmp(bytes.data(), "RIFF", 4) == 0 &&
           std::memcmp(bytes.data() + 8, "WEBP", 4) == 0;
}

uint2 webpSize(std::span<const std::byte> bytes) {
    WebPBitstreamFeatures features{};
    if (!isWebp(bytes) || WebPGetFeatures(webpBytes(bytes), bytes.size(), &features) != VP8_STATUS_OK) return uint2(0);
    return { static_cast<uint32_t>(features.width), static_cast<uint32_t>(features.height) };
}

Result<Image> decodeWebp(std::span<const std::byte> bytes, std::string_view name) {
    if (!isWebp(bytes)) return webpFailure(VP8_STATUS_BITSTREAM_ERROR, name); // libwebp reads more than files
    WebPDecoderConfig config;
    if (!WebPInitDecoderConfig(&config)) return webpFailure(VP8_STATUS_UNSUPPORTED_FEATURE, name);
    if (const VP8StatusCode status = WebPGetFeatures(webpBytes(bytes), bytes.size(), &config.input);
        status != VP8_STATUS_OK)
        return webpFailure(status, name);
    if (config.input.has_animation)
        return fail(ErrorCode::Unsupported, "image '{}' is an animation; export one picture of it", name);
    Image image;
    image.width = static_cast<uint32_t>(config.input.width), image.height = static_cast<uint32_t>(config.input.height);
    image.data.resize(image.levelBytes(0));
    config.output.colorspace = MODE_RGBA; // alpha is not multiplied in
    config.output.is_external_memory = 1;
    config.output.u.RGBA = { .rgba = reinterpret_cast<uint8_t*>(image.data.data()),
                             .stride = config.input.width * 4,
                             .size = image.data.size() };
    const VP8StatusCode status = WebPDecode(webpBytes(bytes), bytes.size(), &config);
    WebPFreeDecBuffer(&config.output);
    if (status != VP8_STATUS_OK) return webpFailure(status, name);
    return image;
}

} // namespace filament_core::assets
