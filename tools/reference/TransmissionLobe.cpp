// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/TransmissionLobe.h"

#include "shaders/lib/LibCppDouble.h"

#include <algorithm>

namespace filament_core::reference {

namespace lib = shader::lib64;

namespace {

constexpr double kLeastIndexStep = 1e-6; // for smaller steps light goes straight

double alphaOfTransmission(SurfaceSample const& surface) {
    const double roughness = surface.perceptualRoughness, ior = surface.transmission.ior;
    return lib::alphaFromPerceptual(lib::clampPerceptualRoughness(lib::refractionPerceptualRoughness(roughness, ior)));
}

} // namespace

TransmissionLobe::TransmissionLobe(SurfaceSample const& surface, BsdfModel const& model, bool isBall,
                                   double3 specularAlbedo)
        : mKind(surface.transmission.isThin ? Kind::Thin : Kind::Solid), mInterface(surface, model.fresnel),
          mFrame(surface.normal), mView(liftedAboveHorizon(mFrame.toLocal(surface.view))),
          mAlpha(lib::alphaFromPerceptual(surface.perceptualRoughness)), mIsThin(surface.transmission.isThin) {
    TransmissionSample const& below = surface.transmission;
    mAlbedo = mInterface.transmittance(mView.z);
    mEta = below.isFromInside ? 1 / below.ior : below.ior;
    if (mIsThin) mAlpha = double2(alphaOfTransmission(surface));
    if (mIsThin ? model.specularLight == SpecularLight::SplitSum : isBall) {
        lookUp(surface, specularAlbedo);
    } else if (!mIsThin && std::abs(below.ior - 1) < kLeastIndexStep) {
        mKind = Kind::Straight;
    }
}

// Like shaders/material/surface/refraction.glsl.
void TransmissionLobe::lookUp(SurfaceSample const& surface, double3 f) {
    TransmissionSample const& below = surface.transmission;
    mKind = Kind::LookUp;
    mLookUpLobe.emplace(alphaOfTransmission(surface));
    if (mIsThin) {
        const double path = lib::thinPathLength(mView.z, below.ior, below.thickness);
        mAlbedo = lib::thinTransmittance(f, below.color * lib::transmittance(below.absorption, path));
        mLookUpFrames.fill(Frame(-mView));
        return;
    }
    const double path = lib::solidPathLength(mView.z, below.ior, below.thickness);
    mAlbedo = glm::max(1.0 - f, 0.0) * below.color * lib::transmittance(below.absorption, path);
    const double3 iors = lib::dispersedIor(below.ior, below.dispersion);
    for (int i = 0; i < 3; ++i) {
        mLookUpFrames[static_cast<size_t>(i)] = Frame(glm::normalize(lib::refractedSolid({ 0, 0, 1 }, mView, iors[i])));
    }
}

double3 TransmissionLobe::throughSheet(double3 local) const {
    const double3 above = mirrored(local), h = glm::normalize(mView + above);
    const double visibility = lib::visibilitySmithGgxCorrelated(mView.z, std::min(above.z, 1.0), mAlpha.x);
    const double voh = lib::saturate(glm::dot(mView, h));
    return mInterface.transmittance(voh) * (ggx(h, mAlpha) * visibility * above.z);
}

// Ibid., eq. 16, towards the side of the view.
double3 TransmissionLobe::halfway(double3 local) const {
    const double3 sum = mView + mEta * local;
    const double length = glm::length(sum);
    if (length < 1e-12) return double3(0.0);
    return sum.z < 0 ? -sum / length : sum / length;
}

double3 TransmissionLobe::evaluate(double3 light, LightSource source) const {
    const double3 local = mFrame.toLocal(light);
    if (mKind == Kind::Straight) return double3(0.0);
    if (mKind == Kind::LookUp && source == LightSource::Ambient) {
        double3 value;
        for (int i = 0; i < 3; ++i) value[i] = mLookUpLobe->value(mLookUpFrames[static_cast<size_t>(i)].toLocal(local));
        return mAlbedo * value;
    }
    if (local.z >= 0 || (mKind == Kind::LookUp && !mIsThin)) return double3(0.0);
    if (mIsThin) return throughSheet(local);
    const double3 h = halfway(local);
    const double voh = glm::dot(mView, h), loh = glm::dot(local, h);
    if (voh <= 0 || loh >= 0) return double3(0.0);
    // f cos = T G D |v.h| |l.h| / (|n.v| (v.h + eta l.h)^2), in units of the view's index.
    const double root = voh + mEta * loh;
    const double masked = smithMasking(mView, mAlpha) * smithMasking(local, mAlpha);
    return mInterface.transmittance(std::min(voh, 1.0)) *
           (masked * ggx(h, mAlpha) * voh * -loh / (mView.z * root * root));
}

std::optional<double3> TransmissionLobe::sample(double2 u) const {
    if (mKind == Kind::LookUp) {
        const auto color = std::min(static_cast<size_t>(u.y * 3), size_t(2));
        // The rest of the number is uniform again.
        const double2 rest(u.x, u.y * 3 - static_cast<double>(color));
        return glm::normalize(mFrame.toWorld(mLookUpFrames[color].toWorld(mLookUpLobe->sample(rest))));
    }
    const double3 h = sampleVisibleNormal(mView, mAlpha, u);
    const double voh = glm::dot(mView, h);
    double3 local;
    if (mKind == Kind::Thin) {
        local = mirrored(2 * voh * h - mView);
    } else {
        const double sine2 = (1 - voh * voh) / (mEta * mEta);
        if (sine2 >= 1 || voh <= 0) return {};
        local = (h * voh - mView) / mEta - h * std::sqrt(1 - sine2);
    }
    if (local.z >= 0) return {};
    return glm::normalize(mFrame.toWorld(local));
}

double TransmissionLobe::pdf(double3 light) const {
    const double3 local = mFrame.toLocal(light);
    if (mKind == Kind::Straight) return 0;
    if (mKind == Kind::LookUp) {
        double sum = 0;
        for (Frame const& frame : mLookUpFrames) sum += mLookUpLobe->pdf(frame.toLocal(local)) / 3;
        return sum;
    }
    if (local.z >= 0) return 0;
    if (mKind == Kind::Thin) return visibleReflectionPdf(mView, mirrored(local), mAlpha);
    const double3 h = halfway(local);
    const double voh = glm::dot(mView, h), loh = glm::dot(local, h);
    if (voh <= 0 || loh >= 0) return 0;
    const double root = voh + mEta * loh;
    // Visible half vectors, and ibid., eq. 17.
    return smithMasking(mView, mAlpha) * ggx(h, mAlpha) * voh / mView.z * (mEta * mEta * -loh / (root * root));
}

} // namespace filament_core::reference
