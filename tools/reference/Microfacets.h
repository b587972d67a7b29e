// SPDX-License-Identifier: Apache-2.0
/// Shared by all microfacet lobes: frames, GGX with visible normals, and reflectance and transmittance of an interface.
///   Space   local: z is the normal. Views lie above the horizon (liftedAboveHorizon()).
///   Source  Heitz 2018, "Sampling the GGX Distribution of Visible Normals"; Walter et al. 2007, "Microfacet Models for
///           Refraction through Rough Surfaces".
///   Thread  values. Memory: none.
#pragma once

#include "tools/reference/BsdfModel.h"
#include "tools/reference/Surface.h"

namespace filament_core::reference {

/// An orthonormal frame around a normal.
struct Frame {
    double3 tangent{ 1, 0, 0 }, bitangent{ 0, 1, 0 }, normal{ 0, 0, 1 };

    Frame() = default;
    explicit Frame(double3 normal);
    /// x is the part of `tangent` perpendicular to the normal; arbitrary if there is none.
    Frame(double3 normal, double3 tangent);
    double3 toLocal(double3 v) const { return { glm::dot(v, tangent), glm::dot(v, bitangent), glm::dot(v, normal) }; }
    double3 toWorld(double3 v) const { return tangent * v.x + bitangent * v.y + normal * v.z; }
};

/// Moves the view to a cosine of at least kMinNov.
double3 liftedAboveHorizon(double3 view);

/// A half vector, distributed as seen from `view`. u in (0, 1)^2.
double3 sampleVisibleNormal(double3 view, double2 alpha, double2 u);
/// Smith's masking of one direction, on either side of the surface: [0, 1].
double smithMasking(double3 direction, double2 alpha);
/// Density of half vectors, 1/sr. Isotropic if both roughnesses are equal.
double ggx(double3 halfway, double2 alpha);
/// Density of sampleVisibleNormal() for light mirrored by those half vectors; 0 below the horizon of the half vectors.
double visibleReflectionPdf(double3 view, double3 light, double2 alpha);

/// The reflectance of an interface, from outside or from inside a solid.
class Interface {
public:
    Interface(SurfaceSample const& surface, FresnelTerm term)
            : mF0(surface.f0), mF90(surface.f90), mMetallic(surface.metallic), mTerm(term),
              mBelow(surface.transmission), mFilm(surface.film) {}

    double3 f0() const { return mF0; }
    double f90() const { return mF90; }
    /// cosine in [0, 1] with the facet, on the side of the view. 1 under total internal reflection. For a thin sheet:
    /// including its other side, after all bounces between both.
    double3 reflectance(double cosine) const;
    /// Light that continues behind the surface: into or out of a solid, or through both sides of the sheet.
    double3 transmittance(double cosine) const;

private:
    double3 single(double cosine) const; ///< reflectance of one side
    double3 throughSheet(double cosine) const;

    double3 mF0;
    double mF90, mMetallic;
    FresnelTerm mTerm;
    TransmissionSample mBelow;
    FilmSample mFilm;
};

} // namespace filament_core::reference
