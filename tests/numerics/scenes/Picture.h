// SPDX-License-Identifier: Apache-2.0
/// Picture: one frame twice, as scene-linear half floats and as display bytes, and queries of it.
///   Thread  pure functions of values. Fails: never; a missing image has no pixels.
#pragma once

#include "backend/layers/Captured.h"

#include <filament_core/Image.h>
#include <filament_core/Math.h>

#include <cstdint>
#include <functional>
#include <string>

namespace filament_core::hard {

/// Largest half float: brighter light is stored as this, because Mesa's conversion saturates.
inline constexpr float kLargestStored = 65504;

struct Picture {
    Image linear;            ///< RGBA16F, before the tone mapper
    Image display;           ///< RGBA8
    std::string notFinite{}; ///< of all attachments of both frames, those with an inf or a NaN; a line each
    uint32_t scannedAttachments = 0;
    uint2 size() const { return { linear.width, linear.height }; }
    float4 at(uint32_t x, uint32_t y) const; ///< scene-linear
    uint32_t coveredCount() const;           ///< pixels with alpha 1
};

/// Looks for inf and NaN in every attachment that stores floats; a line for each that has some: "pass 'color', texture
/// 'hdr': 3 components are not finite, first at (5, 7)". Counts what it looked at.
std::string describeNotFinite(backend::CapturedFrame const& frame, uint32_t& scannedAttachments);

/// Where two display images differ by more than `tolerance` of 255.
struct Difference {
    uint32_t pixels = 0;
    uint32_t largest = 0; ///< of 255
};
Difference compare(Image const& a, Image const& b, uint32_t tolerance);

Image mirroredLeftRight(Image image);

/// The four bytes of a display pixel: 0xAABBGGRR.
uint32_t bytesAt(Image const& display, uint32_t x, uint32_t y);

/// Calls for every pixel that a surface covers.
void forEachCovered(Picture const& picture, std::function<void(uint32_t x, uint32_t y, float4 color)> const& visit);

} // namespace filament_core::hard
