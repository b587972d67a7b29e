// SPDX-License-Identifier: Apache-2.0
/// HeldOut: how far a lightmap is off between its texels, at random points of the surfaces that are traced for nothing
///   else.
///   Points  each independent of the others, evenly by area. They are traced with kHeldOutSamples times the paths of a
///           texel.
///   Error   the difference of luminance between what the engine looks up (as stored, bilinear) and what is traced.
///   Bound   what remains of it beyond two standard errors of the point's chart, at kBoundShare of the lit surface
///           (Tolerance.h). The noise of the traced light is part of it: the bound is rather too wide than too narrow.
///   Thread  any; pure: the same points for the same surfaces and seed.
#pragma once

#include "tools/bake/LightmapImage.h"
#include "tools/bake/Tolerance.h"

namespace filament_core::bake {

inline constexpr uint32_t kHeldOutSamples = 4;    ///< times those of a texel
inline constexpr uint32_t kHeldOutRow = 1u << 31; ///< AtlasTexel::y of points: no texel has their random numbers

struct HeldOutPoint {
    AtlasTexel texel{};   ///< its chart, triangle and weights; x is its number
    double2 place{ 0.0 }; ///< in the image, texels
};

/// None if no triangle has an area.
std::vector<HeldOutPoint> heldOutPoints(std::span<const BakeSurface> surfaces, Atlas const& atlas, uint32_t count,
                                        uint32_t seed);

LightSettings heldOutSettings(LightSettings const& settings);

struct HeldOutReport {
    uint32_t points = 0;                    ///< that were compared
    uint32_t hidden = 0;                    ///< others: they see backs of surfaces
    uint32_t dark = 0;                      ///< others: nothing arrives, and nothing is stored
    std::optional<double> interpolationLux; ///< the bound; none: too few points
    double rmsLux = 0;                      ///< root mean square of the errors
    double worstLux = 0;                    ///< the largest error
    double2 worstPlace{ 0.0 };              ///< where in the image, texels
};

/// `halves` and `intensity` as stored; `chartErrors`: the standard error in lux that the report states of each chart.
HeldOutReport compareHeldOut(std::span<const HeldOutPoint> points, std::span<const TexelLight> traced,
                             assets::Image const& halves, double intensity, std::span<const double> chartErrors);

} // namespace filament_core::bake
