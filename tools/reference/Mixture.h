// SPDX-License-Identifier: Apache-2.0
/// Mixture: the two steps between a material's values at a point and its lobes.
///   meetPart()       chooses the part of a mixture that a path meets: each has a plain meaning of its own, where one
///                    f0 and one colour for all of them would lose energy.
///   coverWithFilm()  gives the base the f0 of base and film towards the view, as the engine does
///                    (shaders/material/surface/iridescence.glsl); microfacets evaluate the film themselves.
///   Thread  any. Memory: none. Fails: never.
#pragma once

#include "tools/reference/Surface.h"

namespace filament_core::reference {

/// u in [0, 1), uniform. Surfaces without a mixture stay as they are.
void meetPart(SurfaceSample& surface, double u);

/// Partly metallic, and opaque: metal and dielectric are summed. Not under a film, which the engine puts over both.
bool isSum(SurfaceSample const& surface);

void coverWithFilm(SurfaceSample& surface);

/// Reflectance of base and film; cosine in (0, 1] with the facet, in air.
double3 filmReflectance(FilmSample const& film, double cosine);

} // namespace filament_core::reference
