// SPDX-License-Identifier: Apache-2.0
// The twin of shaders/post/debug_colors.glsl and of the materials that include it.
#include <filament_core/DebugViews.h>

#include <filament_core/Math.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace filament_core {
namespace {

constexpr DebugColor kBlackColor{ 0, 0, 0 }, kWhiteColor{ 255, 255, 255 }, kGreyColor{ 153, 153, 153 };

uint8_t codeOf(float value) { return static_cast<uint8_t>(std::clamp(value, 0.0f, 255.0f) + 0.5f); }

/// Straight lines between five colours of viridis (Smith and van der Walt 2015). 0 to 1.
DebugColor heatColor(float heat) {
    constexpr std::array<float3, 4> kSteps{ { { -9, 81, 55 }, { -26, 63, 1 }, { 61, 56, -42 }, { 159, 30, -61 } } };
    float3 color(68, 1, 84);
    for (size_t i = 0; i < kSteps.size(); ++i)
        color += std::clamp(heat * 4 - static_cast<float>(i), 0.0f, 1.0f) * kSteps[i];
    return { codeOf(color.x), codeOf(color.y), codeOf(color.z) };
}

} // namespace

NumericsCounts countNumerics(std::span<const std::byte> rgba) {
    NumericsCounts counts{};
    for (size_t i = 0; i + 4 <= rgba.size(); i += 4) {
        const auto channel = [&](size_t c) { return std::to_integer<uint8_t>(rgba[i + c]); };
        const auto mark = numericsMarkOf({ channel(0), channel(1), channel(2) });
        ++counts[static_cast<size_t>(mark.value_or(NumericsMark::None))];
    }
    return counts;
}

const char* meaningOf(PlausibilityRule rule) {
    static constexpr std::array<const char*, kPlausibilityRules> kMeanings{
        "",
        "metallic is 0 or 1, and only edges between materials lie between 0.1 and 0.9",
        "the albedo of a dielectric is at least 50 (sRGB, of 255)",
        "the albedo of a dielectric is at most 240 (sRGB, of 255)",
        "the base colour of a metal is at least 170 (sRGB, of 255)",
        "the reflectance of a dielectric is at least 0.35, 2 % of the light",
        "emission is at most 1, the white of the image, unless it is a lamp"
    };
    return kMeanings[static_cast<size_t>(rule)];
}

DebugColor luminanceColor(int stops) {
    if (stops == 0) return kGreyColor;
    if (stops <= -7) return kBlackColor;
    return stops >= 7 ? kWhiteColor : heatColor(static_cast<float>(stops + 6) / 12);
}

DebugColor countColor(uint32_t count) {
    if (count == 0) return { 64, 64, 64 };
    if (count >= 256) return kWhiteColor;
    const auto last = static_cast<int>(count - 1);
    const int octave = std::max(static_cast<int>(std::bit_width(count - 1)) - 4, 0); // from 17, 33, 65, 129 on
    const int step = count <= 8 ? static_cast<int>(count) : 9 + 2 * octave + (last >> (octave + 2) & 1);
    const int low = std::min(step, 8) - 1, high = std::max(step - 8, 0);
    return heatColor(static_cast<float>(low) * (0.6f / 7) + static_cast<float>(high) * 0.04f);
}

DebugColor mipLevelColor(float level) { return level >= 0 ? heatColor(std::min(level / 10, 1.0f)) : kGreyColor; }

} // namespace filament_core
