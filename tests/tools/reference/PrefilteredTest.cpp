// SPDX-License-Identifier: Apache-2.0
// Substitutes for integrals: the split sum's lobe and the sky's harmonics, compared with quadrature, closed forms and
// the exact integrals where both must agree.
#include "tests/tools/reference/TestScenes.h"

#include "filament_core/assets/environment/IblBaker.h"
#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/Bsdf.h"
#include "tools/reference/EnvironmentLight.h"

#include <random>

namespace filament_core::reference {
namespace {

const double kAlphas[] = { 0.002025, 0.05, 0.3, 0.7, 0.99, 0.9999, 1.0 };

TEST(PrefilteredLobe, ItsMeanCosineIsThatOfItsDensityByQuadrature) {
    for (const double alpha : kAlphas) {
        // Half angles by t^3, so that narrow lobes get enough points.
        double sum = 0;
        constexpr int kSteps = 20000;
        for (int i = 0; i < kSteps; ++i) {
            const double t = (i + 0.5) / kSteps, theta = 0.5 * kPiExact * t * t * t;
            const double d = shader::lib64::ndfGgxFromVectors({ 0, 0, 1 },
                                                              { std::sin(theta / 2), 0, std::cos(theta / 2) }, alpha);
            const double width = 0.5 * kPiExact * 3 * t * t / kSteps;
            sum += 2 * kPiExact * d / 4 * std::cos(theta) * std::sin(theta) * width;
        }
        EXPECT_NEAR(meanCosineOfLobe(alpha), sum, 1e-5 * sum) << alpha;
    }
}

TEST(PrefilteredLobe, ItsSamplesHaveItsDensityAndIntegrateItToOne) {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (const double alpha : { 0.05, 0.3, 1.0 }) {
        const PrefilteredLobe lobe(alpha);
        double value = 0, squareOfCosine = 0, expected = 0;
        constexpr int kSamples = 200'000;
        for (int i = 0; i < kSamples; ++i) {
            const double3 light = lobe.sample({ uniform(random), uniform(random) });
            ASSERT_NEAR(glm::length(light), 1, 1e-9);
            const double pdf = lobe.pdf(light);
            if (pdf <= 0) continue;
            value += lobe.value(light) / pdf / kSamples;
            squareOfCosine += light.z * light.z * lobe.value(light) / pdf / kSamples;
        }
        constexpr int kSteps = 20000;
        for (int i = 0; i < kSteps; ++i) {
            const double t = (i + 0.5) / kSteps, theta = 0.5 * kPiExact * t * t * t, z = std::cos(theta);
            const double width = 0.5 * kPiExact * 3 * t * t / kSteps;
            expected += 2 * kPiExact * lobe.value({ std::sin(theta), 0, z }) * z * z * std::sin(theta) * width;
        }
        EXPECT_NEAR(value, 1, 0.005) << alpha;
        EXPECT_NEAR(squareOfCosine, expected, 0.005) << alpha;
    }
}

TEST(SplitSumLobe, BetweenTwoLevelsItIsTheirMixAndOnALevelThatLobe) {
    constexpr double kLast = 4;
    const auto roughnessOf = [](double level) { return shader::lib64::perceptualRoughnessFromLevel(level, kLast); };
    const auto lobeOf = [&](double level) { return PrefilteredLobe(std::pow(roughnessOf(level), 2)); };
    for (const double3 light :
         { double3(0, 0, 1), glm::normalize(double3(0.4, 0, 1)), glm::normalize(double3(1, 0, 0.2)) }) {
        EXPECT_NEAR(SplitSumLobe(roughnessOf(2), 5).value(light), lobeOf(2).value(light), 1e-9);
        EXPECT_NEAR(SplitSumLobe(roughnessOf(2.25), 5).value(light),
                    0.75 * lobeOf(2).value(light) + 0.25 * lobeOf(3).value(light), 1e-9);
        EXPECT_NEAR(SplitSumLobe(1, 5).value(light), PrefilteredLobe(1).value(light), 1e-9);
        EXPECT_EQ(SplitSumLobe(0.6, 0).value(light), PrefilteredLobe(0.36).value(light));
    }
}

TEST(SplitSumLobe, SamplesOfAMixIntegrateItToOne) {
    std::mt19937_64 random(5);
    std::uniform_real_distribution<double> uniform(0, 1);
    const SplitSumLobe lobe(0.55, 4);
    double value = 0;
    constexpr int kSamples = 200'000;
    for (int i = 0; i < kSamples; ++i) {
        const double3 light = lobe.sample({ uniform(random), uniform(random) });
        if (lobe.pdf(light) > 0) value += lobe.value(light) / lobe.pdf(light) / kSamples;
    }
    EXPECT_NEAR(value, 1, 0.005);
}

TEST(SkyHarmonics, ASkyOfTwoBandsHasTheIrradianceOfItsFormula) {
    const auto sky = makeSky(128, [](double3 d) { return float3(double3(2 + d.y, 2 + d.x - 0.5 * d.z, 3)); });
    const EnvironmentLight light(sky, 10, 0);
    for (const double3 n : { double3(0, 1, 0), double3(1, 0, 0), glm::normalize(double3(1, -2, 0.5)) }) {
        const double3 expected = 10.0 * double3(2 + n.y * 2 / 3, 2 + (n.x - 0.5 * n.z) * 2 / 3, 3);
        const double3 found = light.harmonicIrradiance(n);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 0.005);
    }
}

TEST(SkyHarmonics, TheCoefficientsAreThoseThatTheEngineBakes) {
    const auto sky =
            makeSky(64, [](double3 d) { return float3(double3(std::exp(3 * d.x), std::exp(d.y - d.z), d.z * d.z)); });
    jobs::JobSystem jobs({ .workers = 0 });
    const std::array<float4, 9> baked = assets::irradianceSh(assets::faceLevelFromEquirect(*sky, 128, jobs), jobs);
    shader::lib64::vec4 coefficients[9];
    for (size_t i = 0; i < 9; ++i) coefficients[i] = double4(baked[i]);
    const EnvironmentLight light(sky, 1, 0);
    for (const double3 n : { double3(0, 1, 0), double3(1, 0, 0), glm::normalize(double3(1, -2, 0.5)) }) {
        const double3 engine = shader::lib64::irradianceSh(coefficients, n, 3), here = light.harmonicIrradiance(n);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(here[c], engine[c], 0.003 * engine[c]);
    }
}

TEST(SkyHarmonics, TurnWithTheEnvironment) {
    const auto sky = makeSky(64, [](double3 d) { return float3(double3(2 + d.z, 0, 0)); });
    const EnvironmentLight turned(sky, 1, kPiExact / 2);
    EXPECT_NEAR(turned.harmonicIrradiance({ 1, 0, 0 }).x, 2 + 2.0 / 3, 0.005) << "what was at +z is at +x";
}

/// A sphere of one material under a sky, unoccluded.
Estimate sphereUnder(std::shared_ptr<assets::HdrImage> sky, assets::MaterialData const& material, BsdfModel const& bsdf,
                     Sampling sampling = Sampling::Both, uint32_t samples = 256) {
    ReferenceScene scene;
    scene.models.push_back({ makeModel(spherePrimitive(), material) });
    scene.environment = { .image = std::move(sky), .illuminance = Lux{ 1 }, .skybox = false };
    return estimated(
            scene, viewFrom({ 0, 0, 40 }, { 0, 0, 0 }, { 16, 16 }, 2.0f),
            { .integrator = Integrator::Unoccluded, .samplesPerPixel = samples, .sampling = sampling, .bsdf = bsdf });
}

TEST(PrefilteredLight, UnderAUniformSkyTheSplitSumAndTheHarmonicsAreExact) {
    const auto sky = makeSky(8, [](double3) { return float3(1.0f); });
    for (assets::MaterialData material : { metal(0.2f), metal(0.8f), lambert(0.7f) }) {
        const Estimate exact = sphereUnder(sky, material, {});
        const Estimate prefiltered = sphereUnder(
                sky, material, { .specularLight = SpecularLight::SplitSum, .diffuseLight = DiffuseLight::Harmonics });
        expectAgrees(prefiltered, exact.mean, 4 * exact.error.x + 2e-3);
    }
}

TEST(PrefilteredLight, LightAndLobeSamplingOfTheSplitSumAgree) {
    const auto sky = makeSky(64, [](double3 d) { return float3(d.y > 0.9 ? 40.0f : 0.3f); });
    for (const float roughness : { 0.3f, 0.9f }) {
        const BsdfModel bsdf{ .specularLight = SpecularLight::SplitSum };
        const Estimate light = sphereUnder(sky, metal(roughness), bsdf, Sampling::Light);
        const Estimate lobe = sphereUnder(sky, metal(roughness), bsdf, Sampling::Bsdf);
        const Estimate both = sphereUnder(sky, metal(roughness), bsdf, Sampling::Both);
        expectAgrees(light, lobe.mean, 4 * lobe.error.x);
        expectAgrees(both, lobe.mean, 4 * lobe.error.x);
    }
}

TEST(PrefilteredLight, TheSplitSumOfASkyWithALampIsNotTheIntegral) {
    const auto sky = makeSky(64, [](double3 d) { return float3(d.x > 0.9 ? 40.0f : 0.0f); });
    const auto under = [&](BsdfModel const& bsdf) { return sphereUnder(sky, metal(0.6f), bsdf, Sampling::Both, 2048); };
    const Estimate exact = under({}), split = under({ .specularLight = SpecularLight::SplitSum });
    EXPECT_GT(std::abs(exact.mean.x - split.mean.x), 8 * (exact.error.x + split.error.x));
}

TEST(PrefilteredLight, ShadowsAndDisneysLobeAreRefusedWithIt) {
    jobs::JobSystem jobs({ .workers = 0 });
    ReferenceScene scene;
    scene.models.push_back({ makeModel(spherePrimitive(8), lambert(1)) });
    scene.environment = uniformSky();
    const ReferenceView view = viewFrom({ 0, 0, 4 }, { 0, 0, 0 });
    for (const BsdfModel bsdf : { BsdfModel{ .specularLight = SpecularLight::SplitSum },
                                  BsdfModel{ .diffuseLight = DiffuseLight::Harmonics } }) {
        EXPECT_FALSE(render(scene, view, { .integrator = Integrator::Path, .bsdf = bsdf }, jobs));
    }
    const BsdfModel disney{ .diffuse = DiffuseTerm::Disney, .diffuseLight = DiffuseLight::Harmonics };
    const auto refused = render(scene, view, { .integrator = Integrator::Unoccluded, .bsdf = disney }, jobs);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("harmonics for a diffuse lobe of Disney: give Lambert's"), std::string::npos)
            << refused.error().message;
}

} // namespace
} // namespace filament_core::reference
