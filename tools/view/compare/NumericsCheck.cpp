// SPDX-License-Identifier: Apache-2.0
#include "tools/view/compare/NumericsCheck.h"

#include "base/math/Half.h"
#include "toolkit/pictures/Pixels.h"

#include <algorithm>
#include <cmath>

namespace filament_core::view {
namespace {

constexpr float kSmallestNormalHalf = 0x1p-14f;

constexpr const char* kNames[kNumericKinds] = { "good",         "clipped",  "denormal",    "negative",
                                                "out of range", "infinite", "not a number" };
constexpr std::array<uint8_t, 3> kMarks[kNumericKinds] = { { 0, 0, 0 },     { 255, 224, 0 }, { 0, 64, 255 },
                                                           { 0, 255, 255 }, { 255, 112, 0 }, { 255, 0, 0 },
                                                           { 255, 0, 255 } };

NumericKind kindOf(float value, float white) {
    if (std::isnan(value)) return NumericKind::NotANumber;
    if (std::isinf(value)) return NumericKind::Infinite;
    const float size = std::abs(value);
    if (size >= kMaxHalf) return NumericKind::OutOfHalf;
    if (size > 0 && size < kSmallestNormalHalf) return NumericKind::Denormal;
    if (value < 0) return NumericKind::Negative;
    return value > white ? NumericKind::Clipped : NumericKind::Good;
}

Result<void> checkWhite(float white) {
    if (white > 0 && white < kMaxHalf) return {};
    return fail(ErrorCode::InvalidArgument, "white is {}; give light above 0 and below {}", white, kMaxHalf);
}

template <class PixelOf>
NumericsCheck checkAll(uint32_t width, uint32_t height, float white, PixelOf const& pixelOf) {
    NumericsCheck check{ .width = width, .height = height };
    check.pixels.resize(size_t{ width } * height);
    for (size_t i = 0; i < check.pixels.size(); ++i) {
        const NumericKind kind = view::kindOf(pixelOf(i), white);
        check.pixels[i] = kind;
        const auto index = static_cast<size_t>(kind);
        if (check.counts[index]++ == 0)
            check.first[index] = uint2(static_cast<uint32_t>(i % width), static_cast<uint32_t>(i / width));
    }
    return check;
}

} // namespace

const char* toString(NumericKind kind) { return kNames[static_cast<size_t>(kind)]; }
std::array<uint8_t, 3> markOf(NumericKind kind) { return kMarks[static_cast<size_t>(kind)]; }

NumericKind kindOf(float3 light, float white) {
    return std::max({ kindOf(light.x, white), kindOf(light.y, white), kindOf(light.z, white) });
}

Result<NumericsCheck> checkNumerics(Image const& picture, float white) {
    if (Result<void> good = checkPicture(picture); !good) return good.error();
    if (picture.format != Format::RGBA16F)
        return fail(ErrorCode::InvalidArgument, "numbers are checked in scene-linear pictures: RGBA16F");
    if (Result<void> good = checkWhite(white); !good) return good.error();
    return checkAll(picture.width, picture.height, white, [&](size_t i) {
        const std::array<float, 4> value = pixelAt(picture, i);
        return float3(value[0], value[1], value[2]);
    });
}

Result<NumericsCheck> checkNumerics(std::span<const float3> light, uint32_t width, uint32_t height, float white) {
    if (light.empty() || light.size() != size_t{ width } * height)
        return fail(ErrorCode::InvalidArgument, "{} pixels are no picture of {}x{}", light.size(), width, height);
    if (Result<void> good = checkWhite(white); !good) return good.error();
    return checkAll(width, height, white, [&](size_t i) { return light[i]; });
}

Image NumericsCheck::marked(Image const& picture) const {
    Image result{ .width = width, .height = height, .pixels = std::vector<std::byte>(4 * pixels.size()) };
    const bool hasPicture = checkPicture(picture).ok() && pixelCount(picture) == pixels.size();
    for (size_t i = 0; i < pixels.size(); ++i) {
        std::array<uint8_t, 3> rgb = markOf(pixels[i]);
        if (pixels[i] == NumericKind::Good && hasPicture) {
            const std::array<float, 4> v = pixelAt(picture, i);
            const float luminance = 0.2126f * v[0] + 0.7152f * v[1] + 0.0722f * v[2]; // ITU-R BT.709
            rgb.fill(static_cast<uint8_t>(std::sqrt(std::clamp(luminance, 0.0f, 1.0f)) * 160 +
                                          0.5f)); // dimmer than marks
        }
        for (size_t c = 0; c < 3; ++c) result.pixels[4 * i + c] = std::byte{ rgb[c] };
        result.pixels[4 * i + 3] = std::byte{ 255 };
    }
    return result;
}

} // namespace filament_core::view
