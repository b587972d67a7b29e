// SPDX-License-Identifier: Apache-2.0
/// SurfaceSample: all that shading needs to know about the point that a ray hit: the engine's struct Surface
/// (shaders/material/surface/main.glsl) in double precision, with its geometry. Each further layer is a struct of
/// its own whose default is not there; Bsdf.h stacks them.
///   Space   world relative to TracedScene's origin; directions are unit.
///   Roughness  perceptual, clamped to what the engine's fp32 shading takes, [0.045, 1].
#pragma once

#include "base/math/Math.h"

#include <optional>

namespace filament::reference {

/// As in shaders/material/surface/fragment_api.glsl.
inline constexpr double kMinNov = 1e-4;

/// Above everything else: dielectric, of index 1.5 (shaders/lib/coat.glsl).
struct CoatSample {
    double strength = 0; ///< how much of the surface is coated, [0, 1]
    double perceptualRoughness = 0.045;
    double3 normal{ 0, 0, 1 };
    double3 bareF0{ 0.04 }; ///< of the base where it is not coated; SurfaceSample::f0 is that below the coat
};

/// Fibres between coat and base (shaders/lib/sheen.glsl).
struct SheenSample {
    double3 color{ 0.0 }; ///< [0, 1]; black: none
    double perceptualRoughness = 1;
};

/// Fibres in the place of the specular lobe: the base is cloth (shaders/lib/cloth.glsl).
struct ClothSample {
    bool isCloth = false;
    double3 sheenColor{ 0.04 };
    std::optional<double3> subsurfaceColor; ///< none: the diffuse lobe is Lambert's
};

/// What light that is not reflected does below the surface (shaders/lib/refraction.glsl).
struct TransmissionSample {
    double3 color{ 0.0 };      ///< of the light that enters, how much goes on; black: none
    double share = 1;          ///< color without the material's base colour
    bool isThin = true;        ///< both sides of a sheet in one surface; else the boundary of a solid
    bool isFromInside = false; ///< of a solid: the ray comes from within it
    double ior = 1.5;          ///< of the inside, >= 1; for paths of one colour that colour's
    double dispersion = 0;     ///< 20 / Abbe's number
    double3 absorption{ 0.0 }; ///< 1/m, of a solid's inside or of the sheet
    double thickness = 0;      ///< metres: of the sheet, and of what the engine takes a solid for
};

/// What the diffuse lobe sends through the surface (KHR_materials_diffuse_transmission).
struct DiffuseTransmissionSample {
    double3 color{
        0.0
    }; ///< albedo of the lobe behind the surface; black: none. Taken off SurfaceSample::diffuse already
};

struct SurfaceSample {
    double3 position{ 0.0 };
    double3 geometricNormal{ 0, 0, 1 };    ///< of the triangle, on the side that the ray came from
    double3 normal{ 0, 0, 1 };             ///< of the shading: interpolated, then normal-mapped
    std::optional<double3> unmappedNormal; ///< that before a normal map tilted it; none: nothing does
    double3 view{ 0, 0, 1 };               ///< towards where the ray came from

    double3 diffuse{ 0.0 }; ///< albedo of the diffuse lobe, times opacity if the material blends
    double3 f0{ 0.04 };
    double f90 = 1;
    double metallic = 0; ///< edge tint of the exact Fresnel term
    double perceptualRoughness = 1;
    double occlusion = 1; ///< of the material's map, [0, 1]
    std::optional<double3>
            bentNormal; ///< where light comes from that is not occluded; occlusion is then a cone around it
    double2 uv{ 0.0 };  ///< of the first set

    double2 stretchedAlpha{ 0.0 }; ///< of an anisotropic lobe, along the tangent and across; 0: round
    double anisotropy = 0;         ///< [-1, 1]: by how much the engine bends its reflections
    double3 tangent{ 1, 0, 0 };    ///< of that lobe; made perpendicular to the normal by who uses it
    CoatSample coat{};
    SheenSample sheen{};
    ClothSample cloth{};
    TransmissionSample transmission{};
    DiffuseTransmissionSample diffuseTransmission{};

    double opacity = 1;          ///< 1 - what passes straight through
    double3 emitted{ 0.0 };      ///< radiance as it goes into the picture: not exposed, see gltf/lit.glsl
    bool scatters = true;        ///< false: unlit, emits its colour and reflects nothing
    double selfAvoidance = 1e-6; ///< metres along the geometric normal that keep a new ray off this surface

    bool transmits() const { return transmission.color != double3(0.0) || diffuseTransmission.color != double3(0.0); }
    /// Where rays into `direction` start.
    double3 rayOrigin(double3 direction) const {
        const double side = glm::dot(direction, geometricNormal) < 0 ? -1 : 1;
        return position + geometricNormal * (side * selfAvoidance);
    }
};

// As shaders/material/surface/lit_shading.glsl.

/// What grazing light finds: what reflects less than 2 % wants no reflection at all.
double f90Of(double3 f0);
/// Of a base of this f0 in air, as far as it is coated.
double3 f0BelowCoat(double3 bareF0, double strength);

} // namespace filament::reference
