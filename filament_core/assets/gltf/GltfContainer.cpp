// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/GltfContainer.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace filament_core::assets {
namespace {

constexpr uint32_t kGlbMagic = 0x46546C67;  // "glTF"
constexpr uint32_t kJsonChunk = 0x4E4F534A; // "JSON"
constexpr uint32_t kBinChunk = 0x004E4942;  // "BIN\0"
constexpr size_t kHeaderBytes = 12, kChunkHeaderBytes = 8;

uint32_t wordAt(std::span<const std::byte> bytes, size_t offset) {
    uint32_t word; // GLB is little-endian, like all our platforms
    std::memcpy(&word, bytes.data() + offset, sizeof word);
    return word;
}

/// JSON begins with a brace, after blanks or the mark of UTF-8.
bool looksLikeJson(std::span<const std::byte> file) {
    constexpr std::string_view kMark = "\xEF\xBB\xBF", kBlanks = " \t\r\n";
    std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
    if (text.starts_with(kMark)) text.remove_prefix(kMark.size());
    const size_t first = text.find_first_not_of(kBlanks);
    return first != std::string_view::npos && text[first] == '{';
}

Error notGltf(std::span<const std::byte> file) {
    std::string bytes;
    for (const std::byte byte : file.first(std::min<size_t>(file.size(), 4)))
        bytes += fmt::format(" {:02X}", static_cast<unsigned>(byte));
    return fail(ErrorCode::Corrupt,
                "begins with the bytes{}: neither a GLB (67 6C 54 46, \"glTF\") nor the JSON of a .gltf (\"{{\")",
                bytes);
}

} // namespace

Result<GltfContainer> openGltfContainer(std::span<const std::byte> file) {
    if (file.empty()) return fail(ErrorCode::Corrupt, "the file is empty");
    if (file.size() < 4 || wordAt(file, 0) != kGlbMagic) {
        if (!looksLikeJson(file)) return notGltf(file);
        return GltfContainer{ .json = file, .binary = {} };
    }
    if (file.size() < kHeaderBytes) return fail(ErrorCode::Corrupt, "the GLB header is cut off");
    if (const uint32_t version = wordAt(file, 4); version != 2) {
        return fail(ErrorCode::Unsupported, "GLB version {} is not 2", version);
    }
    const size_t length = wordAt(file, 8);
    if (length > file.size()) {
        return fail(ErrorCode::Corrupt, "the GLB header promises {} bytes, the file has {}", length, file.size());
    }
    if (length < kHeaderBytes) {
        return fail(ErrorCode::Corrupt, "the GLB header promises {} bytes, fewer than its own {}", length,
                    kHeaderBytes);
    }
    GltfContainer container;
    size_t at = kHeaderBytes;
    for (uint32_t chunk = 0; at + kChunkHeaderBytes <= length; ++chunk) {
        const size_t bytes = wordAt(file, at);
        const uint32_t type = wordAt(file, at + 4);
        at += kChunkHeaderBytes;
        if (bytes > length - at) {
            return fail(ErrorCode::Corrupt, "GLB chunk {} has {} bytes, only {} are left in the file", chunk, bytes,
                        length - at);
        }
        if (chunk == 0 && type != kJsonChunk) return fail(ErrorCode::Corrupt, "the first GLB chunk is not JSON");
        if (chunk == 0) container.json = file.subspan(at, bytes);
        if (chunk == 1 && type == kBinChunk) {
            container.binary = file.subspan(at, bytes);
            container.hasBinary = true;
        }
        at += bytes;
    }
    if (at != length) {
        return fail(ErrorCode::Corrupt, "the GLB ends {} bytes into a chunk header of 8; export or copy it again",
                    length - at);
    }
    if (container.json.empty()) return fail(ErrorCode::Corrupt, "the GLB has no JSON chunk");
    return container;
}

} // namespace filament_core::assets
