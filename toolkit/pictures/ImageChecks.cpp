// SPDX-License-Identifier: Apache-2.0
#include "toolkit/pictures/ImageChecks.h"

#include "toolkit/pictures/Pixels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace filament_core::tools {
namespace {

using backend::formatInfo;

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

} // namespace filament_core::tools
