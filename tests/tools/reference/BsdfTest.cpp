// SPDX-License-Identifier: Apache-2.0
// The material as a function and as a sampler: physics, and each compared with the other.
#include "tests/tools/reference/BsdfChecks.h"

#include "shaders/lib/LibCppDouble.h"
#include "tools/reference/DirectionalAlbedo.h"
#include "tools/reference/SampleStream.h"

#include <algorithm>
#include <random>

namespace filament_core::reference {
namespace {

constexpr double kViewCosines[] = { 0.05, 0.3, 0.7, 1.0 };
constexpr double kBsdfRoughnesses[] = { 0.2, 0.5, 1.0 };
constexpr SpecularVisibility kVisibilities[] = { SpecularVisibility::Correlated, SpecularVisibility::Fast,
                                                 SpecularVisibility::Uncorrelated };

TEST(Bsdf, ReflectsTheSameInBothDirectionsWithoutTermsThatDependOnTheView) {
    const BsdfModel models[] = {
        { .energy = EnergyTerm::SingleScatter, .coupling = CouplingTerm::Never },
        { .energy = EnergyTerm::SingleScatter, .coupling = CouplingTerm::Always },
        { .visibility = SpecularVisibility::Fast,
          .energy = EnergyTerm::SingleScatter,
          .coupling = CouplingTerm::Never },
        { .visibility = SpecularVisibility::Uncorrelated,
          .fresnel = FresnelTerm::Exact,
          .diffuse = DiffuseTerm::Disney,
          .energy = EnergyTerm::SingleScatter,
          .coupling = CouplingTerm::Never },
    };
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0.01, 1);
    for (BsdfModel const& model : models) {
        for (int i = 0; i < 100; ++i) {
            const double3 a = directionAt(unit(random), 7 * unit(random)),
                          b = directionAt(unit(random), 7 * unit(random));
            const double roughness = unit(random), metallic = unit(random);
            const double3 color(unit(random), unit(random), unit(random));
            const Bsdf fromA(surfaceOf(roughness, metallic, color, a), model, false);
            const Bsdf fromB(surfaceOf(roughness, metallic, color, b), model, false);
            const double3 there = fromA.evaluate(inFrame(b), LightSource::Ambient) / b.z;
            const double3 back = fromB.evaluate(inFrame(a), LightSource::Ambient) / a.z;
            EXPECT_LT(glm::length(there - back), 1e-9 * glm::length(there)) << i;
        }
    }
}

TEST(Bsdf, ItsDensityCoversTheDirectionsAboveTheSurfaceAndNoMoreThanOnce) {
    for (const double cosine : kViewCosines) {
        for (const double roughness : kBsdfRoughnesses) {
            for (const double metallic : { 0.0, 1.0 }) {
                const Bsdf bsdf(surfaceOf(roughness, metallic, double3(0.5), directionAt(cosine, 0)), {}, false);
                const double covered = integrate(
                        cosine, [&](double3 light) { return bsdf.pdf(light); }, 500, 100);
                EXPECT_NEAR(covered + shareWithoutDirection(bsdf), 1, 5e-3)
                        << cosine << ' ' << roughness << ' ' << metallic;
                EXPECT_LE(covered, 1 + 1e-3);
            }
        }
    }
}

TEST(Bsdf, SamplesFallAsTheirDensitySays) {
    for (const double cosine : { 0.1, 0.6, 0.95 }) {
        for (const double roughness : { 0.3, 0.6, 1.0 }) {
            const Bsdf bsdf(surfaceOf(roughness, 0.5, double3(0.6), directionAt(cosine, 0.4)), {}, false);
            EXPECT_LT(chiSquareDeviations(bsdf), 4) << "view " << cosine << ", roughness " << roughness;
        }
    }
}

TEST(Bsdf, WithCouplingNoSurfaceReflectsMoreThanItGets) {
    for (const double cosine : kViewCosines) {
        for (const double roughness : kBsdfRoughnesses) {
            for (const double metallic : { 0.0, 0.5, 1.0 }) {
                for (const SpecularVisibility visibility :
                     { SpecularVisibility::Correlated, SpecularVisibility::Uncorrelated }) {
                    const BsdfModel model{ .visibility = visibility, .coupling = CouplingTerm::Always };
                    const Bsdf bsdf(surfaceOf(roughness, metallic, double3(1), directionAt(cosine, 0)), model, false);
                    const double3 albedo =
                            integrate(cosine, [&](double3 light) { return bsdf.evaluate(light, LightSource::Direct); });
                    EXPECT_LE(albedo.x, 1 + 2e-3) << cosine << ' ' << roughness << ' ' << metallic;
                }
            }
        }
    }
}

TEST(Bsdf, TheEngineCouplesTheDiffuseLobeToBothDirectionsOfLightsAndToTheViewUnderTheSky) {
    const SurfaceSample surface = surfaceOf(0.5, 0, double3(0.8), directionAt(0.5, 0));
    const double3 light = inFrame(directionAt(0.2, 2));
    const auto reflected = [&](CouplingTerm coupling, LightSource source) {
        return Bsdf(surface, { .coupling = coupling }, false).evaluate(light, source).x;
    };
    EXPECT_EQ(reflected(CouplingTerm::Engine, LightSource::Direct),
              reflected(CouplingTerm::Always, LightSource::Direct));
    EXPECT_EQ(reflected(CouplingTerm::Engine, LightSource::Ambient),
              reflected(CouplingTerm::AmbientOnly, LightSource::Ambient));
    EXPECT_EQ(reflected(CouplingTerm::AmbientOnly, LightSource::Direct),
              reflected(CouplingTerm::Never, LightSource::Direct));
    EXPECT_LT(reflected(CouplingTerm::Always, LightSource::Ambient),
              0.95 * reflected(CouplingTerm::AmbientOnly, LightSource::Ambient))
            << "a grazing light loses more than the sky does on average";
    EXPECT_LT(reflected(CouplingTerm::AmbientOnly, LightSource::Ambient),
              0.95 * reflected(CouplingTerm::Never, LightSource::Ambient));
}

TEST(Bsdf, CoupledWhitePlasticReflectsAllThatArrives) {
    for (const double cosine : kViewCosines) {
        for (const double roughness : kBsdfRoughnesses) {
            const BsdfModel model{ .coupling = CouplingTerm::Always };
            const Bsdf bsdf(surfaceOf(roughness, 0, double3(1), directionAt(cosine, 0)), model, false);
            const double3 albedo =
                    integrate(cosine, [&](double3 light) { return bsdf.evaluate(light, LightSource::Direct); });
            EXPECT_NEAR(albedo.x, 1, 4e-3) << cosine << ' ' << roughness;
        }
    }
}

// As in the engine: light mirrored by a normal map fades below the surface that has the map, only if nothing else
// occludes.
TEST(Bsdf, ANormalMapsReflectionsFadeBelowItsSurface) {
    SurfaceSample surface = surfaceOf(0.3, 1, double3(0.9), directionAt(0.5, 0));
    const double3 light = inFrame(directionAt(0.5, 3.14159)), mirrored = inFrame({ -directionAt(0.5, 0).x, 0, 0.5 });
    const auto reflected = [&](bool useOcclusion) {
        return Bsdf(surface, {}, useOcclusion).evaluate(light, LightSource::Ambient).x;
    };
    const double whole = reflected(true);
    EXPECT_EQ(whole, reflected(false));
    surface.unmappedNormal = -mirrored; // wholly below
    EXPECT_LT(reflected(true), 1e-9 * whole);
    EXPECT_EQ(reflected(false), whole);
    surface.unmappedNormal = glm::normalize(surface.normal - mirrored);
    const double sunk = 1 + glm::dot(mirrored, *surface.unmappedNormal);
    EXPECT_NEAR(reflected(true) / whole, sunk * sunk, 1e-9);
    surface.unmappedNormal = mirrored;
    EXPECT_NEAR(reflected(true) / whole, 1, 1e-9);
}

TEST(Bsdf, DiffuseAndSpecularAloneAddUpToBoth) {
    for (const LightSource source : { LightSource::Ambient, LightSource::Direct }) {
        const SurfaceSample surface = surfaceOf(0.4, 0.3, double3(0.8, 0.5, 0.2), directionAt(0.5, 0));
        const double3 light = inFrame(directionAt(0.8, 2));
        const auto with = [&](LobeChoice lobes) {
            return Bsdf(surface, { .lobes = lobes }, false).evaluate(light, source);
        };
        const double3 sum = with(LobeChoice::Diffuse) + with(LobeChoice::Specular);
        EXPECT_LT(glm::length(sum - with(LobeChoice::Both)), 1e-12);
        EXPECT_GT(with(LobeChoice::Diffuse).x, 0);
    }
}

TEST(Bsdf, EverySampleHasTheWeightThatTheDensityPromises) {
    // The mean of value over density is the albedo; with visible normals single weights stay small.
    for (const SpecularVisibility visibility : kVisibilities) {
        for (const double cosine : kViewCosines) {
            const Bsdf bsdf(surfaceOf(0.4, 1, double3(1), directionAt(cosine, 0)),
                            { .visibility = visibility, .energy = EnergyTerm::SingleScatter }, false);
            const double exact =
                    integrate(cosine, [&](double3 light) { return bsdf.evaluate(light, LightSource::Ambient).x; });
            double mean = 0, largest = 0;
            constexpr uint32_t kCount = 4096;
            for (uint32_t i = 0; i < kCount; ++i) {
                const SampleStream numbers(11, i);
                const BsdfSample sample = bsdf.sample(numbers.pair(0), numbers.pair(1).x);
                if (sample.pdf == 0) continue;
                const double weight = bsdf.evaluate(sample.direction, LightSource::Ambient).x / sample.pdf;
                mean += weight / kCount;
                largest = std::max(largest, weight);
            }
            EXPECT_NEAR(mean, exact, 5e-3);
            EXPECT_LT(largest, 2.5);
        }
    }
}

// Every choice is the library's function of the same name, and no other.
TEST(Bsdf, EachChosenTermIsTheLibrarys) {
    namespace lib = shader::lib64;
    const double nov = 0.4, nol = 0.7, roughness = 0.5, alpha = 0.25, metallic = 0.6;
    const double3 view = directionAt(nov, 0), light = directionAt(nol, 2), h = glm::normalize(view + light);
    const double voh = glm::dot(view, h);
    SurfaceSample surface = surfaceOf(roughness, metallic, double3(0.9, 0.6, 0.3), view);
    surface.f90 = 0.8;
    const auto reflected = [&](BsdfModel model) {
        model.energy = EnergyTerm::SingleScatter;
        model.coupling = CouplingTerm::Never;
        return Bsdf(surface, model, false).evaluate(inFrame(light), LightSource::Direct);
    };
    const auto expected = [&](double visibility, double3 fresnel, double diffuse) {
        return (surface.diffuse * diffuse + lib::ndfGgx(h.z, alpha) * visibility * fresnel) * nol;
    };
    const double correlated = lib::visibilitySmithGgxCorrelated(nov, nol, alpha), lambert = lib::diffuseLambert();
    const double3 schlick = lib::fresnelSchlick(surface.f0, 0.8, voh);
    const std::pair<BsdfModel, double3> cases[] = {
        { {}, expected(correlated, schlick, lambert) },
        { { .visibility = SpecularVisibility::Fast },
          expected(lib::visibilitySmithGgxCorrelatedFast(nov, nol, alpha), schlick, lambert) },
        { { .visibility = SpecularVisibility::Uncorrelated },
          expected(lib::visibilitySmithGgxUncorrelated(nov, nol, alpha), schlick, lambert) },
        { { .fresnel = FresnelTerm::Exact },
          expected(correlated, lib::fresnelExact(surface.f0, metallic, voh) * 0.8, lambert) },
        { { .diffuse = DiffuseTerm::Disney },
          expected(correlated, schlick, lib::diffuseDisney(nov, nol, voh, roughness)) },
    };
    for (auto const& [model, value] : cases) {
        EXPECT_LT(glm::distance(reflected(model), value), 1e-9 * glm::length(value));
        EXPECT_EQ(model == BsdfModel{}, reflected(model) == reflected({})) << "the choice makes a difference";
    }
}

TEST(Bsdf, TheOcclusionMapDimsAmbientLightOnly) {
    SurfaceSample surface = surfaceOf(0.5, 0, double3(0.8), directionAt(0.5, 0));
    surface.occlusion = 0.25;
    const double3 light = inFrame(directionAt(0.8, 2));
    const Bsdf used(surface, { .lobes = LobeChoice::Diffuse }, true),
            ignored(surface, { .lobes = LobeChoice::Diffuse }, false);
    EXPECT_NEAR(used.evaluate(light, LightSource::Ambient).x, 0.25 * ignored.evaluate(light, LightSource::Ambient).x,
                1e-12);
    EXPECT_EQ(used.evaluate(light, LightSource::Direct), ignored.evaluate(light, LightSource::Direct));
    const Bsdf specular(surface, { .lobes = LobeChoice::Specular }, true),
            unoccluded(surface, { .lobes = LobeChoice::Specular }, false);
    const double factor = shader::lib64::specularOcclusion(0.5, 0.25, 0.25);
    EXPECT_NEAR(specular.evaluate(light, LightSource::Ambient).x,
                factor * unoccluded.evaluate(light, LightSource::Ambient).x, 1e-12);
}

TEST(Bsdf, ViewsAndLightsAtOrBelowTheHorizonStayFinite) {
    for (const double viewCosine : { -0.5, -1e-9, 0.0, 1e-9, 1e-4 }) {
        for (const double roughness : { 0.0, 0.5, 1.0 }) {
            const double3 view = directionAt(viewCosine, 0.3);
            const Bsdf bsdf(surfaceOf(roughness, 1, double3(1), view), {}, false);
            for (const double3 local : { directionAt(1e-9, 3), directionAt(0.5, 3.4), -view, directionAt(1, 0) }) {
                const double3 value = bsdf.evaluate(inFrame(local), LightSource::Ambient);
                EXPECT_TRUE(std::isfinite(value.x) && value.x >= 0);
                EXPECT_TRUE(std::isfinite(bsdf.pdf(inFrame(local))));
                // Directions that reflect must be sampled, otherwise estimates would miss them.
                EXPECT_EQ(value.x > 0, bsdf.pdf(inFrame(local)) > 0) << viewCosine;
            }
            for (uint32_t i = 0; i < 64; ++i) {
                const SampleStream numbers(5, i);
                const BsdfSample sample = bsdf.sample(numbers.pair(0), numbers.pair(1).x);
                EXPECT_TRUE(std::isfinite(sample.pdf) && sample.pdf >= 0);
                EXPECT_NEAR(glm::length(sample.direction), sample.pdf > 0 ? 1 : 0, 1e-9);
            }
        }
    }
}

TEST(DirectionalAlbedo, IsTheIntegralOfTheLobeOverLights) {
    for (const double cosine : { 0.05, 0.4, 1.0 }) {
        for (const double roughness : { 0.35, 0.7, 1.0 }) {
            const Bsdf white(surfaceOf(roughness, 1, double3(1), directionAt(cosine, 0)),
                             { .energy = EnergyTerm::SingleScatter }, false);
            const double exact = integrate(
                    cosine, [&](double3 light) { return white.evaluate(light, LightSource::Ambient).x; }, 400, 400);
            EXPECT_NEAR(integrateDirectionalAlbedo(cosine, roughness * roughness).y, exact, 1e-3); // of the brute force
        }
    }
}

TEST(DirectionalAlbedo, ItsTableIsGoodToTwoTenThousandths) {
    double worst = 0;
    for (int i = 0; i < 40; ++i) {
        for (int j = 0; j < 20; ++j) {
            const double cosine = std::pow((i + 0.37) / 40, 3) + 1e-4, roughness = 0.045 + 0.955 * (j + 0.41) / 20;
            const double2 exact = integrateDirectionalAlbedo(cosine, roughness * roughness);
            const double2 error = glm::abs(directionalAlbedo(cosine, roughness) - exact);
            worst = std::max({ worst, error.x, error.y });
        }
    }
    EXPECT_LT(worst, 2e-4);
    EXPECT_NEAR(directionalAlbedo(1, 0.045).y, 1, 2e-4);
}

} // namespace
} // namespace filament_core::reference
