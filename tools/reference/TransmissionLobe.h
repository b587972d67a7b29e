// SPDX-License-Identifier: Apache-2.0
/// TransmissionLobe: light that passes through the surface: a GGX lobe on its other side.
///   Solid   Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", eq. 21, with visible
///           normals; radiance scales with the square of the relative index. Without a change of index: straight
///           through.
///   Thin    the reflection lobe mirrored to the other side, with the engine's width (refractionPerceptualRoughness());
///           both sides and all bounces between them (Interface).
///   Look-up Integrator::Unoccluded traces one surface only: a solid is the engine's ball
///   (shaders/material/surface/refraction.glsl), and its lobe the pre-filtered one around the exit direction. With
///   SpecularLight::SplitSum a sheet is looked through in the same way. There are no look-ups of lights: none shines
///   through a ball.
///   Space   world. Thread: a value. Memory: none.
#pragma once

#include "tools/reference/StandardLobes.h"

namespace filament_core::reference {

class TransmissionLobe {
public:
    /// `isBall`: solids as in the engine. `specularAlbedo`: of the base; look-ups use it as reflectance.
    TransmissionLobe(SurfaceSample const& surface, BsdfModel const& model, bool isBall, double3 specularAlbedo);

    /// f * |cos|; zero above the surface. All zero if isStraight().
    double3 evaluate(double3 light, LightSource source) const;
    std::optional<double3> sample(double2 u) const;
    double pdf(double3 light) const;
    /// Approximate fraction of all light that is transmitted.
    double3 albedo() const { return mAlbedo; }
    /// Width of the lobe: alpha.
    double width() const { return mAlpha.x; }
    /// A single direction, that of the view, and the fraction of light transmitted there: no density.
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
    double mEta = 1; // index on the other side over that on the view's side
    double3 mAlbedo{ 0.0 };
    bool mIsThin;
    std::array<Frame, 3> mLookUpFrames; // one per colour, in local space
    std::optional<PrefilteredLobe> mLookUpLobe;
};

} // namespace filament_core::reference
