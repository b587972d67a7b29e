// SPDX-License-Identifier: Apache-2.0
// cloth.glsl and subsurface.glsl: light that leaves elsewhere must not gain energy.
#include "tests/shaders/lib/Furnace.h"

#include <gtest/gtest.h>

namespace filament_core::shader::lib64 {
namespace {

/// Over all directions: both halves of the sphere.
template <class F>
auto integrateAll(F&& f) {
    return integrateUpper([&](vec3 d) { return f(d) + f(-d); });
}

TEST(WrappedDiffuse, ReflectsAllForEveryWrapAndIsLambertWithoutOne) {
    for (const double wrap : { 0.0, 0.25, 0.5, 1.0 }) {
        EXPECT_NEAR(integrateAll([&](vec3 l) { return diffuseWrapped(l.z, wrap); }), 1, 1e-3) << wrap;
    }
    EXPECT_EQ(diffuseWrapped(0.6, 0.0), diffuseLambert() * 0.6);
    EXPECT_EQ(diffuseWrapped(-0.1, 0.0), 0);
}

TEST(Cloth, ScattersAtMostWhatArrivesAndLessWhereItIsBlackInside) {
    const vec3 albedo = integrateAll([](vec3 l) { return diffuseCloth(l.z, vec3(1.0, 0.5, 0.0)); });
    EXPECT_NEAR(albedo.x, 1, 1e-3);
    EXPECT_GT(albedo.x, albedo.y);
    EXPECT_GT(albedo.y, albedo.z);
    EXPECT_GT(albedo.z, 0.5);
    EXPECT_LT(glm::distance(albedo, clothScatterAlbedo(vec3(1.0, 0.5, 0.0))), 1e-3) << "its closed form";
}

TEST(Cloth, TheDefaultSheenIsTheRootOfTheBaseColour) {
    EXPECT_EQ(clothSheenColor(vec3(0.25, 1.0, 0.0)), vec3(0.5, 1.0, 0.0));
}

TEST(Subsurface, TheTransmittedLobeIsNormalisedForEveryPower) {
    const vec3 view = viewAt(0.6);
    for (const double power : { 0.0, 0.5, 4.0, 12.234, 60.0 }) {
        EXPECT_NEAR(integrateAll([&](vec3 l) { return subsurfaceForward(dot(l, view), power); }), 1, 5e-3) << power;
    }
    EXPECT_NEAR(subsurfaceForward(0.3, 0.0), 1 / (4 * kPiOfTests), 1e-4) << "uniform";
}

TEST(Subsurface, EveryThicknessLetsLightThroughAndTheDefaultHalfOfIt) {
    EXPECT_EQ(subsurfaceOpacity(0.0), 0);
    EXPECT_EQ(subsurfaceOpacity(-1.0), 0);
    EXPECT_EQ(subsurfaceOpacity(0.5), 0.5);
    EXPECT_EQ(subsurfaceOpacity(2.0), 1 - 1.0 / 16);
    EXPECT_LT(subsurfaceOpacity(10.0), 1);
}

TEST(Subsurface, ScattersWhatTheOpacityLetsThrough) {
    const vec3 view = viewAt(0.6);
    for (const double opacity : { 0.0, 0.3, 0.8, 1.0 }) {
        const double scattered =
                integrateAll([&](vec3 l) { return subsurfaceScatter(l.z, dot(l, view), opacity, 12.234); });
        EXPECT_NEAR(scattered, 1 - opacity, 2e-3) << opacity;
        const double total = scattered + subsurfaceDiffuseScaling(vec3(1.0), opacity);
        EXPECT_LT(total, kNoGain);
        EXPECT_GT(total, 0.995);
    }
    EXPECT_EQ(subsurfaceDiffuseScaling(vec3(0.0), 0.0), 1) << "black scatters nothing and takes nothing";
}

TEST(Subsurface, IsBrightestAgainstTheLight) {
    EXPECT_GT(subsurfaceScatter(-1.0, -1.0, 0.1, 12.0), subsurfaceScatter(-1.0, -0.9, 0.1, 12.0));
    EXPECT_GT(subsurfaceScatter(-1.0, -1.0, 0.1, 12.0), 3 * subsurfaceScatter(-1.0, 0.5, 0.1, 12.0));
}

// The same half width: where the lobe of the environment, around the straight ray, falls to half of its peak.
TEST(Subsurface, TheSkyBehindIsBlurredAsFarAsTheLobeReaches) {
    for (const double power : { 8.0, 12.234, 40.0 }) {
        const double alpha = alphaFromPerceptual(subsurfaceForwardRoughness(power));
        const double cosine = 1 - 1 / power; // 2^(power (cos - 1)) = 1/2
        const double halfway = std::sqrt((1 + cosine) / 2);
        const double d = ndfGgx(halfway, alpha) / ndfGgx(1.0, alpha);
        EXPECT_NEAR(d, 0.5, 0.06) << power << ", whose angle is not quite small";
    }
    EXPECT_EQ(subsurfaceForwardRoughness(0.0), 1);
}

} // namespace
} // namespace filament_core::shader::lib64
