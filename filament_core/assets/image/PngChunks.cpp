// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/PngChunks.h"

#include <zlib.h>

namespace filament_core::assets {

void appendPngWord(std::vector<std::byte>& bytes, uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::byte>(value >> shift & 0xFF));
}

void appendPngChunk(std::vector<std::byte>& bytes, std::string_view name, std::span<const std::byte> data) {
    appendPngWord(bytes, static_cast<uint32_t>(data.size()));
    const size_t first = bytes.size();
    for (const char c : name) bytes.push_back(static_cast<std::byte>(c));
    bytes.insert(bytes.end(), data.begin(), data.end());
    const auto* checked = reinterpret_cast<const Bytef*>(bytes.data() + first);
    appendPngWord(bytes, static_cast<uint32_t>(crc32(0, checked, static_cast<uInt>(bytes.size() - first))));
}

} // namespace filament_core::assets
