// SPDX-License-Identifier: Apache-2.0
/// SurfaceSample: everything that shading needs to know about the point that a ray hit: the engine's struct Surface
/// (shaders/material/surface/lit_surface.glsl) in double precision, with its geometry. Each further layer is a separate
/// struct, absent by default; Bsdf.h stacks them.
///   Space   world relative to TracedScene's origin; directions are unit.
///   Roughness  perceptual, clamped to the range of the engine's fp32 shading, [0.045, 1].
#pragma once

#include "base/math/Math.h"

#include <optional>

namespace filament_core::reference {

/// As in shaders/material/surface/fragment_api.glsl.
inline constexpr double kMinNov = 1e-4;

/// On top of everything else: dielectric, of index 1.5 (shaders/lib/coat.glsl).
struct CoatSample {
    double strength = 0; ///< coated fraction of the surface, [0, 1]
    double perceptualRoughness = 0.045;
    double3 normal{ 0, 0, 1 };
    double3 bareF0{ 0.04 }; ///< of the base where it has no coat; SurfaceSample::f0 is that below the coat
};

/// Fibres between coat and base (shaders/lib/sheen.glsl).
struct SheenSample {
    double3 color{ 0.0 }; ///< [0, 1]; black: none
    double perceptualRoughness = 1;
};

/// Fibres instead of the specular lobe: the base is cloth (shaders/lib/cloth.glsl).
struct ClothSample {
    bool isCloth = false;
    double3 sheenColor{ 0.04 };
    std::optional<double3> subsurfaceColor; ///< none: the diffuse lobe is Lambert's
};

/// Transmission of the light that is not reflected (shaders/lib/refraction.glsl).
struct TransmissionSample {
    double3 color{ 0.0 };      ///< fraction of the entering light that continues; black: none
    double share = 1;          ///< color without the material's base colour
    bool isThin = true;        ///< both sides of a sheet in one surface; otherwise the boundary of a solid
    bool isFromInside = false; ///< of a solid: the ray comes from inside it
    double ior = 1.5;          ///< of the inside, >= 1; for single-colour paths that of the colour
    double dispersion = 0;     ///< 20 / Abbe's number
    double3 absorption{ 0.0 }; ///< 1/m, inside the solid or the sheet
    double thickness = 0;      ///< metres: of the sheet, or of the ball that the engine uses for a solid
};

/// Light that the diffuse lobe sends through the surface (KHR_materials_diffuse_transmission).
struct DiffuseTransmissionSample {
    double3 color{
        0.0
    }; ///< albedo of the lobe behind the surface; black: none. Already removed from SurfaceSample::diffuse
};

/// What scatters light inside a solid (KHR_materials_volume_scatter).
struct MediumSample {
    double3 extinction{ 0.0 }; ///< 1/m, by colour
    double3 albedo{ 0.0 };     ///< the part of it that is scattered
    double anisotropy = 0;     ///< mean cosine of the angle by which light turns
    bool isFromInside = false; ///< the ray comes from inside it
};

/// A thin film on the base (KHR_materials_iridescence, shaders/lib/iridescence.glsl).
struct FilmSample {
    double strength = 0; ///< covered fraction, [0, 1]; 0: none
    double ior = 1.3;
    double thickness = 0;   ///< nanometres
    double outsideIor = 1;  ///< of the medium above: air, or a coat
    double3 bareF0{ 0.04 }; ///< of the base without it; SurfaceSample::f0 is that of base and film towards the view
};

/// What a glTF material mixes: a metal, a dielectric that transmits, and one that does not (glTF 2.0, appendix B.2;
/// KHR_materials_transmission). If it transmits, a path meets one of them, chosen by its share. If not, their lobes
/// differ in f0 alone and are summed: StandardLobes.
struct MixtureSample {
    double3 color{ 1.0 }; ///< of metal and dielectric
    double3 dielectricF0{ 0.04 };
    double dielectricF90 = 1;
    double transmitted = 1; ///< share of the dielectric that transmits
};

struct SurfaceSample {
    double3 position{ 0.0 };
    double3 geometricNormal{ 0, 0, 1 };    ///< of the triangle, on the side of the ray's origin
    double3 normal{ 0, 0, 1 };             ///< shading normal: interpolated, then normal-mapped
    std::optional<double3> unmappedNormal; ///< the normal before a normal map tilted it; none: there is no map
    double3 view{ 0, 0, 1 };               ///< towards the ray's origin

    double3 diffuse{ 0.0 }; ///< albedo of the diffuse lobe
    double3 f0{ 0.04 };
    double f90 = 1;
    double metallic = 0; ///< edge tint of the exact Fresnel term
    double perceptualRoughness = 1;
    double occlusion = 1;              ///< of the material's map, [0, 1]
    std::optional<double3> bentNormal; ///< mean direction of unoccluded light; occlusion is then a cone around it
    bool bendsReflections = true;      ///< that cone occludes reflections, too; otherwise they know the occlusion alone
    double2 uv{ 0.0 };                 ///< of the first set

    double2 stretchedAlpha{ 0.0 }; ///< of an anisotropic lobe, along the tangent and across it; 0: isotropic
    double anisotropy = 0;         ///< [-1, 1]: how much the engine bends its reflections
    double3 tangent{ 1, 0, 0 };    ///< of that lobe; users make it perpendicular to the normal
    CoatSample coat{};
    SheenSample sheen{};
    ClothSample cloth{};
    TransmissionSample transmission{};
    DiffuseTransmissionSample diffuseTransmission{};
    FilmSample film{};
    std::optional<MediumSample> medium;   ///< below the surface, if it scatters
    std::optional<MixtureSample> mixture; ///< none: the members above are all there is

    double opacity = 1;          ///< covered fraction: all that this struct says is of that fraction
    double3 emitted{ 0.0 };      ///< radiance as added to the image: not exposed, see gltf/lit.glsl
    bool scatters = true;        ///< false: unlit; emits its colour and reflects nothing
    double selfAvoidance = 1e-6; ///< metres along the geometric normal that keep a new ray from hitting this surface

    bool transmits() const { return transmission.color != double3(0.0) || diffuseTransmission.color != double3(0.0); }
    /// The origin of rays into `direction`.
    double3 rayOrigin(double3 direction) const {
        const double side = glm::dot(direction, geometricNormal) < 0 ? -1 : 1;
        return position + geometricNormal * (side * selfAvoidance);
    }
};

// As shaders/material/surface/lit_shading.glsl.

/// Reflectance at grazing angles: a surface that reflects less than 2 % wants no reflection at all.
double f90Of(double3 f0);
/// For a base with this f0 in air, according to its coated fraction.
double3 f0BelowCoat(double3 bareF0, double strength);

} // namespace filament_core::reference
