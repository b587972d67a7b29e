// SPDX-License-Identifier: Apache-2.0
#include "shaders/package/Deflate.h"

#include "base/Assert.h"
#include "shaders/package/ByteReader.h"
#include "shaders/package/PackageError.h"

#include <zlib.h>

#include <limits>
#include <new>

namespace filament_core::shader {
namespace {

constexpr int kRawDeflate = -MAX_WBITS; ///< zlib's sign for: neither header nor checksum
constexpr size_t kSizeBytes = 4;
/// RFC 1951: the best possible compression is matches of 258 bytes with two codes of one bit each.
constexpr uint64_t kMaxRatio = 258 * 8 / 2;

Bytef* zlibBytes(std::byte* bytes) { return reinterpret_cast<Bytef*>(bytes); }
Bytef* zlibInput(std::byte const* bytes) {
    return zlibBytes(const_cast<std::byte*>(bytes)); // zlib only reads it, although its parameter is not const
}

/// zlib's state for one direction; `end` destroys it.
struct Stream {
    z_stream state{};
    int (*end)(z_stream*);

    explicit Stream(int (*ender)(z_stream*)) : end(ender) {}
    Stream(Stream const&) = delete;
    Stream& operator=(Stream const&) = delete;
    ~Stream() { end(&state); }
};

void checkMemory(int code) {
    if (code == Z_MEM_ERROR) throw std::bad_alloc();
}

/// Processes all of `in` in one call of `step`; returns zlib's result.
int runOnce(z_stream& state, int (*step)(z_stream*, int), std::span<const std::byte> in, std::span<std::byte> out) {
    state.next_in = zlibInput(in.data());
    state.avail_in = static_cast<uInt>(in.size());
    state.next_out = zlibBytes(out.data());
    state.avail_out = static_cast<uInt>(out.size());
    const int code = step(&state, Z_FINISH);
    checkMemory(code);
    return code;
}

void putSize(std::span<std::byte> out, size_t size) {
    for (size_t i = 0; i < kSizeBytes; ++i) out[i] = static_cast<std::byte>(size >> (8 * i));
}

} // namespace

std::vector<std::byte> deflateBytes(std::span<const std::byte> bytes) {
    constexpr int kLevel = 7;       // level 9 makes packages 2.3 % smaller, and compiling materials 14 % longer
    constexpr int kMemoryLevel = 9; // of 1 to 9; zlib's largest
    Stream stream(deflateEnd);
    checkMemory(deflateInit2(&stream.state, kLevel, Z_DEFLATED, kRawDeflate, kMemoryLevel, Z_DEFAULT_STRATEGY));
    const size_t bound = deflateBound(&stream.state, bytes.size());
    FILAMENT_ASSERT(bound <= std::numeric_limits<uInt>::max(), "less than 4 GiB can be deflated");
    std::vector<std::byte> out(kSizeBytes + bound);
    putSize(out, bytes.size());
    const int code = runOnce(stream.state, deflate, bytes, std::span(out).subspan(kSizeBytes));
    FILAMENT_ASSERT(code == Z_STREAM_END, "within its bound DEFLATE ends");
    out.resize(kSizeBytes + stream.state.total_out);
    return out;
}

Result<std::vector<std::byte>> inflateBytes(std::span<const std::byte> packed, uint32_t maxBytes) {
    ByteReader in(packed);
    const uint32_t size = in.u32();
    if (in.failed()) return corruptPackage("the compressed code ends within its size");
    const auto deflated = packed.subspan(kSizeBytes);
    if (size == 0) return corruptPackage("the compressed code claims to be empty");
    if (size > maxBytes) return corruptPackage("the compressed code claims more bytes than the engine accepts");
    if (size > kMaxRatio * deflated.size())
        return corruptPackage("the compressed code claims more bytes than it holds");

    Stream stream(inflateEnd);
    checkMemory(inflateInit2(&stream.state, kRawDeflate));
    std::vector<std::byte> out(size);
    const int code = runOnce(stream.state, inflate, deflated, out);
    if (code != Z_STREAM_END && code != Z_BUF_ERROR) return corruptPackage("the compressed code is malformed");
    if (code == Z_BUF_ERROR) return corruptPackage("the compressed code is cut short, or longer than it claims");
    if (stream.state.avail_out > 0) return corruptPackage("the compressed code is shorter than it claims");
    if (stream.state.avail_in > 0) return corruptPackage("bytes are left over behind the compressed code");
    return out;
}

} // namespace filament_core::shader
