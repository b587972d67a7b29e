// SPDX-License-Identifier: Apache-2.0
/// TransmissionLobe: light that goes through the surface: a GGX lobe on its other side.
///   Solid   Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", eq. 21, by visible normals;
///           radiance is spread over the square of the relative index. Without a change of index: straight on.
///   Thin    the lobe of reflection, mirrored to the other side, as wide as the engine takes it to be
///           (refractionPerceptualRoughness()); both sides and all bounces between them (Interface).
///   Ball    Integrator::Unoccluded traces one surface only: a solid is the ball that the engine takes it for
///           (shaders/lib/refraction.glsl), its lobe the pre-filtered one around the direction that leaves it.
///   Space   world. Thread: a value. Memory: none.
#pragma once

#include "tools/reference/StandardLobes.h"

namespace filament::reference {

class TransmissionLobe {
public:
    /// `isBall`: solids as the engine has them.
    TransmissionLobe(SurfaceSample const& surface, BsdfModel const& model, bool isBall);

    /// f * |cos|; zero above the surface. All zero if isStraight().
    double3 evaluate(double3 light) const;
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
    enum class Kind : uint8_t { Thin, Solid, Ball, Straight };
    double3 mirrored(double3 local) const { return { local.x, local.y, -local.z }; }
    double3 halfway(double3 local) const; ///< of a solid, above the surface

    Kind mKind;
    Interface mInterface;
    Frame mFrame;
    double3 mView; // local
    double2 mAlpha;
    double mEta = 1; // index of the other side over that of the view's
    double3 mAlbedo{ 0.0 };
    std::array<Frame, 3> mBallFrames; // a colour each, in local space
    std::optional<PrefilteredLobe> mBallLobe;
};

} // namespace filament::reference
