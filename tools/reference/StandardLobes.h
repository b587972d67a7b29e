// SPDX-License-Identifier: Apache-2.0
/// StandardLobes: the base of the standard material: a diffuse lobe and an isotropic or anisotropic GGX lobe.
///   Value   f(view, light) * cos, in 1/sr: diffuse lobe, and D V F * energy compensation, from shaders/lib in double.
///   Sampler chooses a lobe in proportion to the lobes' albedos: visible half vectors, or cosine.
///   Thread  a value. Memory: none, except for the tables of a split sum.
#pragma once

#include "tools/reference/Coupling.h"
#include "tools/reference/Microfacets.h"
#include "tools/reference/Prefiltered.h"

#include <optional>
#include <vector>

namespace filament_core::reference {

/// The reflectance of a base's diffuse and specular lobe; the layers above change each in a different way.
struct LobeValues {
    double3 diffuse{ 0.0 }, specular{ 0.0 };
};

class StandardLobes {
public:
    StandardLobes(SurfaceSample const& surface, BsdfModel const& model, bool useOcclusion);

    /// f * cos(light, normal), zero below the horizon. `light`: world, unit. With SplitSum, its lobe replaces the
    /// specular lobe and may extend below the horizon, as in the engine.
    LobeValues evaluate(double3 light, LightSource source) const;
    /// A direction of the world, or none. u and choice in (0, 1).
    std::optional<double3> sample(double2 u, double choice) const;
    /// Density of sample(), per steradian.
    double pdf(double3 light) const;
    /// The factor of irradiance / pi around the normal with DiffuseLight::Harmonics; 0 with an integral.
    double3 harmonicAlbedo() const;
    /// Approximate fraction of all light that both lobes reflect: for choosing between layers.
    double3 albedo() const { return mAlbedo; }
    double3 specularAlbedo() const { return mSpecularAlbedo; }
    /// The share of light from either side that reaches a diffuse lobe. `light`: as above.
    double3 diffuseShare(double3 light, LightSource source) const;

private:
    double specularOcclusionOf(SurfaceSample const& surface) const;
    double3 mirroredView(SurfaceSample const& surface) const; ///< local; the engine's look-up direction
    double visibility(double3 light) const;
    double diffuseTerm(double nol, double voh) const;
    double diffuseCosine(double3 local, LightSource source) const;
    LobeValues lobesAt(double3 local, LightSource source) const;
    double3 sampleSpecular(double2 u) const; ///< local
    double specularPdf(double3 light) const;
    void sumParts(SurfaceSample const& surface, double2 dfg, double3& albedo);
    void usePrefiltered(SurfaceSample const& surface, double2 dfg);
    void lookUpAlongGrain();
    double3 sampleLookUps(double2 u) const;

    BsdfModel mModel;
    Interface mInterface;
    Frame mFrame;
    double3 mView; // local, lifted to nov = kMinNov if it is below that
    double mRoughness;
    double2 mAlpha; // along tangent and bitangent
    double3 mDiffuse;
    double3 mCompensation;
    Coupling mCoupling;
    double3 mAmbientDiffuse{ 1.0 };         // occlusion
    std::optional<Frame> mOpen;             // around the bent normal, in local space; none: the normal's
    double mAmbientSpecular = 1;            // occlusion
    std::optional<double3> mUnmappedNormal; // hides lamps below it, as in the engine; none: nothing does
    double mSpecularChance = 0;
    double3 mAlbedo{ 0.0 }, mSpecularAlbedo{ 0.0 };
    /// One of the engine's look-ups: a pre-filtered lobe in local space.
    struct LookUp {
        SplitSumLobe lobe;
        Frame frame;
        double share; ///< all of them add up to 1
    };
    std::vector<LookUp> mLookUps; // SpecularLight::SplitSum; else empty
    double3 mLobeAlbedo{ 0.0 };
};

} // namespace filament_core::reference
