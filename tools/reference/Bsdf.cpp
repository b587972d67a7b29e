// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/Bsdf.h"

#include "shaders/lib/LibCppDouble.h"

#include <algorithm>

namespace filament_core::reference {

namespace lib = shader::lib64;

namespace {

using Base = std::variant<StandardLobes, ClothLobes>;

Base baseOf(SurfaceSample const& surface, BsdfModel const& model, bool useOcclusion) {
    if (surface.cloth.isCloth) return ClothLobes(surface, model);
    return StandardLobes(surface, model, useOcclusion);
}

bool hasCoat(SurfaceSample const& surface) { return surface.coat.strength > 0 && !surface.transmission.isFromInside; }

SurfaceSample underCoat(SurfaceSample surface, CoatLayer const& coat) {
    surface.view = coat.viewInside();
    surface.f0 = f0BelowCoat(surface.coat.bareF0, 1.0);
    surface.f90 = f90Of(surface.f0);
    return surface;
}

SurfaceSample withoutCoat(SurfaceSample surface) {
    surface.f0 = surface.coat.bareF0;
    surface.f90 = f90Of(surface.f0);
    return surface;
}

double3 albedoOf(Base const& base) {
    return std::visit([](auto const& lobes) { return lobes.albedo(); }, base);
}

double3 specularAlbedoOf(Base const& base) {
    return std::visit([](auto const& lobes) { return lobes.specularAlbedo(); }, base);
}

double3 diffuseShareOf(Base const& base, double3 light, LightSource source) {
    return std::visit([&](auto const& lobes) { return lobes.diffuseShare(light, source); }, base);
}

LobeValues valuesOf(Base const& base, double3 light, LightSource source) {
    return std::visit([&](auto const& lobes) { return lobes.evaluate(light, source); }, base);
}

std::optional<double3> sampleOfBase(Base const& base, double2 u, double choice) {
    return std::visit([&](auto const& lobes) { return lobes.sample(u, choice); }, base);
}

double pdfOfBase(Base const& base, double3 light) {
    return std::visit([&](auto const& lobes) { return lobes.pdf(light); }, base);
}

} // namespace

double f90Of(double3 f0) { return lib::saturate(lib::dot(f0, double3(50.0 * 0.33))); }

double3 f0BelowCoat(double3 bareF0, double strength) {
    const double3 covered = lib::f0UnderCoat(bareF0, 1.0) * glm::min(bareF0 * 50.0, 1.0);
    return glm::mix(bareF0, covered, strength);
}

Bsdf::Bsdf(SurfaceSample const& surface, BsdfModel const& model, bool useOcclusion, bool isBall)
        : mNormal(surface.normal), mBase(baseOf(surface, model, useOcclusion)) {
    TransmissionSample const& below = surface.transmission;
    const bool withSpecular = model.lobes != LobeChoice::Diffuse;
    if (hasCoat(surface) && withSpecular) {
        mCoat.emplace(surface, model);
        if (mCoat->isExact()) {
            mBase = baseOf(underCoat(surface, *mCoat), model, useOcclusion);
            if (mCoat->strength() < 1) mBare = baseOf(withoutCoat(surface), model, useOcclusion);
        }
    }
    if (surface.sheen.color != double3(0.0) && !below.isFromInside && withSpecular) mSheen.emplace(surface, model);
    if (below.color != double3(0.0) && withSpecular)
        mTransmission.emplace(surface, model, isBall, specularAlbedoOf(mBase));
    if (model.lobes != LobeChoice::Specular) mBehind = surface.diffuseTransmission.color;
    chooseChances();
}

// In proportion to what each part sends to the viewer, and at least a twentieth for each part that exists. The estimate
// cannot know what a view from inside transmits through tilted facets beyond the surface's critical angle.
void Bsdf::chooseChances() {
    const double throughCoat = mCoat ? mCoat->attenuationOfView() : 1;
    const double throughSheen = throughCoat * (mSheen ? mSheen->scalingOfView() : 1);
    double weights[kParts]{};
    if (mCoat) weights[kCoat] = mCoat->albedo();
    if (mSheen) weights[kSheen] = throughCoat * lib::luminance(mSheen->albedo());
    if (mTransmission) {
        weights[kTransmission] =
                std::max(throughSheen * lib::luminance(mTransmission->albedo()), std::min(mTransmission->width(), 0.2));
    }
    weights[kBehind] = throughSheen * lib::luminance(mBehind);
    weights[kBase] = throughSheen * lib::luminance(albedoOf(mBase));
    if (mBare) weights[kBare] = (1 - mCoat->strength()) * lib::luminance(albedoOf(*mBare));
    double sum = 0;
    for (const double weight : weights) sum += weight;
    if (!(sum > 0)) weights[kBase] = sum = 1;
    double total = 0;
    for (int part = 0; part < kParts; ++part) {
        mChances[part] = weights[part] > 0 ? std::max(weights[part] / sum, 0.05) : 0;
        total += mChances[part];
    }
    for (double& chance : mChances) chance /= total;
}

double3 Bsdf::harmonicAlbedo() const {
    const double3 albedo = std::visit([](auto const& lobes) { return lobes.harmonicAlbedo(); }, mBase);
    const double sheen = mSheen ? mSheen->scalingOfView() : 1;
    return albedo * (sheen * (mCoat ? mCoat->attenuation(mNormal, LightSource::Ambient) : 1));
}

double3 Bsdf::evaluate(double3 light, LightSource source) const {
    double3 sum = coatedAt(light, source) + behindAt(light, source);
    if (mCoat) sum += mCoat->evaluate(light, source);
    return sum;
}

double3 Bsdf::baseAt(double3 light, LightSource source) const {
    const LobeValues values = valuesOf(mBase, light, source);
    double3 sum = values.diffuse + values.specular;
    if (mSheen) sum = sum * mSheen->scaling(light, source) + mSheen->evaluate(light, source);
    return sum;
}

double3 Bsdf::coatedAt(double3 light, LightSource source) const {
    if (!mCoat) return baseAt(light, source);
    if (!mCoat->isExact()) return baseAt(light, source) * mCoat->attenuation(light, source);
    double3 sum(0.0);
    if (const std::optional<double3> inside = mCoat->inside(light)) {
        LobeValues values = valuesOf(mBase, *inside, source);
        if (mSheen) {
            const double kept = mSheen->scaling(light, source);
            values.diffuse *= kept;
            values.specular *= kept;
        }
        sum += mCoat->combined(values, specularAlbedoOf(mBase), light) * mCoat->strength();
    }
    if (mBare) {
        const LobeValues values = valuesOf(*mBare, light, source);
        const double kept = mSheen ? mSheen->scaling(light, source) : 1;
        sum += (values.diffuse + values.specular) * (kept * (1 - mCoat->strength()));
    }
    if (mSheen) sum += mSheen->evaluate(light, source) * mCoat->attenuation(light, source);
    return sum;
}

// As in the engine: light from behind crosses the coat in both directions, and the sheen on its way out.
double3 Bsdf::behindAt(double3 light, LightSource source) const {
    double3 sum(0.0);
    const double sheen = mSheen ? mSheen->scalingOfView() : 1;
    if (mTransmission) sum += mTransmission->evaluate(light, source) * sheen;
    if (const double cosine = -glm::dot(light, mNormal); cosine > 0) {
        sum += mBehind * (lib::diffuseLambert() * cosine * sheen) * diffuseShareOf(mBase, light, source);
    }
    return mCoat ? sum * mCoat->attenuation(light, source) : sum;
}

double3 Bsdf::straightShare() const {
    if (!mTransmission) return double3(0.0);
    const double sheen = mSheen ? mSheen->scalingOfView() : 1;
    return mTransmission->straightShare() * (sheen * (mCoat ? mCoat->attenuationOfView() : 1));
}

BsdfSample Bsdf::sample(double2 u, double choice) const {
    int part = 0;
    while (part < kBase && choice >= mChances[part]) choice -= mChances[part++];
    const auto chosen = static_cast<Part>(part);
    if (chosen == kTransmission && mTransmission->isStraight()) return { double3(0.0), mChances[part], true };
    // What is left of the number is uniform again, and serves the choice within the part.
    const double rest = std::clamp(choice / mChances[part], 1e-12, 1 - 1e-12);
    const std::optional<double3> direction = sampleOf(chosen, u, rest);
    if (!direction) return {};
    // The density of all parts, not of the chosen one alone: any of them could have given this direction.
    return { *direction, pdf(*direction) };
}

std::optional<double3> Bsdf::sampleOf(Part part, double2 u, double choice) const {
    switch (part) {
    case kCoat:
        return mCoat->sample(u);
    case kSheen:
        return mSheen->sample(u);
    case kTransmission:
        return mTransmission->sample(u);
    case kBehind: {
        const double3 local = lib::hemisphereCosineSample(u);
        return glm::normalize(Frame(-mNormal).toWorld(local));
    }
    case kBare:
        return sampleOfBase(*mBare, u, choice);
    case kBase:
    case kParts:
        break;
    }
    const std::optional<double3> direction = sampleOfBase(mBase, u, choice);
    return direction && isRefractedByCoat() ? mCoat->outside(*direction) : direction;
}

double Bsdf::pdf(double3 light) const {
    double sum = 0;
    for (int part = 0; part < kParts; ++part) {
        if (mChances[part] > 0) sum += mChances[part] * pdfOf(static_cast<Part>(part), light);
    }
    return sum;
}

double Bsdf::pdfOf(Part part, double3 light) const {
    switch (part) {
    case kCoat:
        return mCoat->pdf(light);
    case kSheen:
        return mSheen->pdf(light);
    case kTransmission:
        return mTransmission->pdf(light);
    case kBehind:
        return std::max(-glm::dot(light, mNormal), 0.0) * lib::kInversePi;
    case kBare:
        return pdfOfBase(*mBare, light);
    case kBase:
    case kParts:
        break;
    }
    if (!isRefractedByCoat()) return pdfOfBase(mBase, light);
    const std::optional<double3> inside = mCoat->inside(light);
    return inside ? pdfOfBase(mBase, *inside) * mCoat->spread(light) : 0;
}

} // namespace filament_core::reference
