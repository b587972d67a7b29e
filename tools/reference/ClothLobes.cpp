// SPDX-License-Identifier: Apache-2.0
#include "tools/reference/ClothLobes.h"

#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/SheenAlbedo.h"

#include <algorithm>
#include <cmath>

namespace filament_core::reference {

namespace lib = shader::lib64;

namespace {

constexpr double kDiffuseChance = 0.5;

} // namespace

ClothLobes::ClothLobes(SurfaceSample const& surface, BsdfModel const& model)
        : mChoice(model.lobes), mFrame(surface.normal), mView(liftedAboveHorizon(mFrame.toLocal(surface.view))),
          mRoughness(surface.perceptualRoughness), mAlpha(lib::alphaFromPerceptual(mRoughness)),
          mDiffuse(surface.diffuse), mSheenColor(surface.cloth.sheenColor),
          mSubsurfaceColor(surface.cloth.subsurfaceColor), mViewAlbedo(sheenAlbedo(mView.z, mRoughness)) {}

double3 ClothLobes::albedo() const { return mDiffuse + specularAlbedo(); }

LobeValues ClothLobes::evaluate(double3 light, LightSource) const {
    const double3 local = mFrame.toLocal(light);
    LobeValues values;
    if (mChoice != LobeChoice::Specular) {
        const double lambert = std::max(local.z, 0.0) * lib::diffuseLambert();
        values.diffuse =
                mDiffuse * (mSubsurfaceColor ? lib::diffuseCloth(local.z, *mSubsurfaceColor) : double3(lambert));
    }
    const double3 sum = mView + local;
    const double length = glm::length(sum);
    if (local.z <= 0 || length < 1e-12 || mChoice == LobeChoice::Diffuse) return values;
    const double nol = std::min(local.z, 1.0), noh = std::min(sum.z / length, 1.0);
    const double limit = std::min(lib::sheenLimit(mViewAlbedo), lib::sheenLimit(sheenAlbedo(nol, mRoughness)));
    values.specular = mSheenColor * (lib::ndfCharlie(noh, mAlpha) * lib::visibilityNeubelt(mView.z, nol) * nol * limit);
    return values;
}

// The wrapped lobe's own density, whose integral weights its cosines: ((c + w) / (1 + w))^2 is uniform.
std::optional<double3> ClothLobes::sample(double2 u, double choice) const {
    const double wrap = mSubsurfaceColor ? lib::kClothWrap : 0;
    const double cosine =
            choice < kDiffuseChance ? (1 + wrap) * std::sqrt(1 - u.y) - wrap : 1 - u.y; // otherwise uniform
    const double sine = std::sqrt(std::max(1 - cosine * cosine, 0.0)), azimuth = lib::kTwoPi * u.x;
    return glm::normalize(mFrame.toWorld({ sine * std::cos(azimuth), sine * std::sin(azimuth), cosine }));
}

double ClothLobes::pdf(double3 light) const {
    const double cosine = std::min(mFrame.toLocal(light).z, 1.0), wrap = mSubsurfaceColor ? lib::kClothWrap : 0;
    const double uniform = cosine > 0 ? 0.5 * lib::kInversePi : 0;
    return kDiffuseChance * lib::diffuseWrapped(cosine, wrap) + (1 - kDiffuseChance) * uniform;
}

} // namespace filament_core::reference
