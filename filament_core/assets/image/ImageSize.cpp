// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/ImageSize.h"

#include "filament_core/assets/image/DdsDecoder.h"
#include "filament_core/assets/image/ImageDecoder.h"
#include "filament_core/assets/image/Ktx2File.h"

#include <cstdint>
#include <string_view>

namespace filament_core::assets {
namespace {

using FileSpan = std::span<const std::byte>;

uint32_t number(FileSpan bytes, size_t at, size_t count) { // big-endian
    uint32_t value = 0;
    for (size_t i = 0; i < count; ++i) value = value << 8 | static_cast<uint32_t>(bytes[at + i]);
    return value;
}

bool isPng(FileSpan bytes) { return bytes.size() >= 8 && number(bytes, 0, 4) == 0x89504E47; }

/// Calls visit(type, first byte of the contents, length) for every chunk whose header is there, until it returns false.
template <class Visit>
void forEachChunk(FileSpan bytes, Visit&& visit) {
    for (size_t at = 8; at + 8 <= bytes.size();) {
        const uint64_t length = number(bytes, at, 4);
        if (!visit(number(bytes, at + 4, 4), at + 8, length)) return;
        at += length + 12; // length, type, check sum
    }
}

constexpr uint32_t kHeaderChunk = 0x49484452, kTransparentChunk = 0x74524E53, kDataChunk = 0x49444154,
                   kEndChunk = 0x49454E44; // "IHDR", "tRNS", "IDAT", "IEND"

uint2 pngSize(FileSpan bytes) {
    uint2 size(0);
    forEachChunk(bytes, [&](uint32_t type, size_t at, uint64_t) {
        if (type != kHeaderChunk) return true;
        if (at + 8 <= bytes.size()) size = { number(bytes, at, 4), number(bytes, at + 4, 4) };
        return false;
    });
    return size;
}

/// ITU T.81, annex B: frames are C0 to CF, without the tables C4, C8 and CC; the largest counts.
uint2 jpegSize(FileSpan bytes) {
    uint2 size(0);
    for (size_t at = 2; at + 4 <= bytes.size();) {
        const uint32_t marker = number(bytes, at + 1, 1);
        if (number(bytes, at, 1) != 0xFF || marker == 0xFF || marker == 0) {
            ++at; // a fill byte, or the data of a scan
            continue;
        }
        const bool isAlone = marker == 0x01 || (marker >= 0xD0 && marker <= 0xD8);
        const bool isFrame = marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
        if (marker == 0xD9) break; // the end
        if (isFrame && at + 9 <= bytes.size())
            size = glm::max(size, uint2(number(bytes, at + 7, 2), number(bytes, at + 5, 2)));
        at += isAlone ? 2 : 2 + number(bytes, at + 2, 2);
        if (marker == 0xDA) break; // a scan: the sizes are in front of it
    }
    return size;
}

} // namespace

uint2 imageSize(std::span<const std::byte> bytes) {
    if (isPng(bytes)) return pngSize(bytes);
    if (isWebp(bytes)) return webpSize(bytes);
    if (isAvif(bytes)) return avifSize(bytes);
    if (isKtx2(bytes)) return ktx2Size(bytes);
    if (isDds(bytes)) return ddsSize(bytes);
    const bool isJpeg = bytes.size() >= 4 && number(bytes, 0, 2) == 0xFFD8;
    return isJpeg ? jpegSize(bytes) : uint2(0);
}

bool isCutShortPng(std::span<const std::byte> bytes) {
    if (!isPng(bytes)) return false;
    bool hasEnd = false;
    forEachChunk(bytes, [&](uint32_t type, size_t at, uint64_t length) {
        hasEnd = type == kEndChunk && at + length <= bytes.size();
        return !hasEnd;
    });
    return !hasEnd;
}

bool hasAlphaPng(std::span<const std::byte> bytes) {
    if (!isPng(bytes)) return false;
    bool hasAlpha = false;
    forEachChunk(bytes, [&](uint32_t type, size_t at, uint64_t) { // ISO/IEC 15948, 11.2.2 and 11.3.2.1
        constexpr size_t kColourType = 9;
        if (type == kHeaderChunk && at + kColourType < bytes.size())
            hasAlpha = (number(bytes, at + kColourType, 1) & 4u) != 0;
        if (type == kTransparentChunk) hasAlpha = true;
        return !hasAlpha && type != kDataChunk;
    });
    return hasAlpha;
}

} // namespace filament_core::assets
