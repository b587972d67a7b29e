// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/Coupling.h"

#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/DirectionalAlbedo.h"
#include "tools/reference/Mixture.h"

#include <algorithm>
#include <cmath>

namespace filament_core::reference {

namespace lib = shader::lib64;

Coupling::Coupling(SurfaceSample const& surface, BsdfModel const& model, double3 view, double2 alpha)
        : mF0(surface.f0), mF90(surface.f90), mRoughness(surface.perceptualRoughness), mAnisotropy(surface.anisotropy),
          mAlpha(alpha), mTerm(model.coupling),
          mIsCompensated(model.energy == EnergyTerm::Compensated && !surface.transmission.isFromInside),
          mTowardsView(1.0), mExit(1.0) {
    if (mTerm == CouplingTerm::Never) return;
    if (isSum(surface)) { // what is below lies under the dielectric alone
        mF0 = surface.mixture->dielectricF0;
        mF90 = surface.mixture->dielectricF90;
    }
    TransmissionSample const& below = surface.transmission;
    if (below.isThin && below.color != double3(0.0)) {
        const double path = lib::thinPathLength(view.z, below.ior, below.thickness);
        mFar = below.color * lib::transmittance(below.absorption, path);
    }
    const double3 round = reflected(directionalAlbedo(view.z, mRoughness));
    mTowardsView = lib::diffuseEntry(round);
    if (mTerm == CouplingTerm::AmbientOnly) return;
    const double widest = std::min(std::sqrt(std::max(alpha.x, alpha.y)), 1.0);
    mExit = lib::diffuseExit(mAnisotropy != 0 ? reflectedTowards(view) : round,
                             reflected(averageDirectionalAlbedo(widest)));
}

double3 Coupling::of(double3 light, LightSource source) const {
    const bool isAmbient = source == LightSource::Ambient;
    if (isAmbient && mTerm != CouplingTerm::Always) return mTowardsView;
    if (mTerm == CouplingTerm::Never || mTerm == CouplingTerm::AmbientOnly) return double3(1.0);
    return mExit * lib::diffuseEntry(reflectedTowards(light));
}

double3 Coupling::reflected(double2 dfg) const {
    const double3 once = lib::specularDfg(mF0, mF90, dfg);
    const double3 near = mIsCompensated ? once * lib::energyCompensation(mF0, dfg) : once;
    return near + lib::thinFarReflectance(near, mFar);
}

double3 Coupling::reflectedTowards(double3 direction) const {
    const double cosine = std::max(direction.z, kMinNov);
    if (mAnisotropy == 0) return reflected(directionalAlbedo(cosine, mRoughness));
    constexpr double kGrooveSmooth = 0.5, kGrooveAcross = 0.03;
    const double amount = std::abs(mAnisotropy), along = 1 - kGrooveSmooth * amount, across = kGrooveAcross * amount;
    double2 part(direction.x * direction.x, direction.y * direction.y);
    part /= std::max(part.x + part.y, 0x1p-10);
    const double2 squared = mAlpha * mAlpha;
    const double alphaSquared =
            along * along * glm::dot(part, squared) + across * across * glm::dot(double2(part.y, part.x), squared);
    const double roughness = std::sqrt(std::sqrt(alphaSquared));
    return reflected(directionalAlbedo(cosine, std::clamp(roughness, 0.045, 1.0)));
}

} // namespace filament_core::reference
