// SPDX-License-Identifier: Apache-2.0
/// ImageChecks: checks that apply to any picture, and the first difference between two attachments.
///   Fails   never; an empty text or optional means that nothing was found.
///   Thread  any; pure.
#pragma once

#include "backend/layers/Captured.h"

#include <filament/Image.h>

#include <array>
#include <optional>
#include <string>

namespace filament::tools {

/// Why a picture cannot be correct: all black, a single colour, NaN or infinity, no pixels.
std::string faultOf(Image const& image);

/// The first non-finite component of any floating-point attachment: pass, attachment, pixel, command positions.
std::string notFinite(backend::CapturedFrame const& frame);

/// Texel `index` as numbers; components that the format lacks are 0.
std::array<float, 4> texel(Format format, std::span<const std::byte> bytes, size_t index);

struct PixelDifference {
    uint32_t x = 0, y = 0;
    std::array<float, 4> a{}, b{};
    uint64_t count = 0; ///< texels that differ
};
/// The first texel in reading order whose bits differ. Byte counts must agree.
std::optional<PixelDifference> firstDifference(Format format, uint32_t width, std::span<const std::byte> a,
                                               std::span<const std::byte> b);

/// "(0.5, 0.25, 0, 1)"
std::string textOf(std::array<float, 4> const& value);

} // namespace filament::tools
