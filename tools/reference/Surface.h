// SPDX-License-Identifier: Apache-2.0
/// SurfaceSample: all that shading needs to know about the point that a ray hit: the engine's struct Surface
/// (shaders/material/surface_lit_shading.glsl) in double precision, with its geometry. What later materials add
/// (clear coat, sheen, transmission, ...) becomes members here and lobes in Bsdf.
///   Space   world relative to TracedScene's origin; directions are unit.
#pragma once

#include "filament_core/math/Math.h"

namespace filament::reference {

/// As in shaders/material/surface_fragment_api.glsl.
inline constexpr double kMinNov = 1e-4;

struct SurfaceSample {
    double3 position{ 0.0 };
    double3 geometricNormal{ 0, 0, 1 }; ///< of the triangle, on the side that the ray came from
    double3 normal{ 0, 0, 1 };          ///< of the shading: interpolated, then normal-mapped
    double3 view{ 0, 0, 1 };            ///< towards where the ray came from

    double3 diffuse{ 0.0 }; ///< albedo of the diffuse lobe, times opacity if the material blends
    double3 f0{ 0.04 };
    double f90 = 1;
    double metallic = 0;            ///< edge tint of the exact Fresnel term
    double perceptualRoughness = 1; ///< clamped to what the engine's fp32 shading takes, [0.045, 1]
    double occlusion = 1;           ///< of the material's map, [0, 1]

    double opacity = 1;          ///< 1 - what passes straight through
    double3 emitted{ 0.0 };      ///< radiance as it goes into the picture: not exposed, see gltf_lit.glsl
    bool scatters = true;        ///< false: unlit, emits its colour and reflects nothing
    double selfAvoidance = 1e-6; ///< metres along the geometric normal that keep a new ray off this surface

    /// Where rays into `direction` start.
    double3 rayOrigin(double3 direction) const {
        const double side = glm::dot(direction, geometricNormal) < 0 ? -1 : 1;
        return position + geometricNormal * (side * selfAvoidance);
    }
};

} // namespace filament::reference
