// SPDX-License-Identifier: Apache-2.0
/// What the glTF materials of the engine (shaders/material/gltf_*.glsl) make of a point: textures and factors in, a
/// SurfaceSample out, with the KHR_materials extensions but iridescence.
///   Normals  as MikkTSpace asks: the interpolated frame is not normalised, the result of the normal map is. Seen from
///            behind, a surface's whole frame looks the other way.
///   Thread   pure functions.
#pragma once

#include "tools/reference/Geometry.h"
#include "tools/reference/Surface.h"

namespace filament::reference {

/// `view`: unit, towards where the ray came from.
SurfaceSample surfaceAt(Part const& part, TrianglePoint const& point, double3 view);

/// Whether an alpha mask cuts the surface away at this point. Opaque and blended materials: never.
bool isMaskedOut(Part const& part, TrianglePoint const& point);

/// 1 for opaque and masked materials.
double opacityAt(Part const& part, TrianglePoint const& point);

} // namespace filament::reference
