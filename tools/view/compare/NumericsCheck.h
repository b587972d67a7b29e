// SPDX-License-Identifier: Apache-2.0
/// checkNumerics: pixels of a scene-linear picture that no display can show right, counted and marked.
///   In      linear Rec. 709: RGBA16F, or floats before they are rounded to halves. Alpha is not looked at.
///   Kinds   of a pixel the worst one of red, green and blue, in the order of NumericKind. Halves cannot exceed their
///           own range, so OutOfHalf is found in floats only, except for the largest half itself: what was clamped.
///   Thread  any; pure.   Cost: about 5 ms per megapixel.
///   Fails   InvalidArgument for other formats and byte counts.
#pragma once

#include "toolkit/pictures/Pixels.h"

namespace filament_core::view {

using namespace tools; // the toolkit

/// Ascending by harm.
enum class NumericKind : uint8_t {
    Good,      ///< finite, normal or zero, in [0, `white`]
    Clipped,   ///< above `white`: a display clips it unless a tone mapper bends it
    Denormal,  ///< below 2^-14 and not zero: hardware may flush it
    Negative,  ///< light below zero: a colour outside of the gamut, or an error
    OutOfHalf, ///< at least 65504 (of either sign): a half clamps it or makes it infinite
    Infinite,
    NotANumber,
};
inline constexpr size_t kNumericKinds = 7;
const char* toString(NumericKind kind);

struct NumericsCheck {
    std::array<uint64_t, kNumericKinds> counts{};            ///< pixels of each kind
    std::array<std::optional<uint2>, kNumericKinds> first{}; ///< in reading order
    std::vector<NumericKind> pixels;                         ///< row 0 at the top
    uint32_t width = 0, height = 0;

    /// The image in grey with bad values in the colour of its kind; RGBA8.
    Image marked(Image const& picture) const;
};

/// The colour that marks a kind: clipped yellow, denormal blue, negative cyan, out of range orange, infinite red, not a
/// number magenta.
std::array<uint8_t, 3> markOf(NumericKind kind);

NumericKind kindOf(float3 light, float white = 1);
Result<NumericsCheck> checkNumerics(Image const& picture, float white = 1);
/// `light`: width * height pixels.
Result<NumericsCheck> checkNumerics(std::span<const float3> light, uint32_t width, uint32_t height, float white = 1);

} // namespace filament_core::view
