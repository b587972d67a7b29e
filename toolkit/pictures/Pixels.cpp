// SPDX-License-Identifier: Apache-2.0
#include "toolkit/pictures/Pixels.h"

#include "backend/api/Format.h"
#include "base/math/Half.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace filament_core::tools {
namespace {

using backend::formatInfo;

template <class T>
T load(std::span<const std::byte> bytes, size_t at) {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof(value));
    return value;
}

std::array<float, 4> from10Bits(uint32_t word) {
    return { static_cast<float>(word & 1023) / 1023, static_cast<float>(word >> 10 & 1023) / 1023,
             static_cast<float>(word >> 20 & 1023) / 1023, static_cast<float>(word >> 30) / 3 };
}

} // namespace

Result<void> checkPicture(Image const& image) {
    const bool isPicture = image.format == Format::RGBA8 || image.format == Format::RGBA8Srgb ||
                           image.format == Format::RGB10A2 || image.format == Format::RGBA16F;
    if (!isPicture)
        return fail(ErrorCode::InvalidArgument,
                    "a picture of {} is not compared; give RGBA8, RGBA8Srgb, RGB10A2 or RGBA16F",
                    formatInfo(image.format).name);
    const size_t bytes = pixelCount(image) * formatInfo(image.format).bytesPerBlock;
    if (bytes > 0 && image.pixels.size() == bytes) return {};
    return fail(ErrorCode::InvalidArgument, "a picture of {}x{} pixels with {} bytes is none", image.width,
                image.height, image.pixels.size());
}

Result<void> checkPair(Image const& a, Image const& b) {
    if (Result<void> good = checkPicture(a); !good) return good;
    if (Result<void> good = checkPicture(b); !good) return good;
    if (a.width == b.width && a.height == b.height && a.format == b.format) return {};
    return fail(ErrorCode::InvalidArgument, "{}x{} pixels of {} and {}x{} of {} cannot be compared: draw them alike",
                a.width, a.height, formatInfo(a.format).name, b.width, b.height, formatInfo(b.format).name);
}

std::array<float, 4> texel(Format format, std::span<const std::byte> bytes, size_t index) {
    const auto& info = formatInfo(format);
    const size_t at = index * info.bytesPerBlock;
    if (format == Format::RGB10A2) return from10Bits(load<uint32_t>(bytes, at));
    std::array<float, 4> value{};
    if (format == Format::R11G11B10F) {
        const float3 rgb = unpackR11G11B10F(load<uint32_t>(bytes, at));
        return { rgb.x, rgb.y, rgb.z, 0 };
    }
    for (uint32_t c = 0; c < info.components; ++c) {
        const uint32_t size = info.bytesPerBlock / info.components;
        if (size == 1)
            value[c] = static_cast<float>(load<uint8_t>(bytes, at + c)) / 255;
        else if (size == 2)
            value[c] = floatFromHalf(load<uint16_t>(bytes, at + 2 * c));
        else
            value[c] = load<float>(bytes, at + 4 * c);
    }
    return value;
}

std::optional<PixelDifference> firstDifference(Format format, uint32_t width, std::span<const std::byte> a,
                                               std::span<const std::byte> b) {
    const size_t stride = formatInfo(format).bytesPerBlock;
    std::optional<PixelDifference> first;
    for (size_t i = 0; i < std::min(a.size(), b.size()) / stride; ++i) {
        if (std::memcmp(&a[i * stride], &b[i * stride], stride) == 0) continue;
        if (!first)
            first = PixelDifference{ .x = static_cast<uint32_t>(i % width),
                                     .y = static_cast<uint32_t>(i / width),
                                     .a = texel(format, a, i),
                                     .b = texel(format, b, i) };
        ++first->count;
    }
    return first;
}

std::string textOf(std::array<float, 4> const& value) {
    return fmt::format("({:.9g}, {:.9g}, {:.9g}, {:.9g})", value[0], value[1], value[2], value[3]);
}

std::optional<Image> partOf(Image const& image, uint2 offset, uint2 size) {
    const bool fits = size.x <= image.width && offset.x <= image.width - size.x && size.y <= image.height &&
                      offset.y <= image.height - size.y;
    if (!fits || image.pixels.size() != size_t{ image.width } * image.height * 4) return std::nullopt;
    Image part{ .width = size.x, .height = size.y, .format = image.format };
    part.pixels.reserve(size_t{ size.x } * size.y * 4);
    for (uint32_t y = 0; y < size.y; ++y) {
        const auto row =
                image.pixels.begin() + static_cast<ptrdiff_t>((size_t{ offset.y + y } * image.width + offset.x) * 4);
        part.pixels.insert(part.pixels.end(), row, row + static_cast<ptrdiff_t>(size_t{ size.x } * 4));
    }
    return part;
}

} // namespace filament_core::tools
