// SPDX-License-Identifier: Apache-2.0
#include "shaders/package/Compression.h"

#include "base/Assert.h"
#include "shaders/package/ByteReader.h"
#include "shaders/package/PackageError.h"

#include <zstd.h>
#include <zstd_errors.h>

#include <limits>
#include <new>

namespace filament_core::shader {
namespace {

/// 42 MB of code a second; level 19 makes packages 15 % smaller and takes 25 times as long.
constexpr int kLevel = 9;
constexpr size_t kSizeBytes = 4;
/// RFC 8878, 3.1.1.2: a block of a repeated byte takes four bytes, and gives at most 128 KiB.
constexpr uint64_t kMaxRatio = (128 * 1024) / 4;

void putSize(std::span<std::byte> out, size_t size) {
    for (size_t i = 0; i < kSizeBytes; ++i) out[i] = static_cast<std::byte>(size >> (8 * i));
}

/// A result of the library, which is a size or an error.
size_t checkMemory(size_t result) {
    if (ZSTD_getErrorCode(result) == ZSTD_error_memory_allocation) throw std::bad_alloc();
    return result;
}

} // namespace

std::vector<std::byte> compressBytes(std::span<const std::byte> bytes) {
    FILAMENT_ASSERT(bytes.size() <= std::numeric_limits<uint32_t>::max(), "less than 4 GiB can be compressed");
    std::vector<std::byte> out(kSizeBytes + ZSTD_compressBound(bytes.size()));
    putSize(out, bytes.size());
    const size_t packed = checkMemory(
            ZSTD_compress(out.data() + kSizeBytes, out.size() - kSizeBytes, bytes.data(), bytes.size(), kLevel));
    FILAMENT_ASSERT(!ZSTD_isError(packed), "within its bound Zstandard ends");
    out.resize(kSizeBytes + packed);
    return out;
}

Result<std::vector<std::byte>> decompressBytes(std::span<const std::byte> packed, uint32_t maxBytes) {
    ByteReader in(packed);
    const uint32_t size = in.u32();
    if (in.failed()) return corruptPackage("the compressed code ends within its size");
    const auto frame = packed.subspan(kSizeBytes);
    if (size == 0) return corruptPackage("the compressed code claims to be empty");
    if (size > maxBytes) return corruptPackage("the compressed code claims more bytes than the engine accepts");
    if (size > kMaxRatio * frame.size()) return corruptPackage("the compressed code claims more bytes than it holds");

    const size_t length = ZSTD_findFrameCompressedSize(frame.data(), frame.size());
    if (ZSTD_getErrorCode(length) == ZSTD_error_srcSize_wrong)
        return corruptPackage("the compressed code is cut short");
    if (ZSTD_isError(length)) return corruptPackage("the compressed code is malformed");
    if (length < frame.size()) return corruptPackage("bytes are left over behind the compressed code");
    if (ZSTD_getFrameContentSize(frame.data(), frame.size()) != size)
        return corruptPackage("the compressed code is longer or shorter than it claims");

    std::vector<std::byte> out(size);
    const size_t unpacked = checkMemory(ZSTD_decompress(out.data(), out.size(), frame.data(), frame.size()));
    if (ZSTD_isError(unpacked) || unpacked != size) return corruptPackage("the compressed code is malformed");
    return out;
}

} // namespace filament_core::shader
