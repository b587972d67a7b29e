// SPDX-License-Identifier: Apache-2.0
#include "tests/filament_core/assets/image/PictureFiles.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <span>

#include <png.h>
// after <cstdio>
#include <jpeglib.h>

namespace filament_core::assets::test {
namespace {

void append(png_structp png, png_bytep data, size_t size) {
    auto* bytes = static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
    const auto added = std::as_bytes(std::span(data, size));
    bytes->insert(bytes->end(), added.begin(), added.end());
}

int channelsOf(PngKind const& kind) {
    switch (kind.colorType) {
    case PNG_COLOR_TYPE_RGB:
        return 3;
    case PNG_COLOR_TYPE_GRAY_ALPHA:
        return 2;
    case PNG_COLOR_TYPE_RGB_ALPHA:
        return 4;
    default:
        return 1;
    }
}

uint32_t scaled(uint32_t sample, uint32_t from, uint32_t to) {
    return static_cast<uint32_t>(std::floor(static_cast<double>(sample) * to / from + 0.5));
}

constexpr uint8_t kPaletteColor = 37; // entry i: (37 i, 37 i + 1, 37 i + 2) modulo 256
constexpr uint32_t kClear = 1;        // with tRNS: the transparent sample or entry

/// With codes up to `largest`.
std::array<uint32_t, 4> expectedPixel(PngKind const& kind, std::span<const uint32_t> samples, uint32_t largest) {
    const auto ofPalette = [&](uint32_t value) { return scaled(value % 256, 255, largest); };
    const bool isClear = kind.transparentColor && samples[0] == kClear && samples.back() == kClear;
    const uint32_t alpha = isClear ? 0 : largest;
    if (kind.colorType == PNG_COLOR_TYPE_PALETTE) {
        const uint32_t base = kPaletteColor * samples[0];
        return { ofPalette(base), ofPalette(base + 1), ofPalette(base + 2), alpha };
    }
    std::array<uint32_t, 4> codes{};
    for (size_t i = 0; i < samples.size(); ++i) codes[i] = scaled(samples[i], (1u << kind.depth) - 1, largest);
    if (samples.size() == 1) return { codes[0], codes[0], codes[0], alpha };
    if (samples.size() == 2) return { codes[0], codes[0], codes[0], codes[1] };
    if (samples.size() == 3) return { codes[0], codes[1], codes[2], alpha };
    return codes;
}

void writePalette(png_structp png, png_infop info, PngKind const& kind) {
    std::array<png_color, 256> palette{};
    for (size_t i = 0; i < palette.size(); ++i) {
        const auto base = static_cast<uint8_t>(kPaletteColor * i);
        palette[i] = { base, static_cast<uint8_t>(base + 1), static_cast<uint8_t>(base + 2) };
    }
    if (kind.colorType == PNG_COLOR_TYPE_PALETTE) png_set_PLTE(png, info, palette.data(), 1 << kind.depth);
    std::array<png_byte, 2> alphas{ 255, 0 };
    png_color_16 clear{ .index = 0, .red = kClear, .green = kClear, .blue = kClear, .gray = kClear };
    if (kind.transparentColor)
        png_set_tRNS(png, info, alphas.data(), kind.colorType == PNG_COLOR_TYPE_PALETTE ? 2 : 0, &clear);
}

} // namespace

std::vector<PngKind> pngKinds() {
    std::vector<PngKind> kinds;
    for (const bool interlaced : { false, true }) {
        for (const int depth : { 1, 2, 4, 8, 16 }) kinds.push_back({ PNG_COLOR_TYPE_GRAY, depth, interlaced });
        for (const int depth : { 1, 2, 4, 8 }) kinds.push_back({ PNG_COLOR_TYPE_PALETTE, depth, interlaced });
        for (const int type : { PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB_ALPHA }) {
            for (const int depth : { 8, 16 }) kinds.push_back({ type, depth, interlaced });
        }
        kinds.push_back({ PNG_COLOR_TYPE_GRAY, 2, interlaced, true });
        kinds.push_back({ PNG_COLOR_TYPE_PALETTE, 4, interlaced, true });
        kinds.push_back({ PNG_COLOR_TYPE_RGB, 8, interlaced, true });
    }
    return kinds;
}

std::string pngKindName(PngKind const& kind) {
    static constexpr std::array kNames{ "Grey", "", "Rgb", "Palette", "GreyAlpha", "", "Rgba" };
    return fmt::format("{}{}{}{}", kNames[static_cast<size_t>(kind.colorType)], kind.depth,
                       kind.transparentColor ? "Clear" : "", kind.interlaced ? "Interlaced" : "");
}

PngFile makePng(PngKind const& kind, uint32_t width, uint32_t height) {
    PngFile file;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &file.bytes, append, nullptr);
    png_set_IHDR(png, info, width, height, kind.depth, kind.colorType,
                 kind.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    writePalette(png, info, kind);
    png_write_info(png, info);
    const auto channels = static_cast<size_t>(channelsOf(kind));
    std::mt19937 random(static_cast<uint32_t>(kind.colorType * 100 + kind.depth));
    std::vector<std::vector<png_byte>> rows(height);
    for (auto& row : rows) {
        row.resize((width * channels * static_cast<size_t>(kind.depth) + 7) / 8);
        for (uint32_t x = 0; x < width; ++x) {
            std::vector<uint32_t> samples(channels);
            const bool isClear = random() % 3 == 0;
            for (size_t c = 0; c < channels; ++c) {
                samples[c] = isClear ? kClear : static_cast<uint32_t>(random()) & ((1u << kind.depth) - 1);
                const size_t bit = (x * channels + c) * static_cast<size_t>(kind.depth);
                if (kind.depth == 16)
                    row[bit / 8] = static_cast<png_byte>(samples[c] >> 8),
                              row[bit / 8 + 1] = static_cast<png_byte>(samples[c]);
                else
                    row[bit / 8] = static_cast<png_byte>(row[bit / 8] |
                                                         samples[c] << (8 - kind.depth - static_cast<int>(bit % 8)));
            }
            for (const uint32_t code : expectedPixel(kind, samples, 255)) file.rgba.push_back(std::byte(code));
            for (const uint32_t code : expectedPixel(kind, samples, 65535)) file.deep.push_back(uint16_t(code));
        }
    }
    std::vector<png_bytep> pointers;
    for (auto& row : rows) pointers.push_back(row.data());
    png_write_image(png, pointers.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return file;
}

std::vector<JpegKind> jpegKinds() {
    return { { 1, false, false }, { 3, false, false }, { 3, false, true }, { 3, true, false },
             { 3, true, true },   { 4, false, false }, { 4, true, false } };
}

std::string jpegKindName(JpegKind const& kind) {
    static constexpr std::array kNames{ "", "Grey", "", "Colour", "Cmyk" };
    return fmt::format("{}{}{}", kNames[static_cast<size_t>(kind.components)], kind.progressive ? "Progressive" : "",
                       kind.subsampled ? "Subsampled" : "");
}

std::array<double, 3> jpegPixel(JpegKind const& kind, uint32_t x, uint32_t y) {
    const double red = 128 + 100 * std::sin(x * 0.11), green = 128 + 90 * std::cos(y * 0.13);
    if (kind.components == 1) return { red, red, red };
    return { red, green, 128 + 80 * std::sin((x + y) * 0.07) };
}

std::vector<std::byte> makeJpeg(JpegKind const& kind, uint32_t width, uint32_t height) {
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* target = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &target, &size);
    jpeg.image_width = width;
    jpeg.image_height = height;
    jpeg.input_components = kind.components;
    jpeg.in_color_space = kind.components == 1 ? JCS_GRAYSCALE : kind.components == 3 ? JCS_RGB : JCS_CMYK;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 95, TRUE);
    if (kind.components == 4) jpeg_set_colorspace(&jpeg, JCS_YCCK);
    if (!kind.subsampled)
        for (int c = 0; c < jpeg.num_components; ++c)
            jpeg.comp_info[c].h_samp_factor = jpeg.comp_info[c].v_samp_factor = 1;
    if (kind.progressive) jpeg_simple_progression(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    std::vector<unsigned char> row;
    for (uint32_t y = 0; y < height; ++y) {
        row.clear();
        for (uint32_t x = 0; x < width; ++x) {
            const auto color = jpegPixel(kind, x, y);
            for (int c = 0; c < std::min(kind.components, 3); ++c)
                row.push_back(static_cast<unsigned char>(std::lround(color[static_cast<size_t>(c)])));
            if (kind.components == 4) row.push_back(255); // no black
        }
        JSAMPROW pointer = row.data();
        jpeg_write_scanlines(&jpeg, &pointer, 1);
    }
    jpeg_finish_compress(&jpeg);
    const auto bytes = std::as_bytes(std::span(target, size));
    std::vector<std::byte> file(bytes.begin(), bytes.end());
    jpeg_destroy_compress(&jpeg);
    std::free(target);
    return file;
}

size_t findSegment(std::vector<std::byte> const& file, uint8_t code) {
    for (size_t i = 2; i + 1 < file.size(); ++i) {
        if (file[i] == std::byte{ 0xFF } && file[i + 1] == std::byte{ code }) return i;
    }
    return file.size();
}

} // namespace filament_core::assets::test
