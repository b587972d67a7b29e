// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/Bsdf.h"

#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/DirectionalAlbedo.h"

#include <algorithm>
#include <cmath>

namespace filament::reference {
namespace {

namespace lib = shader::lib64;

// Duff et al. 2017, "Building an Orthonormal Basis, Revisited".
void basisAround(double3 n, double3& tangent, double3& bitangent) {
    const double sign = std::copysign(1.0, n.z), a = -1 / (sign + n.z), b = n.x * n.y * a;
    tangent = { 1 + sign * n.x * n.x * a, sign * b, -sign * n.x };
    bitangent = { b, sign + n.y * n.y * a, -n.y };
}

// Heitz 2018, "Sampling the GGX Distribution of Visible Normals", listing 1: the hemisphere is squeezed until the lobe
// is a disc seen from the side.
double3 sampleVisibleNormal(double3 view, double alpha, double2 u) {
    const double3 stretched = glm::normalize(double3(alpha * view.x, alpha * view.y, view.z));
    double3 across, forward;
    basisAround(stretched, across, forward);
    // The disc's second axis lies in the plane of the normal: there the horizon cuts it.
    const double size = std::hypot(stretched.x, stretched.y);
    if (size > 0) {
        across = double3(-stretched.y, stretched.x, 0) / size;
        forward = glm::cross(stretched, across);
    }
    const double radius = std::sqrt(u.x), azimuth = lib::kTwoPi * u.y;
    const double x = radius * std::cos(azimuth), s = 0.5 * (1 + stretched.z);
    const double y = (1 - s) * std::sqrt(1 - x * x) + s * radius * std::sin(azimuth);
    const double3 visible = x * across + y * forward + std::sqrt(std::max(0.0, 1 - x * x - y * y)) * stretched;
    return glm::normalize(double3(alpha * visible.x, alpha * visible.y, std::max(visible.z, 1e-12)));
}

double3 liftedAboveHorizon(double3 view) {
    if (view.z >= kMinNov) return view;
    const double size = std::hypot(view.x, view.y), radius = std::sqrt(1 - kMinNov * kMinNov);
    return size > 0 ? double3(view.x / size * radius, view.y / size * radius, kMinNov) : double3(radius, 0, kMinNov);
}

double smithMasking(double cosine, double alpha) {
    const double a2 = alpha * alpha;
    return 2 * cosine / (cosine + std::sqrt(a2 + (1 - a2) * cosine * cosine));
}

} // namespace

Bsdf::Bsdf(SurfaceSample const& surface, BsdfModel const& model, bool useOcclusion)
        : mModel(model), mNormal(surface.normal), mRoughness(surface.perceptualRoughness),
          mAlpha(lib::alphaFromPerceptual(mRoughness)), mF0(surface.f0), mF90(surface.f90), mMetallic(surface.metallic),
          mDiffuse(surface.diffuse) {
    basisAround(mNormal, mTangent, mBitangent);
    mView = liftedAboveHorizon(toLocal(surface.view));
    mNov = mView.z;

    const double2 dfg = directionalAlbedo(mNov, mRoughness);
    mCompensation = model.energy == EnergyTerm::Compensated ? lib::energyCompensation(mF0, dfg) : double3(1.0);
    // specularDfg() for any f90; the split sum takes it for 1.
    const double3 specularAlbedo = (mF0 * (dfg.y - dfg.x) + mF90 * dfg.x) * mCompensation;
    mCoupling = model.coupling == CouplingTerm::Never ? double3(1.0) : glm::max(1.0 - specularAlbedo, 0.0);
    if (useOcclusion) {
        mAmbientDiffuse = double3(surface.occlusion);
        mAmbientSpecular = lib::specularOcclusion(mNov, surface.occlusion, mAlpha);
    }
    if (model.lobes == LobeChoice::Specular) mDiffuse = double3(0.0);
    if (model.lobes == LobeChoice::Diffuse) mCompensation = double3(0.0);
    const double specular = model.lobes == LobeChoice::Diffuse ? 0 : lib::luminance(specularAlbedo);
    const double diffuse = lib::luminance(mDiffuse * mCoupling);
    // A tenth at least for each lobe that is there.
    const bool samplesDiffuse = diffuse > 0 && model.diffuseLight == DiffuseLight::Integral;
    mSpecularChance = samplesDiffuse ? std::clamp(specular / (specular + diffuse), 0.1, 0.9) : 1;
    if (model.lobes == LobeChoice::Diffuse) mSpecularChance = 0;
    if (model.specularLight == SpecularLight::SplitSum && model.lobes != LobeChoice::Diffuse) {
        mLobe.emplace(mRoughness, model.splitSumLevels);
        mLobeAlbedo = lib::specularDfg(mF0, dfg) * mCompensation * mAmbientSpecular;
        const double3 mirrored(-mView.x, -mView.y, mView.z);
        mLobeAxis = glm::normalize(lib::dominantSpecularDirection({ 0, 0, 1 }, mirrored, mAlpha));
        basisAround(mLobeAxis, mLobeTangent, mLobeBitangent);
    }
}

double3 Bsdf::harmonicAlbedo() const {
    return mModel.diffuseLight == DiffuseLight::Harmonics ? mDiffuse * mCoupling * mAmbientDiffuse : double3(0.0);
}

double Bsdf::visibility(double nol) const {
    switch (mModel.visibility) {
    case SpecularVisibility::Fast:
        return lib::visibilitySmithGgxCorrelatedFast(mNov, nol, mAlpha);
    case SpecularVisibility::Uncorrelated:
        return lib::visibilitySmithGgxUncorrelated(mNov, nol, mAlpha);
    case SpecularVisibility::Correlated:
        break;
    }
    return lib::visibilitySmithGgxCorrelated(mNov, nol, mAlpha);
}

double3 Bsdf::fresnel(double voh) const {
    if (mModel.fresnel == FresnelTerm::Schlick) return lib::fresnelSchlick(mF0, mF90, voh);
    return lib::fresnelExact(mF0, mMetallic, voh) * mF90; // as shaders/material/surface_quality.glsl
}

double Bsdf::diffuseTerm(double nol, double voh) const {
    return mModel.diffuse == DiffuseTerm::Lambert ? lib::diffuseLambert()
                                                  : lib::diffuseDisney(mNov, nol, voh, mRoughness);
}

double3 Bsdf::evaluate(double3 light, LightSource source) const {
    const double nol = std::min(glm::dot(mNormal, light), 1.0);
    const double3 local = toLocal(light);
    double3 sum = nol > 0 ? lobesAt(local, nol, source) * nol : double3(0.0);
    if (mLobe && source == LightSource::Ambient) sum += mLobeAlbedo * mLobe->value(toLobe(local));
    return sum;
}

// Without what is pre-filtered.
double3 Bsdf::lobesAt(double3 local, double nol, LightSource source) const {
    const double3 sum = mView + local;
    const double length = glm::length(sum);
    if (length < 1e-12) return double3(0.0);
    const double3 halfway = sum / length;
    const double voh = lib::saturate(glm::dot(mView, halfway));
    const bool isAmbient = source == LightSource::Ambient;
    double3 specular(0.0), diffuse(0.0);
    if (!mLobe || !isAmbient) {
        const double d = lib::ndfGgxFromVectors({ 0, 0, 1 }, halfway, mAlpha);
        specular = (d * visibility(nol)) * fresnel(voh) * mCompensation;
    }
    if (mModel.diffuseLight == DiffuseLight::Integral || !isAmbient) {
        diffuse = mDiffuse * diffuseTerm(nol, voh);
        if (mModel.coupling != CouplingTerm::Engine || isAmbient) diffuse *= mCoupling;
    }
    return isAmbient ? diffuse * mAmbientDiffuse + specular * mAmbientSpecular : diffuse + specular;
}

BsdfSample Bsdf::sample(double2 u, double choice) const {
    if (mModel.diffuseLight == DiffuseLight::Harmonics && mModel.lobes == LobeChoice::Diffuse) return {};
    const double3 local = choice < mSpecularChance ? sampleSpecular(u) : lib::hemisphereCosineSample(u);
    if (local.z <= 0 && !mLobe) return {};
    const double3 direction = glm::normalize(toWorld(local));
    return { direction, pdf(direction) };
}

double3 Bsdf::sampleSpecular(double2 u) const {
    if (mLobe) {
        const double3 lobe = mLobe->sample(u);
        return mLobeTangent * lobe.x + mLobeBitangent * lobe.y + mLobeAxis * lobe.z;
    }
    const double3 halfway = sampleVisibleNormal(mView, mAlpha, u);
    return 2 * glm::dot(mView, halfway) * halfway - mView;
}

double Bsdf::pdf(double3 light) const {
    const double3 local = toLocal(light);
    if (local.z <= 0 && !mLobe) return 0;
    double density = (1 - mSpecularChance) * std::max(local.z, 0.0) * lib::kInversePi;
    if (mSpecularChance > 0) density += mSpecularChance * specularPdf(local);
    return density;
}

double Bsdf::specularPdf(double3 light) const {
    if (mLobe) return mLobe->pdf(toLobe(light));
    const double3 sum = mView + light;
    const double length = glm::length(sum);
    if (length < 1e-12) return 0;
    const double3 halfway = sum / length;
    // Visible half vectors: G1 D (v.h) / n.v; light directions are 4 v.h times sparser.
    return smithMasking(mNov, mAlpha) * lib::ndfGgxFromVectors({ 0, 0, 1 }, halfway, mAlpha) / (4 * mNov);
}

} // namespace filament::reference
