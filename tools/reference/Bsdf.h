// SPDX-License-Identifier: Apache-2.0
/// Bsdf: how a SurfaceSample reflects: the engine's standard material as one function, its value, a sampler, and the
/// sampler's density.
///   Value   f(view, light) * cos, in 1/sr: diffuse lobe + D V F * energy compensation, from shaders/lib in double.
///   Sampler one lobe in proportion to the lobes' albedos. Specular: half vectors that the viewer sees (Heitz 2018,
///           "Sampling the GGX Distribution of Visible Normals"); diffuse: cosine.
///   Edge    views below the shading normal's horizon, which normal maps make, are lifted to nov = 1e-4: the engine
///           clamps nov alone, which for a light right behind the surface is a pole.
///   Thread  a value. Memory: none.
#pragma once

#include "tools/reference/BsdfModel.h"
#include "tools/reference/Prefiltered.h"
#include "tools/reference/Surface.h"

#include <optional>

namespace filament::reference {

/// What sends the light: the engine does not treat both alike (CouplingTerm::Engine, occlusion maps).
enum class LightSource : uint8_t {
    Ambient, ///< the environment and other surfaces
    Direct,  ///< suns and punctual lights
};

struct BsdfSample {
    double3 direction{ 0.0 }; ///< world, unit
    double pdf = 0;           ///< per steradian; 0: no direction, the path ends
};

class Bsdf {
public:
    /// `useOcclusion`: the occlusion map dims ambient light as it does in the engine.
    Bsdf(SurfaceSample const& surface, BsdfModel const& model, bool useOcclusion);

    /// f * cos(light, normal), zero below the horizon. `light`: world, unit. The lobe of the split sum stands in for
    /// the specular one and may reach below the horizon, as the engine's does.
    double3 evaluate(double3 light, LightSource source) const;
    /// u and choice in (0, 1).
    BsdfSample sample(double2 u, double choice) const;
    /// Of sample(), per steradian.
    double pdf(double3 light) const;
    /// What DiffuseLight::Harmonics multiplies irradiance / pi around the normal by; 0 with an integral.
    double3 harmonicAlbedo() const;

private:
    double3 toLocal(double3 v) const {
        return { glm::dot(v, mTangent), glm::dot(v, mBitangent), glm::dot(v, mNormal) };
    }
    double3 toWorld(double3 v) const { return mTangent * v.x + mBitangent * v.y + mNormal * v.z; }
    double visibility(double nol) const;
    double3 fresnel(double voh) const;
    double diffuseTerm(double nol, double voh) const;
    double3 lobesAt(double3 local, double nol, LightSource source) const;
    double3 sampleSpecular(double2 u) const; ///< local
    double specularPdf(double3 light) const;
    double3 toLobe(double3 local) const {
        return { glm::dot(local, mLobeTangent), glm::dot(local, mLobeBitangent), glm::dot(local, mLobeAxis) };
    }

    BsdfModel mModel;
    double3 mNormal, mTangent, mBitangent;
    double3 mView; // local, lifted to nov = kMinNov where it is below that
    double mNov, mRoughness, mAlpha;
    double3 mF0;
    double mF90;
    double mMetallic;
    double3 mDiffuse;
    double3 mCompensation;
    double3 mCoupling;              // of the diffuse lobe, where it applies
    double3 mAmbientDiffuse{ 1.0 }; // occlusion
    double mAmbientSpecular = 1;    // occlusion
    double mSpecularChance = 0;
    std::optional<SplitSumLobe> mLobe;                                                // SpecularLight::SplitSum
    double3 mLobeAxis{ 0, 0, 1 }, mLobeTangent{ 1, 0, 0 }, mLobeBitangent{ 0, 1, 0 }; // local
    double3 mLobeAlbedo{ 0.0 };
};

} // namespace filament::reference
