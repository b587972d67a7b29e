// SPDX-License-Identifier: Apache-2.0
/// Evaluates the engine's glTF materials (shaders/material/gltf) at a point: textures and factors in, a SurfaceSample
/// out, with all KHR_materials extensions.
///   Normals  as in MikkTSpace: the interpolated frame is not normalised, but the result of the normal map is. Seen
///            from behind, a surface's whole frame is reversed.
///   Thread   pure functions.
#pragma once

#include "tools/reference/Geometry.h"
#include "tools/reference/Surface.h"

namespace filament_core::reference {

/// `view`: unit, towards the origin of the ray.
SurfaceSample surfaceAt(Part const& part, TrianglePoint const& point, double3 view);

/// Whether an alpha mask cuts the surface away at this point; never for opaque and blended materials.
bool isMaskedOut(Part const& part, TrianglePoint const& point);

/// 1 for opaque and masked materials.
double opacityAt(Part const& part, TrianglePoint const& point);

/// What of the light that arrives in `direction` passes straight through, in each colour, as into the engine's coloured
/// shadow maps (shaders/material/surface/depth_main.glsl). 0 if the material transmits none.
double3 passedAt(Part const& part, TrianglePoint const& point, double3 direction);

} // namespace filament_core::reference
