// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/CoatLayer.h"

#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/DirectionalAlbedo.h"

#include <algorithm>
#include <cmath>

namespace filament_core::reference {

namespace lib = shader::lib64;

CoatLayer::CoatLayer(SurfaceSample const& surface, BsdfModel const& model)
        : mTerm(model.coat), mFresnel(isExact() ? FresnelTerm::Exact : model.fresnel), mStrength(surface.coat.strength),
          mRoughness(surface.coat.perceptualRoughness), mAlpha(lib::alphaFromPerceptual(mRoughness)),
          mFrame(surface.coat.normal), mView(liftedAboveHorizon(mFrame.toLocal(surface.view))) {
    mViewTransmission = transmission(mView.z);
    if (isExact()) mMeanTransmission = 1 - averageCoatAlbedo(mRoughness);
    mAlbedo = mStrength * (1 - mViewTransmission);
    if (model.specularLight != SpecularLight::SplitSum || model.lobes == LobeChoice::Diffuse) return;
    mLobe.emplace(mRoughness, model.splitSumLevels);
    mLobeAlbedo = mStrength * (1 - mViewTransmission);
    const double3 mirrored(-mView.x, -mView.y, mView.z);
    mLobeFrame = Frame(glm::normalize(lib::dominantSpecularDirection({ 0, 0, 1 }, mirrored, mAlpha)));
}

double CoatLayer::transmission(double cosine) const {
    if (isExact()) return 1 - coatAlbedo(cosine, mRoughness);
    return lib::coatTransmissionFromDfg(directionalAlbedo(cosine, mRoughness), 1.0);
}

double CoatLayer::evaluate(double3 light, LightSource source) const {
    const double3 local = mFrame.toLocal(light);
    if (mLobe && source == LightSource::Ambient) return mLobeAlbedo * mLobe->value(mLobeFrame.toLocal(local));
    const double3 sum = mView + local;
    const double length = glm::length(sum);
    if (local.z <= 0 || length < 1e-12) return 0;
    const double3 halfway = sum / length;
    const double voh = lib::saturate(glm::dot(mView, halfway));
    const double visibility = isExact() ? lib::visibilitySmithGgxCorrelated(mView.z, local.z, mAlpha)
                                        : lib::visibilityCoat(mView.z, std::min(local.z, 1.0), voh, mAlpha);
    const double fresnel = mFresnel == FresnelTerm::Schlick ? lib::coatFresnel(voh, 1.0)
                                                            : lib::fresnelComplex(voh, lib::kCoatIor, 0.0);
    return ggx(halfway, double2(mAlpha)) * visibility * fresnel * local.z * mStrength;
}

std::optional<double3> CoatLayer::sample(double2 u) const {
    double3 local;
    if (mLobe) {
        local = mLobeFrame.toWorld(mLobe->sample(u));
    } else {
        const double3 halfway = sampleVisibleNormal(mView, double2(mAlpha), u);
        local = 2 * glm::dot(mView, halfway) * halfway - mView;
    }
    if (local.z <= 0 && !mLobe) return {};
    return glm::normalize(mFrame.toWorld(local));
}

double CoatLayer::pdf(double3 light) const {
    const double3 local = mFrame.toLocal(light);
    if (mLobe) return mLobe->pdf(mLobeFrame.toLocal(local));
    return local.z > 0 ? visibleReflectionPdf(mView, local, double2(mAlpha)) : 0;
}

double CoatLayer::attenuation(double3 light, LightSource source) const {
    if (source == LightSource::Ambient) return attenuationOfView();
    const double cosine = std::min(std::abs(mFrame.toLocal(light).z), 1.0);
    return std::min(attenuationOfView(), 1 - mStrength * (1 - transmission(cosine)));
}

double3 CoatLayer::viewInside() const {
    const double3 local = mView / lib::kCoatIor;
    return mFrame.toWorld({ local.x, local.y, lib::refractedCosine(mView.z, lib::kCoatIor) });
}

std::optional<double3> CoatLayer::inside(double3 light) const {
    const double3 local = mFrame.toLocal(light);
    if (local.z <= 0) return {};
    return mFrame.toWorld({ local.x / lib::kCoatIor, local.y / lib::kCoatIor,
                            lib::refractedCosine(std::min(local.z, 1.0), lib::kCoatIor) });
}

std::optional<double3> CoatLayer::outside(double3 lightInside) const {
    const double3 local = mFrame.toLocal(lightInside) * lib::kCoatIor;
    const double cos2 = 1 - local.x * local.x - local.y * local.y;
    if (local.z <= 0 || cos2 <= 0) return {};
    return mFrame.toWorld({ local.x, local.y, std::sqrt(cos2) });
}

double CoatLayer::spread(double3 light) const {
    const double nol = std::clamp(mFrame.toLocal(light).z, 0.0, 1.0);
    return nol / (lib::kCoatIor * lib::kCoatIor * lib::refractedCosine(nol, lib::kCoatIor));
}

double3 CoatLayer::combined(LobeValues const& below, double3 specularAlbedo, double3 light) const {
    const double nol = std::clamp(mFrame.toLocal(light).z, 0.0, 1.0);
    const double through = transmission(nol) * mViewTransmission;
    const double back = std::sqrt((1 - transmission(nol)) * (1 - mViewTransmission));
    const double3 specular = below.specular * spread(light) / (1.0 - back * specularAlbedo);
    const double3 diffuse = below.diffuse * (spread(light) * lib::kCoatIor * lib::kCoatIor / mMeanTransmission);
    return (specular + diffuse) * through;
}

} // namespace filament_core::reference
