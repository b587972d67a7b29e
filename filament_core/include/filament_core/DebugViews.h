// SPDX-License-Identifier: Apache-2.0
/// DebugViews: what the colours of View::debugView mean, as values: for legends, and for programs that read such
/// images. docs/debug-views.md explains them.
///   Colours  codes of sRGB, 0 to 255, as an RGBA8 or RGBA8Srgb target has them.
///   Thread   any; pure.   Memory: none.   Fails: never.
#pragma once

#include <filament_core/EnumNames.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

namespace filament_core {

using DebugColor = std::array<uint8_t, 3>; ///< red, green, blue

namespace detail {
/// By NumericsMark; told apart by everyone (Okabe and Ito 2008, "Color Universal Design").
inline constexpr std::array<DebugColor, 6> kNumericsColors{
    { { 0, 0, 0 }, { 86, 180, 233 }, { 240, 228, 66 }, { 230, 159, 0 }, { 213, 94, 0 }, { 204, 121, 167 } }
};

/// By PlausibilityRule.
inline constexpr std::array<DebugColor, 7> kPlausibilityColors{ { { 0, 0, 0 },
                                                                  { 204, 121, 167 },
                                                                  { 86, 180, 233 },
                                                                  { 240, 228, 66 },
                                                                  { 230, 159, 0 },
                                                                  { 0, 158, 115 },
                                                                  { 213, 94, 0 } } };

/// The place of a colour among those of marks, the first of which stands for all greys.
template <class Mark, size_t N>
constexpr std::optional<Mark> markOf(std::array<DebugColor, N> const& colors, DebugColor color) {
    if (color[0] == color[1] && color[1] == color[2]) return Mark{};
    const auto found = std::ranges::find(colors, color);
    if (found == colors.end()) return std::nullopt;
    return static_cast<Mark>(found - colors.begin());
}
} // namespace detail

/// What DebugView::Numerics marks in the linear scene colour before it becomes half floats. Of a pixel for which
/// several are true, the last one.
enum class NumericsMark : uint8_t {
    None,       ///< the pixel is grey
    Denormal,   ///< a channel is below 2^-14 and not 0: half floats have less than 11 bits for it
    Clipped,    ///< the display shows a channel as full (255)
    OutOfRange, ///< a channel is above 65504 or below -65504, the largest half floats
    Infinite,
    NotANumber,
};
inline constexpr size_t kNumericsMarks = 6;

template <>
struct EnumNames<NumericsMark> {
    static constexpr std::array<std::string_view, kNumericsMarks> values{ "none",       "denormal", "clipped",
                                                                          "outOfRange", "infinite", "notANumber" };
};
/// None: grey stands for all greys.
constexpr DebugColor numericsColor(NumericsMark mark) { return detail::kNumericsColors[static_cast<size_t>(mark)]; }
/// Of a pixel of DebugView::Numerics; none: no such view has this colour.
constexpr std::optional<NumericsMark> numericsMarkOf(DebugColor color) {
    return detail::markOf<NumericsMark>(detail::kNumericsColors, color);
}

/// How many pixels have a mark, by NumericsMark.
using NumericsCounts = std::array<uint64_t, kNumericsMarks>;
/// `rgba`: pixels of DebugView::Numerics, four bytes each; bytes beyond the last whole pixel do not count. Other
/// colours count as None.
NumericsCounts countNumerics(std::span<const std::byte> rgba);

/// What DebugView::Plausibility and `filament-render --check-asset` mark: values that no real material has. Of a texel
/// that breaks several rules, the first one. docs/debug-views.md has their limits.
enum class PlausibilityRule : uint8_t {
    None,
    MixedMetallic,  ///< neither a dielectric nor a metal
    DarkAlbedo,     ///< of a dielectric
    BrightAlbedo,   ///< of a dielectric
    DarkMetal,      ///< a metal that reflects too little
    LowReflectance, ///< of a dielectric
    BrightEmission, ///< brighter than white
};
inline constexpr size_t kPlausibilityRules = 7;

template <>
struct EnumNames<PlausibilityRule> {
    static constexpr std::array<std::string_view, kPlausibilityRules> values{
        "none", "mixedMetallic", "darkAlbedo", "brightAlbedo", "darkMetal", "lowReflectance", "brightEmission"
    };
};
/// A sentence without its full stop: what real materials have. Empty for None.
const char* meaningOf(PlausibilityRule rule);
/// None: grey stands for all greys.
constexpr DebugColor plausibilityColor(PlausibilityRule rule) {
    return detail::kPlausibilityColors[static_cast<size_t>(rule)];
}
/// Of a pixel of DebugView::Plausibility; none: no such view has this colour.
constexpr std::optional<PlausibilityRule> plausibilityRuleOf(DebugColor color) {
    return detail::markOf<PlausibilityRule>(detail::kPlausibilityColors, color);
}

/// Of DebugView::Luminance: `stops` above middle grey, a linear luminance of 0.18 before tone mapping. From 7 on:
/// white; up to -7: black.
DebugColor luminanceColor(int stops);

/// Of DebugView::Overdraw, TransparentLayers, Froxels and Lights: a colour for each count up to 8, then two for each
/// doubling up to 255, one from 256 on.
DebugColor countColor(uint32_t count);

/// Of DebugView::MipLevel: grey below 0, where a texel is larger than a pixel; then from dark purple to yellow at 10,
/// where all of the texture is in a pixel. NaN is grey.
DebugColor mipLevelColor(float level);

} // namespace filament_core
