// SPDX-License-Identifier: Apache-2.0
/// HdrImage: scene-linear pixels as floats, row 0 is the top row.
///   Values  linear Rec. 709; every component is finite and >= 0 once sanitise() ran.
///   Memory  12 bytes a pixel.
#pragma once

#include "filament_core/math/Math.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace filament::assets {

/// Components that could not be light and were replaced.
struct HdrRepairs {
    uint64_t notANumber = 0; ///< became 0
    uint64_t infinite = 0;   ///< became the largest finite value of the image
    uint64_t negative = 0;   ///< became 0
    uint64_t total() const { return notANumber + infinite + negative; }
    friend bool operator==(HdrRepairs const&, HdrRepairs const&) = default;
};

struct HdrImage {
    uint32_t width = 0, height = 0;
    std::vector<float3> pixels; ///< width * height
    HdrRepairs repairs;

    float3& at(uint32_t x, uint32_t y) { return pixels[size_t(y) * width + x]; }
    float3 const& at(uint32_t x, uint32_t y) const { return pixels[size_t(y) * width + x]; }
};

/// Replaces what is not finite and non-negative, and counts it in image.repairs.
void sanitise(HdrImage& image);

} // namespace filament::assets
