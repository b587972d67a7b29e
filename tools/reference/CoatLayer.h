// SPDX-License-Identifier: Apache-2.0
/// CoatLayer: a clear coat of index 1.5: its lobe, and what it leaves to the layers below.
///   Engine  shaders/material/surface/coat.glsl: Kelemen's visibility, Schlick's term. Below it everything is
///           multiplied by the lesser of what passes towards the view and from the light, neither of which bends;
///           ambient light by the former.
///   Exact   Smith's visibility, Fresnel's equations. Directions bend at the coat; radiance from within is spread over
///           index^2 times the solid angle. What the coat reflects back inside adds up to a geometric series:
///             specular base  1 / (1 - F R), exact for mirrors. Of rough metals it lacks what total reflection returns:
///                            up to 8 % at roughness 0.5.
///             diffuse base   its colour is what is seen without a coat, so of a series that ends where the base's own
///                            interface was: 1 / (1 - mean of F over the hemisphere). White stays white.
///           A test walks light through both interfaces, bounce by bounce, and finds the same within that.
///   Space   world. Thread: a value. Memory: none.
#pragma once

#include "tools/reference/StandardLobes.h"

namespace filament::reference {

class CoatLayer {
public:
    CoatLayer(SurfaceSample const& surface, BsdfModel const& model);

    /// f * cos(light, coat's normal); zero below its horizon.
    double evaluate(double3 light, LightSource source) const;
    std::optional<double3> sample(double2 u) const;
    double pdf(double3 light) const;
    /// About how much of all light it reflects.
    double albedo() const { return mAlbedo; }

    bool isExact() const { return mTerm == CoatTerm::Exact; }
    /// CoatTerm::Engine: the factor of everything below, for light of one direction.
    double attenuation(double3 light, LightSource source) const;
    /// The same for light that leaves through the surface's other side.
    double attenuationOfView() const { return 1 - mStrength * (1 - mViewTransmission); }

    // CoatTerm::Exact, for the part of the surface that is coated.
    double strength() const { return mStrength; }
    double3 viewInside() const;
    /// None: the light is below the coat's horizon, or cannot leave.
    std::optional<double3> inside(double3 light) const;
    std::optional<double3> outside(double3 lightInside) const;
    /// Of what a base gives for viewInside() and inside(light); `specularAlbedo`: the base's.
    double3 combined(LobeValues const& below, double3 specularAlbedo, double3 light) const;
    /// Density outside over density inside.
    double spread(double3 light) const;

private:
    double transmission(double cosine) const; ///< strength aside

    CoatTerm mTerm;
    FresnelTerm mFresnel;
    double mStrength, mRoughness, mAlpha;
    Frame mFrame;
    double3 mView; // local
    double mViewTransmission = 1, mMeanTransmission = 1;
    double mAlbedo = 0;
    std::optional<SplitSumLobe> mLobe;
    Frame mLobeFrame;
    double mLobeAlbedo = 0;
};

} // namespace filament::reference
