// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/SheenLayer.h"

#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/SheenAlbedo.h"

#include <algorithm>

namespace filament_core::reference {

namespace lib = shader::lib64;

SheenLayer::SheenLayer(SurfaceSample const& surface, BsdfModel const& model)
        : mTerm(model.sheen), mColor(surface.sheen.color), mLargest(std::max({ mColor.x, mColor.y, mColor.z })),
          mRoughness(surface.sheen.perceptualRoughness), mAlpha(lib::alphaFromPerceptual(mRoughness)),
          mFrame(surface.normal), mView(liftedAboveHorizon(mFrame.toLocal(surface.view))),
          mViewAlbedo(mTerm == SheenTerm::Exact ? limitedSheenAlbedo(mView.z, mRoughness)
                                                : sheenAlbedo(mView.z, mRoughness)) {
    if (mTerm == SheenTerm::Exact) mMean = averageLimitedSheenAlbedo(mRoughness);
    if (model.specularLight != SpecularLight::SplitSum) return;
    const double2 mean = lib::sheenMeanDirection(mView.z, mRoughness);
    mLobe.emplace(std::max(lib::sheenLookUpRoughness(mean, mView.z), lib::kMinPerceptualRoughness),
                  model.splitSumLevels);
    mLobeFrame = Frame(glm::normalize(double3(mView.x * mean.x, mView.y * mean.x, mean.y)));
}

double3 SheenLayer::albedo() const { return mColor * std::min(mViewAlbedo, 1.0); }

double3 SheenLayer::evaluate(double3 light, LightSource source) const {
    const double3 local = mFrame.toLocal(light);
    if (mLobe && source == LightSource::Ambient) return albedo() * mLobe->value(mLobeFrame.toLocal(local));
    const double3 sum = mView + local;
    const double length = glm::length(sum);
    if (local.z <= 0 || length < 1e-12) return double3(0.0);
    const double nol = std::min(local.z, 1.0);
    double limit = lib::sheenLimit(sheenAlbedo(mView.z, mRoughness));
    const bool isReciprocal = mTerm == SheenTerm::Exact || source == LightSource::Direct;
    if (isReciprocal) limit = std::min(limit, lib::sheenLimit(sheenAlbedo(nol, mRoughness)));
    const double noh = std::min(sum.z / length, 1.0);
    return mColor * (lib::ndfCharlie(noh, mAlpha) * lib::visibilityNeubelt(mView.z, nol) * nol * limit);
}

// The lobe is wide, so all directions above the surface are equally likely.
std::optional<double3> SheenLayer::sample(double2 u) const {
    const double3 local = mLobe ? mLobeFrame.toWorld(mLobe->sample(u)) : lib::hemisphereUniformSample(u);
    if (local.z <= 0 && !mLobe) return {};
    return glm::normalize(mFrame.toWorld(local));
}

double SheenLayer::pdf(double3 light) const {
    const double3 local = mFrame.toLocal(light);
    if (mLobe) return mLobe->pdf(mLobeFrame.toLocal(local));
    return local.z > 0 ? 0.5 * lib::kInversePi : 0;
}

double SheenLayer::scaling(double3 light, LightSource source) const {
    const double nol = std::clamp(mFrame.toLocal(light).z, 0.0, 1.0);
    if (mTerm == SheenTerm::Exact) {
        return scalingOfView() * (1 - mLargest * limitedSheenAlbedo(nol, mRoughness)) / (1 - mLargest * mMean);
    }
    if (source == LightSource::Ambient) return scalingOfView();
    return std::min(scalingOfView(), lib::sheenAlbedoScaling(mColor, sheenAlbedo(nol, mRoughness)));
}

} // namespace filament_core::reference
