// SPDX-License-Identifier: Apache-2.0
/// CoatLayer: a clear coat of index 1.5: its lobe, and the light it leaves to the layers below.
///   Engine  shaders/material/surface/coat.glsl: Kelemen's visibility, Schlick's term. The layers below are multiplied
///           by the smaller of the transmissions towards the view and from the light, neither of which bends; ambient
///           light by the transmission towards the view.
///   Exact   Smith's visibility, Fresnel's equations. Directions bend at the coat; radiance from inside is spread over
///           index^2 times the solid angle. Light that the coat reflects back inside adds up to a geometric series:
///             specular base  1 / (1 - F R), exact for mirrors. For rough metals it lacks light returned by total
///                            reflection: up to 8 % at roughness 0.5.
///             diffuse base   its colour is defined without a coat, hence as the result of a series that ends at the
///                            base's own interface: 1 / (1 - mean of F over the hemisphere). White stays white.
///           A test traces light through both interfaces, bounce by bounce, and agrees within that error.
///   Space   world. Thread: a value. Memory: none.
#pragma once

#include "tools/reference/StandardLobes.h"

namespace filament_core::reference {

class CoatLayer {
public:
    CoatLayer(SurfaceSample const& surface, BsdfModel const& model);

    /// f * cos(light, coat's normal); zero below its horizon.
    double evaluate(double3 light, LightSource source) const;
    std::optional<double3> sample(double2 u) const;
    double pdf(double3 light) const;
    /// Approximate fraction of all light that it reflects.
    double albedo() const { return mAlbedo; }

    bool isExact() const { return mTerm == CoatTerm::Exact; }
    /// CoatTerm::Engine: the factor of everything below, for light of one direction.
    double attenuation(double3 light, LightSource source) const;
    /// The same for light that leaves on the surface's other side.
    double attenuationOfView() const { return 1 - mStrength * (1 - mViewTransmission); }

    // CoatTerm::Exact, for the coated part of the surface.
    double strength() const { return mStrength; }
    double3 viewInside() const;
    /// None: the light is below the coat's horizon, or cannot leave.
    std::optional<double3> inside(double3 light) const;
    std::optional<double3> outside(double3 lightInside) const;
    /// Combines the values of a base for viewInside() and inside(light); `specularAlbedo`: the base's.
    double3 combined(LobeValues const& below, double3 specularAlbedo, double3 light) const;
    /// Density outside over density inside.
    double spread(double3 light) const;

private:
    double transmission(double cosine) const; ///< without the factor strength

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

} // namespace filament_core::reference
