// SPDX-License-Identifier: Apache-2.0
#include "tools/view/compare/Comparison.h"

#include "backend/api/Format.h"
#include "toolkit/pictures/Flip.h"
#include "toolkit/pictures/ImageCompare.h"
#include "toolkit/pictures/Pixels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace filament_core::view {
namespace {

uint8_t codeOf(float value) { return static_cast<uint8_t>(std::clamp(value, 0.0f, 1.0f) * 255 + 0.5f); }

void setPixel(Image& image, size_t index, std::array<uint8_t, 3> const& rgb) {
    for (size_t c = 0; c < 3; ++c) image.pixels[4 * index + c] = std::byte{ rgb[c] };
    image.pixels[4 * index + 3] = std::byte{ 255 };
}

Image emptyMap(Image const& like) {
    return { .width = like.width,
             .height = like.height,
             .pixels = std::vector<std::byte>(size_t{ 4 } * like.width * like.height) };
}

float amplified(float a, float b, float amplification) {
    if (std::isnan(a) && std::isnan(b)) return 0;
    const float difference = a == b ? 0 : std::abs(a - b) * amplification; // infinities of one sign are equal
    return std::isnan(difference) ? 1 : difference;
}

} // namespace

Result<double> rmsError(Image const& a, Image const& b) {
    if (Result<void> good = checkPair(a, b); !good) return good.error();
    double sum = 0;
    for (size_t i = 0; i < pixelCount(a); ++i) {
        const std::array<float, 4> first = pixelAt(a, i), second = pixelAt(b, i);
        for (size_t c = 0; c < 3; ++c) {
            const auto difference = static_cast<double>(amplified(first[c], second[c], 1));
            sum += difference * difference;
        }
    }
    return std::sqrt(sum / (3 * static_cast<double>(pixelCount(a))));
}

Result<Image> differenceMap(Image const& a, Image const& b, float amplification) {
    if (Result<void> good = checkPair(a, b); !good) return good.error();
    if (!(amplification > 0) || !std::isfinite(amplification))
        return fail(ErrorCode::InvalidArgument, "differences are amplified by a number above 0, not {}", amplification);
    Image map = emptyMap(a);
    for (size_t i = 0; i < pixelCount(a); ++i) {
        const std::array<float, 4> x = pixelAt(a, i), y = pixelAt(b, i);
        std::array<uint8_t, 3> rgb{};
        for (size_t c = 0; c < 3; ++c) rgb[c] = codeOf(amplified(x[c], y[c], amplification));
        setPixel(map, i, rgb);
    }
    return map;
}

std::array<uint8_t, 3> errorColor(float error) {
    // Luminance grows along it; small errors, which matter, get half of the colours.
    struct Stop {
        float at;
        std::array<float, 3> rgb;
    };
    constexpr Stop kStops[] = { { 0, { 0, 0, 0 } },
                                { 0.1f, { 0.25f, 0.05f, 0.45f } },
                                { 0.3f, { 0.65f, 0.15f, 0.40f } },
                                { 0.6f, { 0.95f, 0.50f, 0.10f } },
                                { 1, { 1, 1, 1 } } };
    const float t = std::isnan(error) ? 1.0f : std::clamp(error, 0.0f, 1.0f);
    size_t next = 1;
    while (kStops[next].at < t) ++next;
    Stop const &a = kStops[next - 1], &b = kStops[next];
    const float share = (t - a.at) / (b.at - a.at);
    std::array<uint8_t, 3> rgb{};
    for (size_t c = 0; c < 3; ++c) rgb[c] = codeOf(a.rgb[c] + share * (b.rgb[c] - a.rgb[c]));
    return rgb;
}

Result<FlipMap> flipMap(Image const& reference, Image const& test) {
    if (Result<void> good = checkPair(reference, test); !good) return good.error();
    if (reference.format == Format::RGB10A2)
        return fail(ErrorCode::InvalidArgument, "FLIP compares RGBA8 and RGBA16F; draw pictures of 8 bits for it");
    const tools::FlipError error = tools::flip(reference, test);
    FlipMap map{ .image = emptyMap(reference), .mean = error.mean, .p99 = error.p99 };
    for (size_t i = 0; i < error.pixels.size(); ++i) setPixel(map.image, i, errorColor(error.pixels[i]));
    return map;
}

uint32_t wipePixel(Wipe const& wipe, uint2 size) {
    const uint32_t side = wipe.axis == WipeAxis::Vertical ? size.x : size.y;
    const double position = std::isnan(wipe.position) ? 0 : std::clamp(double(wipe.position), 0.0, 1.0);
    return std::min(side, static_cast<uint32_t>(std::lround(position * side)));
}

Result<Image> wiped(Image const& a, Image const& b, Wipe const& wipe) {
    if (Result<void> good = checkPair(a, b); !good) return good.error();
    const size_t stride = backend::formatInfo(a.format).bytesPerBlock, row = stride * a.width;
    const size_t line = wipePixel(wipe, { a.width, a.height });
    Image result = a;
    for (size_t y = 0; y < a.height; ++y) {
        const size_t kept = wipe.axis == WipeAxis::Vertical ? line * stride : y < line ? row : 0;
        std::memcpy(result.pixels.data() + y * row + kept, b.pixels.data() + y * row + kept, row - kept);
    }
    return result;
}

SplitRects splitRects(Wipe const& wipe, uint2 size) {
    const bool isVertical = wipe.axis == WipeAxis::Vertical;
    const uint32_t line = wipePixel(wipe, size), side = isVertical ? size.x : size.y;
    const auto rectangle = [&](uint32_t from, uint32_t to) -> std::optional<PictureRect> {
        if (from == to || size.x == 0 || size.y == 0) return std::nullopt;
        if (isVertical) return PictureRect{ { from, 0 }, { to - from, size.y } };
        return PictureRect{ { 0, from }, { size.x, to - from } };
    };
    return { rectangle(0, line), rectangle(line, side) };
}

} // namespace filament_core::view
