// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/ImageDecoder.h"

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstdint>
#include <cstdio>

#include <jpeglib.h> // needs size_t and FILE
// after jpeglib.h
#include <jerror.h>

namespace filament_core::assets {
namespace {

constexpr int kMaxScans = 500;

/// Everything that libjpeg's callbacks need. Errors leave through longjmp: between setjmp and them lie only functions
/// without destructors.
struct JpegReading {
    std::span<const std::byte> bytes;
    jpeg_decompress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf out{};
    std::array<char, JMSG_LENGTH_MAX> reason{};

    explicit JpegReading(std::span<const std::byte> file) : bytes(file) {}
    ~JpegReading() { jpeg_destroy_decompress(&jpeg); }
    JpegReading(JpegReading const&) = delete;
    JpegReading& operator=(JpegReading const&) = delete;
};

JpegReading& readingOf(j_common_ptr common) { return *static_cast<JpegReading*>(common->client_data); }

[[noreturn]] void onError(j_common_ptr common) {
    JpegReading& reading = readingOf(common);
    common->err->format_message(common, reading.reason.data());
    std::longjmp(reading.out, 1); // NOLINT(cert-err52-cpp): libjpeg's way
}

// libjpeg continues with grey or a guess where data is damaged or missing; such an image is an error here. The
// other warnings are about bytes between segments and about tags.
void onMessage(j_common_ptr common, int level) {
    static constexpr std::array kDamage{ JWRN_ARITH_BAD_CODE, JWRN_BOGUS_PROGRESSION, JWRN_HIT_MARKER,
                                         JWRN_HUFF_BAD_CODE,  JWRN_JPEG_EOF,          JWRN_MUST_RESYNC,
                                         JWRN_NOT_SEQUENTIAL };
    const bool isDamage = level < 0 && std::ranges::find(kDamage, common->err->msg_code) != kDamage.end();
    if (isDamage) onError(common);
}

void onProgress(j_common_ptr common) {
    auto* jpeg = reinterpret_cast<j_decompress_ptr>(common);
    if (jpeg->input_scan_number <= kMaxScans) return;
    JpegReading& reading = readingOf(common);
    std::snprintf(reading.reason.data(), reading.reason.size(), "it has more than %d scans", kMaxScans);
    std::longjmp(reading.out, 1); // NOLINT(cert-err52-cpp)
}

bool readHeader(JpegReading& reading) {
    reading.jpeg.err = jpeg_std_error(&reading.errors);
    reading.errors.error_exit = onError;
    reading.errors.emit_message = onMessage;
    reading.jpeg.client_data = &reading;
    if (setjmp(reading.out)) return false; // NOLINT(cert-err52-cpp)
    jpeg_create_decompress(&reading.jpeg);
    reading.progress.progress_monitor = onProgress;
    reading.jpeg.progress = &reading.progress;
    jpeg_mem_src(&reading.jpeg, reinterpret_cast<const unsigned char*>(reading.bytes.data()), reading.bytes.size());
    jpeg_read_header(&reading.jpeg, TRUE);
    const bool isCmyk = reading.jpeg.num_components == 4;
    reading.jpeg.out_color_space = isCmyk ? JCS_CMYK : JCS_EXT_RGBA;
    reading.jpeg.dct_method = JDCT_ISLOW; // the same bits with and without SIMD
    reading.jpeg.do_fancy_upsampling = TRUE;
    reading.jpeg.do_block_smoothing = FALSE; // a guess
    return true;
}

bool start(JpegReading& reading) {
    if (setjmp(reading.out)) return false; // NOLINT(cert-err52-cpp)
    return jpeg_start_decompress(&reading.jpeg) == TRUE;
}

bool readRows(JpegReading& reading, unsigned char* pixels) {
    if (setjmp(reading.out)) return false; // NOLINT(cert-err52-cpp)
    const size_t rowBytes = size_t{ reading.jpeg.output_width } * 4;
    while (reading.jpeg.output_scanline < reading.jpeg.output_height) {
        JSAMPROW row = pixels + reading.jpeg.output_scanline * rowBytes;
        jpeg_read_scanlines(&reading.jpeg, &row, 1);
    }
    return jpeg_finish_decompress(&reading.jpeg) == TRUE;
}

// Adobe's programs write 255 - C, and so on.
void rgbaFromInvertedCmyk(std::span<std::byte> pixels) {
    for (size_t i = 0; i < pixels.size(); i += 4) {
        const auto black = static_cast<uint32_t>(pixels[i + 3]);
        for (size_t c = 0; c < 3; ++c)
            pixels[i + c] = static_cast<std::byte>((static_cast<uint32_t>(pixels[i + c]) * black + 127) / 255);
        pixels[i + 3] = std::byte{ 255 };
    }
}

Error failure(JpegReading const& reading, std::string_view name) {
    const size_t left = reading.jpeg.src ? reading.jpeg.src->bytes_in_buffer : 0;
    const size_t at = reading.bytes.size() - std::min(left, reading.bytes.size());
    return fail(ErrorCode::Corrupt, "image '{}' cannot be decoded: {} (at byte {} of {}); export it again", name,
                reading.reason.data(), at, reading.bytes.size());
}

} // namespace

Result<Image> decodeJpeg(std::span<const std::byte> bytes, std::string_view name) {
    JpegReading reading(bytes);
    if (!readHeader(reading)) return failure(reading, name);
    if (reading.jpeg.image_width > kMaxImageSide || reading.jpeg.image_height > kMaxImageSide)
        return fail(ErrorCode::Unsupported, "image '{}' is {} x {} pixels, more than {} on a side; make it smaller",
                    name, reading.jpeg.image_width, reading.jpeg.image_height, kMaxImageSide);
    if (!start(reading)) return failure(reading, name);
    Image image{ .width = reading.jpeg.output_width, .height = reading.jpeg.output_height, .data = {} };
    image.data.resize(image.levelBytes(0));
    if (!readRows(reading, reinterpret_cast<unsigned char*>(image.data.data()))) return failure(reading, name);
    if (reading.jpeg.out_color_space == JCS_CMYK) rgbaFromInvertedCmyk(image.data);
    return image;
}

} // namespace filament_core::assets
