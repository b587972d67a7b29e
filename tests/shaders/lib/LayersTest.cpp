// SPDX-License-Identifier: Apache-2.0
// White furnace and reciprocity of every stack of layers under lights: base, sheen above it, coat above both. Each
// layer reduces those below as its file describes. Prints the least and the most light that each stack keeps;
// docs/energy.md has that table.
#include "tests/shaders/lib/Furnace.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

namespace filament_core::shader::lib64 {
namespace {

constexpr double kLayerCosines[] = { 0.05, 0.2, 0.5, 0.9 };
/// The azimuth resolves grazing lobes, which are a twentieth of a radian wide.
constexpr Quadrature kGrazing{ .polar = 200, .azimuth = 360 };

/// A directional albedo at cosines between 0 and 1, as a table would store it.
class Albedo {
public:
    template <class F>
    explicit Albedo(F&& lobe) {
        for (size_t i = 0; i < mValues.size(); ++i) {
            const vec3 v = viewAt((double(i) + 0.5) / double(mValues.size()));
            mValues[i] = integrateUpper([&](vec3 l) { return lobe(v, l) * l.z; }, { .polar = 128, .azimuth = 256 });
        }
    }
    double operator()(double cosine) const {
        const double last = double(mValues.size()) - 1;
        const double x = clamp(cosine * double(mValues.size()) - 0.5, 0.0, last);
        const auto i = static_cast<size_t>(std::min(x, last - 1));
        return mix(mValues[i], mValues[i + 1], x - double(i));
    }

private:
    std::array<double, 40> mValues{};
};

enum class Base { WhiteMetal, BrushedMetal, WhitePlastic, Cloth };
constexpr std::array kBases{ Base::WhiteMetal, Base::BrushedMetal, Base::WhitePlastic, Base::Cloth };
constexpr const char* kBaseNames[] = { "white metal", "brushed white metal", "white plastic", "white cloth" };

/// Strengths of white layers.
struct Above {
    double sheen = 0, coat = 0;
};

/// The BRDF of a stack for a pair of directions.
class StackBrdf {
public:
    StackBrdf(Base base, double roughness)
            : mBase(base), mAlpha(alphaFromPerceptual(roughness)), mStretched(anisotropicAlpha(mAlpha, 0.7, kMinAlpha)),
              mPlastic([this](vec3 v, vec3 l) { return ggx(v, l) * fresnelSchlick(vec3(0.04), 1.0, voh(v, l)).x; }),
              mFibres([this](vec3 v, vec3 l) { return fibres(v, l); }),
              mCoatGrazing([](vec3 v, vec3 l) { return smoothCoat(v, l) * pow5(1 - voh(v, l)); }),
              mCoatAll(smoothCoat) {}

    double operator()(vec3 v, vec3 l, Above above) const {
        const double fuzz = std::min(sheenLimit(mFibres(v.z)), sheenLimit(mFibres(l.z))) * fibres(v, l);
        const double below =
                above.sheen > 0 ? above.sheen * fuzz + keptBySheen(v, l, above.sheen) * base(v, l) : base(v, l);
        const vec3 h = glm::normalize(v + l);
        const double coat = ndfGgx(h.z, kCoatAlpha) * visibilityCoat(v.z, l.z, dot(v, h), kCoatAlpha) *
                            coatFresnel(dot(v, h), above.coat);
        return below * std::min(leftByCoat(v.z, above.coat), leftByCoat(l.z, above.coat)) + coat;
    }

private:
    static constexpr double kCoatAlpha = 0.09; // roughness 0.3

    /// The integrals of the split-sum table.
    static double smoothCoat(vec3 v, vec3 l) {
        const double noh = std::min(glm::normalize(v + l).z, 1.0);
        return ndfGgx(noh, kCoatAlpha) * visibilitySmithGgxCorrelated(v.z, l.z, kCoatAlpha);
    }
    double leftByCoat(double cosine, double strength) const {
        return coatTransmissionFromDfg(vec2(mCoatGrazing(cosine), mCoatAll(cosine)), strength);
    }
    static double voh(vec3 v, vec3 l) { return dot(v, glm::normalize(v + l)); }
    double ggx(vec3 v, vec3 l) const {
        const vec3 h = glm::normalize(v + l);
        if (mBase == Base::BrushedMetal)
            return ndfGgxAnisotropic(h, mStretched) * visibilitySmithGgxAnisotropic(v, l, mStretched);
        return ndfGgx(std::min(h.z, 1.0), mAlpha) * visibilitySmithGgxCorrelated(v.z, l.z, mAlpha);
    }
    double fibres(vec3 v, vec3 l) const {
        return ndfCharlie(std::min(glm::normalize(v + l).z, 1.0), mAlpha) * visibilityNeubelt(v.z, l.z);
    }
    double keptBySheen(vec3 v, vec3 l, double strength) const {
        return std::min(sheenAlbedoScaling(vec3(strength), mFibres(v.z)),
                        sheenAlbedoScaling(vec3(strength), mFibres(l.z)));
    }
    double base(vec3 v, vec3 l) const {
        switch (mBase) {
        case Base::WhitePlastic:
            return ggx(v, l) * fresnelSchlick(vec3(0.04), 1.0, voh(v, l)).x +
                   diffuseLambert() * (1 - mPlastic(v.z)) * (1 - mPlastic(l.z));
        case Base::Cloth:
            return std::min(sheenLimit(mFibres(v.z)), sheenLimit(mFibres(l.z))) * fibres(v, l) +
                   keptBySheen(v, l, 1.0) * diffuseCloth(l.z, vec3(1.0)).x / l.z;
        default:
            return ggx(v, l);
        }
    }

    Base mBase;
    double mAlpha;
    vec2 mStretched;
    Albedo mPlastic, mFibres, mCoatGrazing, mCoatAll;
};

TEST(Layers, NoStackReflectsMoreThanArrives) {
    std::printf("| base | alone | sheen | coat | sheen and coat |\n|---|---|---|---|---|\n");
    for (const Base base : kBases) {
        const char* name = kBaseNames[static_cast<size_t>(base)];
        const std::array<StackBrdf, 3> surfaces{ StackBrdf(base, 0.4), StackBrdf(base, 0.7), StackBrdf(base, 1.0) };
        std::printf("| %s |", name);
        for (const Above above : { Above{}, Above{ 1, 0 }, Above{ 0, 1 }, Above{ 1, 1 } }) {
            double least = 1, most = 0;
            for (StackBrdf const& brdf : surfaces) {
                for (const double nov : kLayerCosines) {
                    const vec3 v = viewAt(nov);
                    const double kept = integrateUpper([&](vec3 l) { return brdf(v, l, above) * l.z; }, kGrazing);
                    EXPECT_LT(kept, kNoGain) << name << " nov " << nov << " sheen " << above.sheen << " coat "
                                             << above.coat << " surface " << &brdf - surfaces.data();
                    least = std::min(least, kept);
                    most = std::max(most, kept);
                }
            }
            std::printf(" %.2f to %.2f |", least, most);
        }
        std::printf("\n");
    }
}

// The wrapped diffuse lobe of cloth scatters through the surface; only this lobe is not meant to be reciprocal.
TEST(Layers, StacksAreReciprocal) {
    const vec3 a = glm::normalize(vec3(0.3, -0.8, 0.2)), b = glm::normalize(vec3(-0.9, 0.1, 0.7));
    for (const Base base : { Base::WhiteMetal, Base::BrushedMetal, Base::WhitePlastic }) {
        const StackBrdf brdf(base, 0.5);
        const Above above{ 0.8, 0.6 };
        EXPECT_NEAR(brdf(a, b, above) / brdf(b, a, above), 1, 1e-12) << kBaseNames[static_cast<size_t>(base)];
    }
}

TEST(Layers, LayersOfStrengthZeroAreNotThere) {
    const vec3 v = viewAt(0.4), l = glm::normalize(vec3(-0.2, 0.5, 0.6)), h = glm::normalize(v + l);
    const StackBrdf metal(Base::WhiteMetal, 0.5);
    EXPECT_NEAR(metal(v, l, {}), ndfGgx(h.z, 0.25) * visibilitySmithGgxCorrelated(v.z, l.z, 0.25), 1e-12);
}

} // namespace
} // namespace filament_core::shader::lib64
