// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/Ktx2Inflate.h"

#include <zlib.h>
#include <zstd.h>

#include <string>

namespace filament_core::assets {
namespace {

/// An empty text, or why the bytes are not those of `buffer`.
std::string unpackZstandard(std::span<const std::byte> bytes, std::vector<std::byte>& buffer) {
    const size_t size = ZSTD_decompress(buffer.data(), buffer.size(), bytes.data(), bytes.size());
    if (ZSTD_isError(size)) return fmt::format("Zstandard: {}", ZSTD_getErrorName(size));
    return size == buffer.size() ? std::string() : fmt::format("{} bytes instead of {}", size, buffer.size());
}

std::string unpackZlib(std::span<const std::byte> bytes, std::vector<std::byte>& buffer) {
    auto size = static_cast<uLongf>(buffer.size());
    const int result = uncompress(reinterpret_cast<Bytef*>(buffer.data()), &size,
                                  reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uLong>(bytes.size()));
    if (result != Z_OK) return fmt::format("zlib: {}", zError(result));
    return size == buffer.size() ? std::string() : fmt::format("{} bytes instead of {}", size, buffer.size());
}

Error damagedLevel(std::string_view name, uint32_t level, std::string const& what) {
    return fail(ErrorCode::Corrupt, "image '{}' cannot be decoded: level {}: {}; export it again", name, level, what);
}

} // namespace

Result<void> checkLevel(Ktx2File const& file, uint32_t level, uint64_t expected, std::string_view name) {
    constexpr uint64_t kMostPerByte = uint64_t{ 1 } << 17; // more than the best ratios of both
    Ktx2Level const& packed = file.levels[level];
    const bool isPlain = file.compression == Ktx2Compression::None;
    const uint64_t stated = isPlain ? packed.bytes.size() : packed.plainBytes;
    if (stated != expected) return damagedLevel(name, level, fmt::format("{} bytes instead of {}", stated, expected));
    if (expected / kMostPerByte > packed.bytes.size())
        return damagedLevel(name, level, "its compressed bytes are cut short");
    return {};
}

Result<std::span<const std::byte>> inflatedLevel(Ktx2File const& file, uint32_t level, uint64_t expected,
                                                 std::string_view name, std::vector<std::byte>& buffer) {
    Ktx2Level const& packed = file.levels[level];
    if (file.compression == Ktx2Compression::None) return packed.bytes;
    buffer.resize(expected);
    const std::string reason = file.compression == Ktx2Compression::Zstandard ? unpackZstandard(packed.bytes, buffer)
                                                                              : unpackZlib(packed.bytes, buffer);
    if (!reason.empty()) return damagedLevel(name, level, reason);
    return std::span<const std::byte>(buffer);
}

} // namespace filament_core::assets
