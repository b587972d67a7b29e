// SPDX-License-Identifier: Apache-2.0
/// HdrImage: scene-linear pixels as floats, row 0 is the top row.
///   Values  linear Rec. 709; every component is in [0, kMaxRadiance] after sanitise().
///   Memory  12 bytes per pixel.
#pragma once

#include "base/math/Math.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace filament_core::assets {

/// A million times the sun in cd/m^2: brighter values are damage. Sums over a sky of this radiance stay finite in fp32.
inline constexpr float kMaxRadiance = 1e15f;

/// Components that could not be light and were replaced.
struct HdrRepairs {
    uint64_t notANumber = 0; ///< replaced by 0
    uint64_t infinite = 0;   ///< above kMaxRadiance; replaced by the largest valid value of the image
    uint64_t negative = 0;   ///< replaced by 0
    uint64_t total() const { return notANumber + infinite + negative; }
    friend bool operator==(HdrRepairs const&, HdrRepairs const&) = default;
};

struct HdrImage {
    uint32_t width = 0, height = 0;
    std::vector<float3> pixels; ///< width * height
    HdrRepairs repairs;
    bool isCube = false;                         ///< six faces, one below the other, as OpenEXR's "envmap" has them
    std::vector<std::string> warnings{};         ///< what the file says and this image does not follow; each a sentence
    std::vector<std::string> panoramaWarnings{}; ///< those that count only for images that surround a scene

    float3& at(uint32_t x, uint32_t y) { return pixels[size_t(y) * width + x]; }
    float3 const& at(uint32_t x, uint32_t y) const { return pixels[size_t(y) * width + x]; }
};

/// Colours of other primaries as Rec. 709; those outside of it count as negative in image.repairs. After sanitise().
void convertToRec709(HdrImage& image, double3x3 const& rec709FromFile);

/// Replaces values outside [0, kMaxRadiance] and counts them in image.repairs.
void sanitise(HdrImage& image);

} // namespace filament_core::assets
