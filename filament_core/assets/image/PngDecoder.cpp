// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/ImageDecoder.h"

#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstdio>
#include <cstring>

namespace filament_core::assets {
namespace {

/// Everything that libpng's callbacks need. Errors leave through longjmp: between setjmp and them lie only functions
/// without destructors.
struct PngReading {
    std::span<const std::byte> bytes;
    size_t at = 0;
    std::array<char, 128> reason{};
    png_structp png = nullptr;
    png_infop info = nullptr;
    uint32_t width = 0, height = 0;
    bool isDeep = false; ///< 16 bits a channel, otherwise 8

    explicit PngReading(std::span<const std::byte> file, bool asDeep) : bytes(file), isDeep(asDeep) {}
    size_t rowBytes() const { return size_t{ width } * (isDeep ? 8 : 4); }
    ~PngReading() { png_destroy_read_struct(&png, &info, nullptr); }
    PngReading(PngReading const&) = delete;
    PngReading& operator=(PngReading const&) = delete;
};

[[noreturn]] void onError(png_structp png, png_const_charp reason) {
    auto* reading = static_cast<PngReading*>(png_get_error_ptr(png));
    std::snprintf(reading->reason.data(), reading->reason.size(), "%s", reason);
    png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {} // of chunks that do not change pixels

void onRead(png_structp png, png_bytep target, size_t count) {
    auto* reading = static_cast<PngReading*>(png_get_io_ptr(png));
    if (count > reading->bytes.size() - reading->at) png_error(png, "the file is cut short");
    std::memcpy(target, reading->bytes.data() + reading->at, count);
    reading->at += count;
}

// Any PNG becomes RGBA of 8 or 16 bits: ISO/IEC 15948, 13.12 (sample depth scaling).
void askForRgba(PngReading& reading) {
    if (reading.isDeep) {
        png_set_expand_16(reading.png); // palettes, fewer than 16 bits, a transparent colour
        if constexpr (std::endian::native == std::endian::little) png_set_swap(reading.png);
    } else {
        png_set_expand(reading.png);
        png_set_scale_16(reading.png);
    }
    png_set_gray_to_rgb(reading.png);
    png_set_add_alpha(reading.png, reading.isDeep ? 0xFFFF : 0xFF, PNG_FILLER_AFTER);
    png_set_interlace_handling(reading.png);
    png_read_update_info(reading.png, reading.info);
}

bool readHeader(PngReading& reading) {
    if (setjmp(png_jmpbuf(reading.png))) return false; // NOLINT(cert-err52-cpp): libpng's way
    png_set_user_limits(reading.png, kMaxImageSide, kMaxImageSide);
    png_set_read_fn(reading.png, &reading, onRead);
    png_read_info(reading.png, reading.info);
    reading.width = png_get_image_width(reading.png, reading.info);
    reading.height = png_get_image_height(reading.png, reading.info);
    askForRgba(reading);
    if (png_get_rowbytes(reading.png, reading.info) != reading.rowBytes())
        png_error(reading.png, "its pixels do not convert to RGBA");
    return true;
}

bool readRows(PngReading& reading, png_bytep* rows) {
    if (setjmp(png_jmpbuf(reading.png))) return false; // NOLINT(cert-err52-cpp)
    png_read_image(reading.png, rows);
    png_read_end(reading.png, nullptr);
    return true;
}

Error failure(PngReading const& reading, std::string_view name) {
    return fail(ErrorCode::Corrupt, "image '{}' cannot be decoded: {} (at byte {} of {}); export it again", name,
                reading.reason.data(), reading.at, reading.bytes.size());
}

/// `memory(reading)` returns where the rows go, once their number and length are known.
template <class Memory>
Result<void> readPng(PngReading& reading, std::string_view name, Memory const& memory) {
    reading.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reading, onError, onWarning);
    if (reading.png) reading.info = png_create_info_struct(reading.png);
    if (!reading.info) return fail(ErrorCode::OutOfMemory, "image '{}': out of memory; free some and try again", name);
    if (!readHeader(reading)) return failure(reading, name);
    auto* const pixels = static_cast<png_bytep>(memory(reading));
    std::vector<png_bytep> rows(reading.height);
    for (uint32_t y = 0; y < reading.height; ++y) rows[y] = pixels + y * reading.rowBytes();
    if (!readRows(reading, rows.data())) return failure(reading, name);
    return {};
}

} // namespace

Result<Image> decodePng(std::span<const std::byte> bytes, std::string_view name) {
    PngReading reading(bytes, false);
    Image image;
    const Result<void> read = readPng(reading, name, [&](PngReading const& header) -> void* {
        image.width = header.width, image.height = header.height;
        image.data.resize(image.levelBytes(0));
        return image.data.data();
    });
    if (!read) return read.error();
    return image;
}

Result<DeepImage> decodeDeepPng(std::span<const std::byte> bytes, std::string_view name) {
    PngReading reading(bytes, true);
    DeepImage image;
    const Result<void> read = readPng(reading, name, [&](PngReading const& header) -> void* {
        image.width = header.width, image.height = header.height;
        image.codes.resize(size_t{ image.width } * image.height * 4);
        return image.codes.data();
    });
    if (!read) return read.error();
    return image;
}

} // namespace filament_core::assets
