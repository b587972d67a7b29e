// SPDX-License-Identifier: Apache-2.0
/// SheenLayer: Charlie's fibres above a base, and the light they leave to it.
///   Engine  KHR_materials_sheen's albedo scaling (shaders/lib/sheen.glsl).
///   Exact   base * (1 - E(v)) (1 - E(l)) / (1 - mean E), where E is the albedo of the fibres: Kulla and Conty 2017,
///           "Revisiting Physically Based Shading at Imageworks", applied to layers. Reciprocal; white on white
///           reflects all light.
///   Space   world. Thread: a value. Memory: none.
#pragma once

#include "tools/reference/StandardLobes.h"

namespace filament_core::reference {

class SheenLayer {
public:
    SheenLayer(SurfaceSample const& surface, BsdfModel const& model);

    /// f * cos, without the layers above.
    double3 evaluate(double3 light, LightSource source) const;
    std::optional<double3> sample(double2 u) const;
    double pdf(double3 light) const;
    double3 albedo() const;
    /// The factor of the base for light from one direction.
    double scaling(double3 light, LightSource source) const;
    double scalingOfView() const { return 1 - mLargest * std::min(mViewAlbedo, 1.0); }

private:
    SheenTerm mTerm;
    double3 mColor;
    double mLargest; // largest component of the colour
    double mRoughness, mAlpha;
    Frame mFrame;
    double3 mView; // local
    double mViewAlbedo;
    double mMean = 0;
    std::optional<SplitSumLobe> mLobe;
    Frame mLobeFrame;
};

} // namespace filament_core::reference
