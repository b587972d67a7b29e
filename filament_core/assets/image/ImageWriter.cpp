// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/image/ImageWriter.h"

#include "base/Assert.h"
#include "base/math/Half.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/image/ExrWriter.h"
#include "filament_core/assets/image/Png16.h"
#include "filament_core/assets/image/PngColor.h"

#include <glm/common.hpp>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace filament_core::assets {
namespace {

constexpr uint64_t kMaxPngPixels = uint64_t(1) << 28; // 1 GiB of RGBA8

// libpng's simplified interface handles setjmp internally; calling png_image_free() twice is harmless.
struct PngImage {
    png_image value{};
    PngImage() { value.version = PNG_IMAGE_VERSION; }
    ~PngImage() { png_image_free(&value); }
};

Error pngFailure(std::filesystem::path const& path, const char* verb, PngImage const& png) {
    return fail(ErrorCode::Unreadable, "cannot {} '{}': {}; check the file and the free memory", verb, path.string(),
                static_cast<const char*>(png.value.message));
}

Result<void> checkExrSize(std::filesystem::path const& path, uint32_t width, uint32_t height) {
    if (std::max(width, height) <= kMaxExrSide) return {};
    return fail(ErrorCode::Unreadable, "cannot encode '{}': {} x {} pixels are more than {} per side; make it smaller",
                path.string(), width, height, kMaxExrSide);
}

Result<void> saveEncodedExr(std::filesystem::path const& path, ExrPixels const& pixels) {
    if (Result<void> checked = checkExrSize(path, pixels.width, pixels.height); !checked) return checked;
    return replaceFile(path, encodeExr(pixels));
}

template <class T>
void append(std::vector<std::byte>& bytes, T value) {
    const auto* first = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), first, first + sizeof(T));
}

using Rgbe = std::array<uint8_t, 4>;

// The largest component determines the exponent. Mantissas are rounded, because readers do not add Radiance's half
// step.
Rgbe rgbeOf(float3 color) {
    const float3 light = glm::max(color, float3(0.0f));
    const float largest = std::max({ light.x, light.y, light.z });
    if (!(largest > 1e-38f)) return {};
    int exponent = 0;
    std::frexp(std::min(largest, 1.7e38f), &exponent);
    const float scale = std::ldexp(1.0f, 8 - exponent);
    const auto mantissa = [&](float value) { return static_cast<uint8_t>(std::min(value * scale + 0.5f, 255.0f)); };
    return { mantissa(light.x), mantissa(light.y), mantissa(light.z), static_cast<uint8_t>(exponent + 128) };
}

// Runs of at least 4 are repeated; everything else is copied. At most 127 and 128 bytes at a time.
void appendRuns(std::vector<std::byte>& out, std::span<const uint8_t> values) {
    const auto runAt = [&](size_t i) {
        size_t end = i + 1;
        while (end < values.size() && end - i < 127 && values[end] == values[i]) ++end;
        return end - i;
    };
    for (size_t i = 0; i < values.size();) {
        const size_t run = runAt(i);
        if (run >= 4) {
            out.push_back(static_cast<std::byte>(128 + run));
            out.push_back(static_cast<std::byte>(values[i]));
            i += run;
            continue;
        }
        size_t end = i;
        while (end < values.size() && end - i < 128 && runAt(end) < 4) ++end;
        out.push_back(static_cast<std::byte>(end - i));
        for (; i < end; ++i) out.push_back(static_cast<std::byte>(values[i]));
    }
}

void appendHdrRow(std::vector<std::byte>& out, std::span<const float3> row) {
    std::vector<Rgbe> pixels(row.size());
    std::ranges::transform(row, pixels.begin(), rgbeOf);
    if (row.size() < 8 || row.size() >= 32768) { // run-length encoding cannot express such widths
        for (Rgbe const& pixel : pixels) append(out, pixel);
        return;
    }
    append(out, Rgbe{ 2, 2, static_cast<uint8_t>(row.size() >> 8), static_cast<uint8_t>(row.size() & 0xFF) });
    std::vector<uint8_t> component(row.size());
    for (size_t c = 0; c < 4; ++c) {
        std::ranges::transform(pixels, component.begin(), [c](Rgbe const& pixel) { return pixel[c]; });
        appendRuns(out, component);
    }
}

} // namespace

Result<void> writePng(std::filesystem::path const& path, uint32_t width, uint32_t height,
                      std::span<const std::byte> rgba8, OutputSpace space) {
    FILAMENT_ASSERT(width > 0 && height > 0 && rgba8.size() == size_t(width) * height * 4,
                    "writePng takes width * height * 4 bytes, more than none");
    PngImage png;
    png.value.width = width;
    png.value.height = height;
    png.value.format = PNG_FORMAT_RGBA;
    png.value.flags = PNG_IMAGE_FLAG_FAST;
    // Filters and headers can make noise larger than the input, so the bound comes from libpng.
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png.value);
    std::vector<std::byte> bytes(size);
    if (!png_image_write_to_memory(&png.value, bytes.data(), &size, 0, rgba8.data(), 0, nullptr)) {
        return pngFailure(path, "encode", png);
    }
    bytes.resize(size);
    return replaceFile(path, withColorSpace(std::move(bytes), space));
}

Result<void> writePng16(std::filesystem::path const& path, uint32_t width, uint32_t height,
                        std::span<const std::byte> rgb10a2, OutputSpace space) {
    FILAMENT_ASSERT(width > 0 && height > 0 && rgb10a2.size() == size_t(width) * height * 4,
                    "writePng16 takes width * height * 4 bytes, more than none");
    return replaceFile(path, withColorSpace(encodePng16(width, height, rgb10a2), space));
}

Result<Image> readPng(std::filesystem::path const& path) {
    const Result<std::vector<std::byte>> bytes = readFileBytes(path);
    if (!bytes) return bytes.error();
    PngImage png;
    if (!png_image_begin_read_from_memory(&png.value, bytes->data(), bytes->size())) {
        return pngFailure(path, "read", png);
    }
    if (uint64_t(png.value.width) * png.value.height > kMaxPngPixels) {
        return fail(ErrorCode::Unsupported, "cannot read '{}': {} x {} pixels are more than {}; make it smaller",
                    path.string(), png.value.width, png.value.height, kMaxPngPixels);
    }
    png.value.format = PNG_FORMAT_RGBA;
    Image image{ .width = png.value.width, .height = png.value.height, .data = {} };
    image.data.resize(image.levelBytes(0));
    if (!png_image_finish_read(&png.value, nullptr, image.data.data(), 0, nullptr))
        return pngFailure(path, "read", png);
    return image;
}

Result<void> writeExr(std::filesystem::path const& path, uint32_t width, uint32_t height,
                      std::span<const float3> pixels, ExrPrecision precision) {
    FILAMENT_ASSERT(width > 0 && height > 0 && pixels.size() == size_t(width) * height,
                    "writeExr takes width * height pixels, more than none");
    if (precision == ExrPrecision::Float)
        return saveEncodedExr(path, { width, height, "RGB", ExrType::Float, std::as_bytes(pixels) });
    std::vector<uint16_t> halves;
    halves.reserve(pixels.size() * 3);
    for (float3 const& pixel : pixels)
        for (int c = 0; c < 3; ++c) halves.push_back(halfFromFloat(pixel[c]));
    return saveEncodedExr(path, { width, height, "RGB", ExrType::Half, std::as_bytes(std::span(halves)) });
}

Result<void> writeExr(std::filesystem::path const& path, uint32_t width, uint32_t height,
                      std::span<const std::byte> rgba16f) {
    FILAMENT_ASSERT(width > 0 && height > 0 && rgba16f.size() == size_t(width) * height * 8,
                    "writeExr takes width * height * 8 bytes, more than none");
    return saveEncodedExr(path, { width, height, "RGBA", ExrType::Half, rgba16f });
}

Result<void> writeExr(std::filesystem::path const& path, uint32_t width, uint32_t height,
                      std::span<const ExrSource> channels) {
    if (Result<void> checked = checkExrSize(path, width, height); !checked) return checked;
    return replaceFile(path, encodeExr(width, height, channels));
}

Result<void> writeHdr(std::filesystem::path const& path, HdrImage const& image) {
    FILAMENT_ASSERT(image.width > 0 && image.height > 0 && image.pixels.size() == size_t(image.width) * image.height,
                    "writeHdr takes width * height pixels, more than none");
    const std::string header =
            fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", image.height, image.width);
    const auto headerBytes = std::as_bytes(std::span(header));
    std::vector<std::byte> bytes(headerBytes.begin(), headerBytes.end());
    for (uint32_t y = 0; y < image.height; ++y) appendHdrRow(bytes, { &image.at(0, y), image.width });
    return replaceFile(path, bytes);
}

} // namespace filament_core::assets
