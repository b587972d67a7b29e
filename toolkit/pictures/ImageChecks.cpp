// SPDX-License-Identifier: Apache-2.0
#include "toolkit/pictures/ImageChecks.h"

#include "base/math/Half.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace filament::tools {
namespace {

using backend::formatInfo;

template <class T>
T load(std::span<const std::byte> bytes, size_t at) {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof(value));
    return value;
}

std::string notFinite(Format format, uint32_t width, std::span<const std::byte> bytes) {
    if (!formatInfo(format).isFloat) return {};
    const size_t count = bytes.size() / formatInfo(format).bytesPerBlock;
    for (size_t i = 0; i < count; ++i) {
        const std::array<float, 4> value = texel(format, bytes, i);
        if (std::all_of(value.begin(), value.end(), [](float v) { return std::isfinite(v); })) continue;
        return fmt::format("pixel ({}, {}) is {}", i % width, i / width, textOf(value));
    }
    return {};
}

bool isBlack(std::array<float, 4> const& value) { return value[0] == 0 && value[1] == 0 && value[2] == 0; }

} // namespace

std::array<float, 4> texel(Format format, std::span<const std::byte> bytes, size_t index) {
    const auto& info = formatInfo(format);
    const size_t at = index * info.bytesPerBlock;
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

std::string faultOf(Image const& image) {
    const size_t count = size_t{ image.width } * image.height, stride = formatInfo(image.format).bytesPerBlock;
    if (count == 0 || image.pixels.size() != count * stride) return "there are no pixels";
    if (std::string where = notFinite(image.format, image.width, image.pixels); !where.empty())
        return "not finite: " + where;
    bool black = true, uniform = true;
    for (size_t i = 0; i < count && (black || uniform); ++i) {
        black = black && isBlack(texel(image.format, image.pixels, i));
        uniform = uniform && std::memcmp(&image.pixels[i * stride], image.pixels.data(), stride) == 0;
    }
    if (black) return "all pixels are black";
    if (uniform) return "all pixels are " + textOf(texel(image.format, image.pixels, 0)) + ": nothing was drawn";
    return {};
}

std::string notFinite(backend::CapturedFrame const& frame) {
    for (backend::CapturedPass const& pass : frame.passes) {
        for (backend::CapturedAttachment const& attachment : pass.attachments) {
            const std::string where = notFinite(attachment.format, attachment.width, attachment.bytes);
            if (where.empty()) continue;
            return fmt::format("pass '{}' (commands {} to {}), attachment '{}': {}", pass.name, pass.first, pass.last,
                               attachment.name, where);
        }
    }
    return {};
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

} // namespace filament::tools
