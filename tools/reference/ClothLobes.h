// SPDX-License-Identifier: Apache-2.0
/// ClothLobes: the base of the cloth model: fibres in place of the specular lobe, and a diffuse lobe that light also
/// reaches from behind (shaders/lib/cloth.glsl).
///   Space   world. Thread: a value. Memory: none.
#pragma once

#include "tools/reference/StandardLobes.h"

#include <algorithm>

namespace filament_core::reference {

class ClothLobes {
public:
    ClothLobes(SurfaceSample const& surface, BsdfModel const& model);

    /// f * cos. With a subsurface colour the diffuse lobe reaches below the horizon.
    LobeValues evaluate(double3 light, LightSource source) const;
    std::optional<double3> sample(double2 u, double choice) const;
    double pdf(double3 light) const;
    double3 harmonicAlbedo() const { return double3(0.0); }
    double3 albedo() const;
    double3 specularAlbedo() const { return mSheenColor * std::min(mViewAlbedo, 1.0); }
    double3 diffuseShare(double3, LightSource) const { return double3(1.0); } ///< nothing is reflected above it

private:
    LobeChoice mChoice;
    Frame mFrame;
    double3 mView; // local
    double mRoughness, mAlpha;
    double3 mDiffuse, mSheenColor;
    std::optional<double3> mSubsurfaceColor;
    double mViewAlbedo;
};

} // namespace filament_core::reference
