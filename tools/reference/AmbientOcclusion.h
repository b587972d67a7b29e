// SPDX-License-Identifier: Apache-2.0
/// What the engine's ambient occlusion approximates: the cosine-weighted part of the hemisphere over a triangle in
/// which nothing lies within ReferenceSettings::occlusionRadius, and its mean direction, by rays of that length.
///   Out     a number for shading with the engine's own formula, as if a map of the material held it: the smaller of
///           both.
///   Rays    ReferenceSettings::occlusionRays for each sample of a pixel, evenly spread and turned at random.
///   Thread  any; pure.   Memory: none.
#pragma once

#include "tools/reference/Reference.h"
#include "tools/reference/SampleStream.h"
#include "tools/reference/Surface.h"

namespace filament_core::reference {

/// `pair`: a pair of dimensions of `numbers` that nothing else uses.
void occludeAmbientLight(TracedScene const& scene, ReferenceSettings const& settings, SampleStream const& numbers,
                         uint32_t pair, SurfaceSample& surface, uint64_t& rays);

} // namespace filament_core::reference
