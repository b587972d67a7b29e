// SPDX-License-Identifier: Apache-2.0
/// Noise: repeating patterns for textures that tile. The same values on every run.
///   In      a point in cells and the period in cells: the pattern is the same at p and p + period.
///   Thread  any; pure functions.  Cost: fractalNoise about 30 ns per octave, cells about 150 ns.
#pragma once

#include "base/math/Math.h"

#include <cstdint>

namespace filament_core::showcase {

/// Uniform in [0, 1) by cell and seed.
float cellRandom(int2 cell, uint32_t seed);

/// Smooth noise in [0, 1] with one feature per cell.
float valueNoise(float2 point, int2 period, uint32_t seed);

/// `octaves` of value noise, each with twice the frequency and half the weight of the previous one; in [0, 1].
float fractalNoise(float2 point, int2 period, uint32_t octaves, uint32_t seed);

/// The nearest of one random point per cell (Worley 1996, "A Cellular Texture Basis Function").
struct CellularSample {
    float distance = 0;     ///< to the nearest point, in cells
    float edgeDistance = 0; ///< to the border with the second nearest, in cells
    float random = 0;       ///< of the nearest point, uniform in [0, 1)
};
CellularSample cellularNoise(float2 point, int2 period, uint32_t seed);

} // namespace filament_core::showcase
