// SPDX-License-Identifier: Apache-2.0
// The only translation unit that contains stb_image, as static functions: other libraries have their own copies.
#include "filament_core/assets/image/StbImage.h"

#include "filament_core/assets/image/ImageSize.h"

#include <cstring>
#include <limits>
#include <memory>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_STDIO
#define STBI_FAILURE_USERMSG
#define STBI_MAX_DIMENSIONS 16384
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wshadow"
#include <stb/stb_image.h>
#pragma GCC diagnostic pop

namespace filament::assets {
namespace {

struct StbFree {
    void operator()(stbi_uc* pixels) const { stbi_image_free(pixels); }
};

bool isPngOrJpeg(std::span<const std::byte> bytes) {
    const auto at = [&](size_t i) { return static_cast<uint8_t>(bytes[i]); };
    return bytes.size() >= 4 &&
           ((at(0) == 0x89 && at(1) == 'P' && at(2) == 'N' && at(3) == 'G') || (at(0) == 0xFF && at(1) == 0xD8));
}

} // namespace

Result<Image> decodeImage(std::span<const std::byte> bytes, std::string_view name) {
    if (!isPngOrJpeg(bytes)) {
        return fail(ErrorCode::Unsupported, "image '{}' is neither PNG nor JPEG; convert it to one of them", name);
    }
    if (bytes.size() > static_cast<size_t>(std::numeric_limits<int>::max())) {
        return fail(ErrorCode::Unsupported, "image '{}' is larger than 2 GiB; make it smaller", name);
    }
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const int size = static_cast<int>(bytes.size());
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<stbi_uc, StbFree> pixels(stbi_load_from_memory(data, size, &width, &height, &channels, 4));
    if (!pixels) {
        const char* reason = isCutShortPng(bytes) ? "the file is cut short" : stbi_failure_reason();
        return fail(ErrorCode::Corrupt, "image '{}' cannot be decoded: {}; export it again", name,
                    reason ? reason : "unknown reason");
    }
    Image image{ .width = static_cast<uint32_t>(width), .height = static_cast<uint32_t>(height), .data = {} };
    image.data.resize(image.levelBytes(0));
    std::memcpy(image.data.data(), pixels.get(), image.data.size());
    return image;
}

} // namespace filament::assets
