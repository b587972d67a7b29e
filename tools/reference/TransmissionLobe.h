// SPDX-License-Identifier: Apache-2.0
/// TransmissionLobe: light that goes through the surface: a GGX lobe on its other side.
///   Solid   Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", eq. 21, by visible normals;
///           radiance is spread over the square of the relative index. Without a change of index: straight on.
///   Thin    the lobe of reflection, mirrored to the other side, as wide as the engine takes it to be
///           (refractionPerceptualRoughness()); both sides and all bounces between them (Interface).
///   Look-up Integrator::Unoccluded traces one surface only: a solid is the ball that the engine takes it for
///           (shaders/material/surface/refraction.glsl), its lobe the pre-filtered one around the direction that leaves
///           it. With SpecularLight::SplitSum a sheet is looked through in the same way. Lights are not looked up: none
///           shines through a ball.
///   Space   world. Thread: a value. Memory: none.
#pragma once

#include "tools/reference/StandardLobes.h"

namespace filament::reference {

class TransmissionLobe {
public:
    /// `isBall`: solids as the engine has them. `specularAlbedo`: of the base, what look-ups take for its reflectance.
    TransmissionLobe(SurfaceSample const& surface, BsdfModel const& model, bool isBall, double3 specularAlbedo);

    /// f * |cos|; zero above the surface. All zero if isStraight().
    double3 evaluate(double3 light, LightSource source) const;
    std::optional<double3> sample(double2 u) const;
    double pdf(double3 light) const;
    /// About how much of all light goes through.
    double3 albedo() const { return mAlbedo; }
    /// Of the lobe: alpha.
    double width() const { return mAlpha.x; }
    /// One direction, that of the view, and the share of light that goes there: no density.
    bool isStraight() const { return mKind == Kind::Straight; }
    double3 straightShare() const { return mAlbedo; }

private:
    enum class Kind : uint8_t { Thin, Solid, LookUp, Straight };
    double3 mirrored(double3 local) const { return { local.x, local.y, -local.z }; }
    double3 halfway(double3 local) const; ///< of a solid, above the surface
    double3 throughSheet(double3 local) const;
    void lookUp(SurfaceSample const& surface, double3 specularAlbedo);

    Kind mKind;
    Interface mInterface;
    Frame mFrame;
    double3 mView; // local
    double2 mAlpha;
    double mEta = 1; // index of the other side over that of the view's
    double3 mAlbedo{ 0.0 };
    bool mIsThin;
    std::array<Frame, 3> mLookUpFrames; // a colour each, in local space
    std::optional<PrefilteredLobe> mLookUpLobe;
};

} // namespace filament::reference
