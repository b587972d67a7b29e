// SPDX-License-Identifier: Apache-2.0
/// chooseScales: how dense each chart of a lightmap should be, so that a budget of texels buys the least error.
///   Error   of a chart: what is lost if only every second texel is kept and those between are interpolated, as a bake
///           of few texels shows it, without the part that its standard errors explain. Mean squares are taken to fall
///           with the square of the density, between those of shadow edges (its first power) and of smooth light (the
///           fourth).
///   Choice  a knapsack, solved greedily: every chart begins as coarse as allowed; then the step that lowers the sum of
///           squared errors most for each texel that it costs is taken, until none fits. Steps of a chart gain less and
///           less, so no other choice of as many texels is better by more than one step.
///   Thread  any; pure: the same scales for the same texels.
#pragma once

#include "tools/bake/BakeLight.h"

namespace filament_core::bake {

inline constexpr double kLeastScale = 0.25, kMostScale = 4;

/// What a bake at one density says of a chart.
struct ChartDetail {
    double2 size{ 0.0 };        ///< texels of its box, without padding
    uint64_t texels = 0;        ///< that were traced
    double meanSquareError = 0; ///< lux^2: of the luminance, at half of that density
};
std::vector<ChartDetail> measureDetail(Atlas const& atlas, std::span<const AtlasTexel> texels,
                                       std::span<const TexelLight> lights);

/// For each chart a factor of that density, [kLeastScale, kMostScale] * `base`, with at most `budget` texels in all,
/// or those of the smallest factors.
std::vector<double> chooseScales(std::span<const ChartDetail> charts, double base, double budget);

/// The atlas of a budget of texels: `options` at the density that spends it evenly, and scales that spend it where a
/// bake of a quarter of it, at `light` with fewer samples, finds detail. Fails as makeAtlas().
Result<Atlas> makeBudgetAtlas(reference::TracedScene const& scene, std::span<const BakeSurface> surfaces,
                              AtlasOptions const& options, LightSettings const& light, uint64_t budget,
                              jobs::JobSystem& jobs);

} // namespace filament_core::bake
