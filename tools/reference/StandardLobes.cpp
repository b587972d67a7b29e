// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/StandardLobes.h"

#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/DirectionalAlbedo.h"
#include "tools/reference/Mixture.h"

#include <algorithm>
#include <cmath>

namespace filament_core::reference {

namespace lib = shader::lib64;

namespace {

bool isStretched(SurfaceSample const& surface) { return surface.stretchedAlpha != double2(0.0); }

Frame frameOf(SurfaceSample const& surface) {
    return isStretched(surface) ? Frame(surface.normal, surface.tangent) : Frame(surface.normal);
}

// The loss of a stretched lobe: shaders/material/surface/anisotropy.glsl, groovesCompensation().
double3 compensationOfGrooves(double3 compensation, double anisotropy) {
    const double amount = std::abs(anisotropy);
    return 1.0 + (compensation - 1.0) * (1 - amount * (0.85 - 0.25 * amount));
}

// What the far side of a sheet adds to the albedo of the near side: surface/refraction.glsl, farReflectedShare().
double3 farReflectedShare(SurfaceSample const& surface, double nov, double3 f) {
    TransmissionSample const& below = surface.transmission;
    if (!below.isThin || below.color == double3(0.0)) return double3(0.0);
    const double path = lib::thinPathLength(nov, below.ior, below.thickness);
    return lib::thinFarReflectance(f, below.color * lib::transmittance(below.absorption, path));
}

} // namespace

double3 StandardLobes::mirroredView(SurfaceSample const& surface) const {
    const double3 bent =
            lib::anisotropicNormal({ 0, 0, 1 }, { 1, 0, 0 }, { 0, 1, 0 }, mView, surface.anisotropy, mRoughness);
    return 2 * glm::dot(bent, mView) * bent - mView;
}

// Like shaders/material/surface/occlusion.glsl, without bounces between occluders.
double StandardLobes::specularOcclusionOf(SurfaceSample const& surface) const {
    if (surface.bentNormal && surface.bendsReflections) {
        const double3 mirrored(-mView.x, -mView.y, mView.z);
        const double cosine = glm::dot(mFrame.toLocal(*surface.bentNormal), mirrored);
        return lib::specularOcclusionCones(surface.occlusion, cosine, mRoughness);
    }
    return lib::specularOcclusion(mView.z, surface.occlusion, lib::alphaFromPerceptual(mRoughness));
}

// The albedo of a sum of lobes is the sum of theirs, and the light that bounces between facets that of each.
void StandardLobes::sumParts(SurfaceSample const& surface, double2 dfg, double3& albedo) {
    const double3 metalF0 = surface.mixture->color, f0 = surface.mixture->dielectricF0;
    const double3 metal = lib::specularDfg(metalF0, f90Of(metalF0), dfg);
    const double3 dielectric = lib::specularDfg(f0, surface.mixture->dielectricF90, dfg);
    const bool isCompensated = mModel.energy == EnergyTerm::Compensated;
    const auto factor = [&](double3 of) { return isCompensated ? lib::energyCompensation(of, dfg) : double3(1.0); };
    albedo = glm::mix(dielectric * factor(f0), metal * factor(metalF0), surface.metallic);
    mCompensation = albedo / glm::max(glm::mix(dielectric, metal, surface.metallic), double3(1e-4));
}

StandardLobes::StandardLobes(SurfaceSample const& surface, BsdfModel const& model, bool useOcclusion)
        : mModel(model), mInterface(surface, model.fresnel), mFrame(frameOf(surface)),
          mView(liftedAboveHorizon(mFrame.toLocal(surface.view))), mRoughness(surface.perceptualRoughness),
          mAlpha(isStretched(surface) ? surface.stretchedAlpha : double2(lib::alphaFromPerceptual(mRoughness))),
          mDiffuse(surface.diffuse), mCoupling(surface, model, mView, mAlpha) {
    const double2 dfg = directionalAlbedo(mView.z, mRoughness);
    const bool isCompensated = model.energy == EnergyTerm::Compensated && !surface.transmission.isFromInside;
    mCompensation = isCompensated ? lib::energyCompensation(surface.f0, dfg) : double3(1.0);
    double3 specularAlbedo = lib::specularDfg(surface.f0, surface.f90, dfg) * mCompensation;
    if (isSum(surface)) sumParts(surface, dfg, specularAlbedo);
    if (surface.transmission.isFromInside) specularAlbedo = mInterface.reflectance(mView.z);
    if (useOcclusion) {
        mAmbientDiffuse = double3(surface.occlusion);
        if (surface.bentNormal) mOpen = Frame(mFrame.toLocal(*surface.bentNormal));
        mAmbientSpecular = specularOcclusionOf(surface);
        mUnmappedNormal = surface.unmappedNormal;
        if (surface.unmappedNormal) {
            const double3 mirrored = mFrame.toWorld(mirroredView(surface));
            mAmbientSpecular *= lib::horizonOcclusion(mirrored, *surface.unmappedNormal);
        }
    }
    if (model.lobes == LobeChoice::Specular) mDiffuse = double3(0.0);
    if (model.lobes == LobeChoice::Diffuse) mCompensation = double3(0.0);
    if (model.lobes != LobeChoice::Diffuse) mSpecularAlbedo = specularAlbedo;
    mAlbedo = mDiffuse * mCoupling.towardsView() + mSpecularAlbedo;
    const double specular = lib::luminance(mSpecularAlbedo);
    const double diffuse = lib::luminance(mDiffuse * mCoupling.towardsView());
    // At least a tenth for each lobe that exists.
    const bool samplesDiffuse = diffuse > 0 && model.diffuseLight == DiffuseLight::Integral;
    mSpecularChance = samplesDiffuse ? std::clamp(specular / (specular + diffuse), 0.1, 0.9) : 1;
    if (model.lobes == LobeChoice::Diffuse) mSpecularChance = 0;
    if (model.specularLight == SpecularLight::SplitSum && model.lobes != LobeChoice::Diffuse)
        usePrefiltered(surface, dfg);
    if (model.lobes != LobeChoice::Diffuse) mCompensation = compensationOfGrooves(mCompensation, surface.anisotropy);
}

constexpr int kGrainLookUps[] = { 5, 1, 3, 9 }; // by AnisotropicLookUps

// Like shaders/material/surface/look_ups.glsl, radianceAlongGrain().
void StandardLobes::lookUpAlongGrain() {
    const bool isAlong = mAlpha.x >= mAlpha.y;
    const double2 alpha = isAlong ? mAlpha : double2(mAlpha.y, mAlpha.x);
    const double3 view = isAlong ? mView : double3(mView.y, -mView.x, mView.z);
    const int count = kGrainLookUps[static_cast<size_t>(mModel.grainLookUps)];
    double sum = 0;
    for (int i = 0; i < count; ++i) {
        const double4 halfVector = lib::grainHalfVector(view, alpha, (i + 0.5) / count);
        const double4 light = lib::grainLookUp(view, alpha, halfVector);
        if (light.w <= 0) continue;
        const double3 local = isAlong ? double3(light) : double3(-light.y, light.x, light.z);
        const double roughness =
                std::max(lib::grainLookUpRoughness(view, alpha, halfVector, count), lib::kMinPerceptualRoughness);
        mLookUps.push_back({ SplitSumLobe(roughness, mModel.splitSumLevels), Frame(glm::normalize(local)), light.w });
        sum += light.w;
    }
    for (LookUp& lookUp : mLookUps) lookUp.share /= sum;
}

// One look-up, of a stretched lobe along a bent normal, or several along the grain.
void StandardLobes::usePrefiltered(SurfaceSample const& surface, double2 dfg) {
    mLobeAlbedo = lib::specularDfg(surface.f0, surface.f90, dfg) * mCompensation; // of a sum, too: linear in f0
    mLobeAlbedo = (mLobeAlbedo + farReflectedShare(surface, mView.z, mLobeAlbedo)) * mAmbientSpecular;
    if (surface.anisotropy != 0 && mModel.grainLookUps != AnisotropicLookUps::One) lookUpAlongGrain();
    if (!mLookUps.empty()) return;
    const double alpha = lib::alphaFromPerceptual(mRoughness);
    const double3 direction = lib::dominantSpecularDirection({ 0, 0, 1 }, mirroredView(surface), alpha);
    mLookUps.push_back({ SplitSumLobe(mRoughness, mModel.splitSumLevels), Frame(glm::normalize(direction)), 1 });
}

double3 StandardLobes::harmonicAlbedo() const {
    if (mModel.diffuseLight != DiffuseLight::Harmonics) return double3(0.0);
    return mDiffuse * mCoupling.towardsView() * mAmbientDiffuse;
}

double3 StandardLobes::diffuseShare(double3 light, LightSource source) const {
    const double3 local = mFrame.toLocal(light);
    return mCoupling.of({ local.x, local.y, std::min(std::abs(local.z), 1.0) }, source);
}

double StandardLobes::visibility(double3 light) const {
    if (mAlpha.x != mAlpha.y) return lib::visibilitySmithGgxAnisotropic(mView, light, mAlpha);
    switch (mModel.visibility) {
    case SpecularVisibility::Fast:
        return lib::visibilitySmithGgxCorrelatedFast(mView.z, light.z, mAlpha.x);
    case SpecularVisibility::Uncorrelated:
        return lib::visibilitySmithGgxUncorrelated(mView.z, light.z, mAlpha.x);
    case SpecularVisibility::Correlated:
        break;
    }
    return lib::visibilitySmithGgxCorrelated(mView.z, light.z, mAlpha.x);
}

double StandardLobes::diffuseTerm(double nol, double voh) const {
    return mModel.diffuse == DiffuseTerm::Lambert ? lib::diffuseLambert()
                                                  : lib::diffuseDisney(mView.z, nol, voh, mRoughness);
}

LobeValues StandardLobes::evaluate(double3 light, LightSource source) const {
    double3 local = mFrame.toLocal(light);
    local.z = std::min(local.z, 1.0);
    LobeValues values = lobesAt(local, source);
    if (source != LightSource::Ambient) return values;
    for (LookUp const& lookUp : mLookUps)
        values.specular +=
                mLobeAlbedo * (lookUp.share * lookUp.lobe.value(lookUp.frame.toLocal(mFrame.toLocal(light))));
    return values;
}

// Ambient light arrives about the bent normal, as in shaders/material/surface/incoming.glsl.
double StandardLobes::diffuseCosine(double3 local, LightSource source) const {
    return mOpen && source == LightSource::Ambient ? mOpen->toLocal(local).z : local.z;
}

// Excludes pre-filtered parts.
LobeValues StandardLobes::lobesAt(double3 local, LightSource source) const {
    const double3 sum = mView + local;
    const double length = glm::length(sum), cosine = diffuseCosine(local, source);
    LobeValues values;
    if (length < 1e-12 || std::max(local.z, cosine) <= 0) return values;
    const double3 halfway = sum / length;
    const double voh = lib::saturate(glm::dot(mView, halfway));
    const bool isAmbient = source == LightSource::Ambient;
    if (local.z > 0 && (mLookUps.empty() || !isAmbient)) {
        values.specular =
                (ggx(halfway, mAlpha) * visibility(local) * local.z) * mInterface.reflectance(voh) * mCompensation;
    }
    if (cosine > 0 && (mModel.diffuseLight == DiffuseLight::Integral || !isAmbient)) {
        const double3 share = mCoupling.of({ local.x, local.y, std::abs(local.z) }, source);
        values.diffuse = mDiffuse * share * (diffuseTerm(cosine, voh) * cosine);
    }
    if (!isAmbient && mUnmappedNormal)
        values.specular *= lib::horizonOcclusion(mFrame.toWorld(local), *mUnmappedNormal);
    if (isAmbient) {
        values.diffuse *= mAmbientDiffuse;
        values.specular *= mAmbientSpecular;
    }
    return values;
}

std::optional<double3> StandardLobes::sample(double2 u, double choice) const {
    if (mModel.diffuseLight == DiffuseLight::Harmonics && mModel.lobes == LobeChoice::Diffuse) return {};
    const bool isSpecular = choice < mSpecularChance;
    double3 local = isSpecular ? sampleSpecular(u) : lib::hemisphereCosineSample(u);
    if (!isSpecular && mOpen) local = mOpen->toWorld(local);
    if (local.z <= 0 && mLookUps.empty() && !mOpen) return {};
    return glm::normalize(mFrame.toWorld(local));
}

double3 StandardLobes::sampleLookUps(double2 u) const {
    size_t chosen = 0;
    while (chosen + 1 < mLookUps.size() && u.x >= mLookUps[chosen].share) u.x -= mLookUps[chosen++].share;
    LookUp const& lookUp = mLookUps[chosen];
    return lookUp.frame.toWorld(lookUp.lobe.sample({ std::clamp(u.x / lookUp.share, 1e-12, 1 - 1e-12), u.y }));
}

double3 StandardLobes::sampleSpecular(double2 u) const {
    if (!mLookUps.empty()) return sampleLookUps(u);
    const double3 halfway = sampleVisibleNormal(mView, mAlpha, u);
    return 2 * glm::dot(mView, halfway) * halfway - mView;
}

double StandardLobes::pdf(double3 light) const {
    const double3 local = mFrame.toLocal(light);
    if (local.z <= 0 && mLookUps.empty() && !mOpen) return 0;
    const double cosine = diffuseCosine(local, LightSource::Ambient);
    double density = (1 - mSpecularChance) * std::max(cosine, 0.0) * lib::kInversePi;
    if (mSpecularChance > 0 && (local.z > 0 || !mLookUps.empty())) density += mSpecularChance * specularPdf(local);
    return density;
}

double StandardLobes::specularPdf(double3 light) const {
    if (mLookUps.empty()) return visibleReflectionPdf(mView, light, mAlpha);
    double density = 0;
    for (LookUp const& lookUp : mLookUps) density += lookUp.share * lookUp.lobe.pdf(lookUp.frame.toLocal(light));
    return density;
}

} // namespace filament_core::reference
