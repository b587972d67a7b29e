// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/ImageDecoder.h"

#include "filament_core/assets/image/ImageSize.h"

namespace filament_core::assets {
namespace {

bool begins(std::span<const std::byte> bytes, std::string_view magic) {
    if (bytes.size() < magic.size()) return false;
    for (size_t i = 0; i < magic.size(); ++i) {
        if (static_cast<char>(bytes[i]) != magic[i]) return false;
    }
    return true;
}

bool beginsAsPng(std::span<const std::byte> bytes) { return begins(bytes, "\x89PNG"); }
bool beginsAsJpeg(std::span<const std::byte> bytes) { return begins(bytes, "\xFF\xD8"); }

} // namespace

bool isPngOrJpeg(std::span<const std::byte> bytes) { return beginsAsPng(bytes) || beginsAsJpeg(bytes); }

bool isDeepPng(std::span<const std::byte> bytes) {
    constexpr size_t kTypeOfFirstChunk = 12, kBitDepth = 24; // ISO/IEC 15948, 5.2 and 11.2.2
    return beginsAsPng(bytes) && bytes.size() > kBitDepth && begins(bytes.subspan(kTypeOfFirstChunk), "IHDR") &&
           bytes[kBitDepth] == std::byte{ 16 };
}

Result<void> checkPngOrJpeg(std::span<const std::byte> bytes, std::string_view name) {
    if (!isPngOrJpeg(bytes))
        return fail(ErrorCode::Unsupported, "image '{}' is none of PNG, JPEG, WebP and AVIF; convert it to one of them",
                    name);
    const uint2 size = imageSize(bytes);
    if (size.x > kMaxImageSide || size.y > kMaxImageSide)
        return fail(ErrorCode::Unsupported, "image '{}' is {} x {} pixels, more than {} on a side; make it smaller",
                    name, size.x, size.y, kMaxImageSide);
    if (beginsAsPng(bytes) && isCutShortPng(bytes))
        return fail(ErrorCode::Corrupt, "image '{}' cannot be decoded: the file is cut short; export it again", name);
    return {};
}

Result<Image> decodeImage(std::span<const std::byte> bytes, std::string_view name) {
    if (isWebp(bytes)) return decodeWebp(bytes, name);
    if (isAvif(bytes)) return decodeAvif(bytes, name);
    if (Result<void> checked = checkPngOrJpeg(bytes, name); !checked) return checked.error();
    return beginsAsPng(bytes) ? decodePng(bytes, name) : decodeJpeg(bytes, name);
}

bool isDeepImage(std::span<const std::byte> bytes) { return isDeepPng(bytes) || isDeepAvif(bytes); }

Result<DeepImage> decodeDeepImage(std::span<const std::byte> bytes, std::string_view name) {
    if (isAvif(bytes)) return decodeDeepAvif(bytes, name);
    if (Result<void> checked = checkPngOrJpeg(bytes, name); !checked) return checked.error();
    return decodeDeepPng(bytes, name);
}

} // namespace filament_core::assets
