// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/ImageDecoder.h"

#include "filament_core/assets/image/ImageSize.h"

namespace filament::assets {
namespace {

bool begins(std::span<const std::byte> bytes, std::string_view magic) {
    if (bytes.size() < magic.size()) return false;
    for (size_t i = 0; i < magic.size(); ++i) {
        if (static_cast<char>(bytes[i]) != magic[i]) return false;
    }
    return true;
}

} // namespace

Result<Image> decodeImage(std::span<const std::byte> bytes, std::string_view name) {
    const bool isPng = begins(bytes, "\x89PNG");
    if (!isPng && !begins(bytes, "\xFF\xD8"))
        return fail(ErrorCode::Unsupported, "image '{}' is neither PNG nor JPEG; convert it to one of them", name);
    const uint2 size = imageSize(bytes);
    if (size.x > kMaxImageSide || size.y > kMaxImageSide)
        return fail(ErrorCode::Unsupported, "image '{}' is {} x {} pixels, more than {} on a side; make it smaller",
                    name, size.x, size.y, kMaxImageSide);
    if (isPng && isCutShortPng(bytes))
        return fail(ErrorCode::Corrupt, "image '{}' cannot be decoded: the file is cut short; export it again", name);
    return isPng ? decodePng(bytes, name) : decodeJpeg(bytes, name);
}

} // namespace filament::assets
