// SPDX-License-Identifier: Apache-2.0
/// Coupling: the share of light that the diffuse lobe gets below the specular one (CouplingTerm).
///   Formula  diffuseEntry() and diffuseExit() of shaders/lib/brdf.glsl with exact albedos; for anisotropic lobes the
///            engine's bound, groovesRoughness() of shaders/material/surface/anisotropy.glsl.
///   Thread   a value. Memory: none. Fails: never.
#pragma once

#include "tools/reference/BsdfModel.h"
#include "tools/reference/Microfacets.h"

namespace filament_core::reference {

class Coupling {
public:
    /// `view`: local, z along the normal, in [kMinNov, 1]. `alpha`: along tangent and bitangent.
    Coupling(SurfaceSample const& surface, BsdfModel const& model, double3 view, double2 alpha);

    /// For light that is integrated first, like the engine's environment: the share left towards the view.
    double3 towardsView() const { return mTowardsView; }
    /// For light from one direction: local, z in [0, 1].
    double3 of(double3 light, LightSource source) const;

private:
    double3 reflected(double2 dfg) const;
    double3 reflectedTowards(double3 direction) const;

    double3 mF0;
    double mF90, mRoughness, mAnisotropy;
    double2 mAlpha;
    CouplingTerm mTerm;
    bool mIsCompensated;
    double3 mFar{ 0.0 }; ///< colour of light that crosses a thin sheet twice; black: no far side
    double3 mTowardsView, mExit;
};

} // namespace filament_core::reference
