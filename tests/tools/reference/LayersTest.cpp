// SPDX-License-Identifier: Apache-2.0
// Layers and lobes beyond the standard ones: each as a density, as physics, and compared with a second computation.
#include "tests/tools/reference/BsdfChecks.h"

#include "tools/reference/DirectionalAlbedo.h"
#include "tools/reference/SheenAlbedo.h"

namespace filament_core::reference {
namespace {

namespace lib = shader::lib64;

constexpr double kCosines[] = { 0.1, 0.5, 0.9 };

SurfaceSample coated(SurfaceSample surface, double strength, double roughness) {
    surface.coat = { strength, lib::clampPerceptualRoughness(roughness), kNormal, surface.f0 };
    surface.f0 = f0BelowCoat(surface.f0, strength);
    surface.f90 = f90Of(surface.f0);
    return surface;
}

SurfaceSample fuzzy(SurfaceSample surface, double3 color, double roughness) {
    surface.sheen = { color, roughness };
    return surface;
}

SurfaceSample stretched(SurfaceSample surface, double2 alpha, double3 localTangent) {
    surface.stretchedAlpha = alpha;
    surface.tangent = inFrame(localTangent);
    return surface;
}

SurfaceSample clothOf(SurfaceSample surface, double3 sheenColor, std::optional<double3> subsurfaceColor) {
    surface.cloth = { true, sheenColor, subsurfaceColor };
    return surface;
}

/// For a dielectric of this index that transmits all of its light.
SurfaceSample glass(double roughness, double3 view, double ior, bool isThin, bool isFromInside = false) {
    SurfaceSample surface = surfaceOf(roughness, 0, double3(0), view);
    surface.f0 = double3(lib::f0FromIor(ior));
    surface.f90 = lib::saturate(lib::dot(surface.f0, double3(50.0 * 0.33)));
    surface.transmission = { .color = double3(1), .isThin = isThin, .isFromInside = isFromInside, .ior = ior };
    return surface;
}

struct Case {
    const char* name;
    SurfaceSample (*surface)(double3 view);
    BsdfModel model{};
    bool isReciprocal = true; ///< f(a, b) = f(b, a) without terms that depend on the view alone
};

SurfaceSample plain(double3 view) { return surfaceOf(0.5, 0.3, double3(0.8, 0.5, 0.2), view); }

constexpr BsdfModel kExact{ .coat = CoatTerm::Exact, .sheen = SheenTerm::Exact };

const Case kCases[] = {
    { "coat", [](double3 view) { return coated(plain(view), 1, 0.3); } },
    { "half a coat", [](double3 view) { return coated(plain(view), 0.5, 0.6); } },
    { "exact coat", [](double3 view) { return coated(plain(view), 1, 0.3); }, kExact },
    { "half an exact coat", [](double3 view) { return coated(plain(view), 0.5, 0.3); }, kExact },
    { "sheen", [](double3 view) { return fuzzy(plain(view), double3(0.9, 0.5, 0.1), 0.5); } },
    { "smooth sheen", [](double3 view) { return fuzzy(plain(view), double3(1), 0.25); } },
    { "exact sheen", [](double3 view) { return fuzzy(plain(view), double3(0.9, 0.5, 0.1), 0.5); }, kExact },
    { "coat on sheen", [](double3 view) { return coated(fuzzy(plain(view), double3(0.5), 0.7), 0.8, 0.3); } },
    { "exact coat on sheen", [](double3 view) { return coated(fuzzy(plain(view), double3(0.5), 0.7), 0.8, 0.3); },
      kExact },
    { "brushed",
      [](double3 view) {
          return stretched(plain(view), { 0.6, 0.15 }, { 1, 1, 0 });
      } },
    { "cloth", [](double3 view) { return clothOf(plain(view), double3(0.6), {}); } },
    { "two-tone cloth",
      [](double3 view) { return clothOf(plain(view), double3(0.6), double3(0.3, 0.1, 0)); },
      {},
      false },
    { "thin glass", [](double3 view) { return glass(0.5, view, 1.5, true); } },
    { "into glass", [](double3 view) { return glass(0.5, view, 1.5, false); }, {}, false },
    { "out of glass", [](double3 view) { return glass(0.5, view, 1.5, false, true); }, {}, false },
    { "leaf",
      [](double3 view) {
          SurfaceSample surface = plain(view);
          surface.diffuseTransmission.color = double3(0.2, 0.4, 0.1);
          return surface;
      },
      {},
      false },
};

TEST(Layers, TheirDensityCoversAllDirectionsAndNoMoreThanOnce) {
    for (Case const& one : kCases) {
        for (const double cosine : kCosines) {
            const Bsdf bsdf(one.surface(directionAt(cosine, 0)), one.model, false);
            const double covered = integrate(
                    cosine, [&](double3 light) { return bsdf.pdf(light); }, 500, 200);
            EXPECT_NEAR(covered + shareWithoutDirection(bsdf), 1, 8e-3) << one.name << ' ' << cosine;
        }
    }
}

TEST(Layers, SamplesFallAsTheirDensitySays) {
    for (Case const& one : kCases) {
        for (const double cosine : { 0.2, 0.8 }) {
            const Bsdf bsdf(one.surface(directionAt(cosine, 0.4)), one.model, false);
            EXPECT_LT(chiSquareDeviations(bsdf), 4) << one.name << ' ' << cosine;
        }
    }
}

TEST(Layers, TheMeanWeightOfSamplesIsTheIntegralOfTheValue) {
    for (Case const& one : kCases) {
        for (const double cosine : kCosines) {
            const Bsdf bsdf(one.surface(directionAt(cosine, 0)), one.model, false);
            const double exact = integrate(
                    cosine, [&](double3 light) { return bsdf.evaluate(light, LightSource::Ambient).x; }, 400, 200);
            double mean = 0;
            constexpr uint32_t kCount = 1u << 15;
            for (uint32_t i = 0; i < kCount; ++i) {
                const SampleStream numbers(11, i);
                const BsdfSample sample = bsdf.sample(numbers.pair(0), numbers.pair(1).x);
                if (sample.pdf == 0) continue;
                mean += bsdf.evaluate(sample.direction, LightSource::Ambient).x / sample.pdf / kCount;
            }
            EXPECT_NEAR(mean, exact, 1e-2 * std::max(exact, 0.5)) << one.name << ' ' << cosine;
        }
    }
}

TEST(Layers, ReflectTheSameInBothDirections) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> unit(0.02, 1);
    for (Case const& one : kCases) {
        if (!one.isReciprocal) continue;
        BsdfModel model = one.model;
        model.energy = EnergyTerm::SingleScatter;
        model.coupling = CouplingTerm::Never;
        for (int i = 0; i < 50; ++i) {
            const double3 a = directionAt(unit(random), 7 * unit(random)),
                          b = directionAt(unit(random), 7 * unit(random));
            const Bsdf fromA(one.surface(a), model, false), fromB(one.surface(b), model, false);
            const double3 there = fromA.evaluate(inFrame(b), LightSource::Direct) / b.z;
            const double3 back = fromB.evaluate(inFrame(a), LightSource::Direct) / a.z;
            // The series of an exact coat contains the albedo of a specular base towards the viewer.
            const double tolerance = model.coat == CoatTerm::Exact ? 2e-2 : 1e-9;
            EXPECT_LT(glm::length(there - back), tolerance * glm::length(there)) << one.name << ' ' << i;
        }
    }
}

TEST(Layers, NoneReflectsMoreThanItGets) {
    for (Case const& one : kCases) {
        if (std::string_view(one.name) == "out of glass") continue; // radiance grows where it leaves a denser medium
        for (const double cosine : kCosines) {
            BsdfModel model = one.model;
            model.coupling = CouplingTerm::Always;
            const Bsdf bsdf(one.surface(directionAt(cosine, 0)), model, false);
            const double3 albedo = integrate(
                    cosine, [&](double3 light) { return bsdf.evaluate(light, LightSource::Ambient); }, 300, 200);
            EXPECT_LE(std::max({ albedo.x, albedo.y, albedo.z }), 1 + 5e-3) << one.name << ' ' << cosine;
        }
    }
}

double albedoOf(SurfaceSample const& surface, BsdfModel const& model, double cosine) {
    const Bsdf bsdf(surface, model, false);
    return integrate(
            cosine, [&](double3 light) { return bsdf.evaluate(light, LightSource::Ambient).x; }, 400, 300);
}

SurfaceSample whitePaper(double3 view) {
    SurfaceSample surface = surfaceOf(1, 0, double3(1), view);
    surface.f0 = double3(0);
    surface.f90 = 0;
    return surface;
}

SurfaceSample blackPaper(SurfaceSample surface) {
    surface.diffuse = double3(0);
    return surface;
}

TEST(Coat, ExactOnWhitePaperReflectsAllLight) {
    for (const double cosine : { 0.3, 0.6, 0.95 }) {
        for (const double roughness : { 0.1, 0.4 }) {
            SurfaceSample surface = whitePaper(directionAt(cosine, 0));
            surface.coat = { 1, roughness, kNormal, double3(0) };
            EXPECT_NEAR(albedoOf(surface, kExact, cosine), 1, 4e-3) << cosine << ' ' << roughness;
        }
    }
}

// Only the light that the coat reflects is missing below: white paper stays white in both.
TEST(Coat, TheEnginesAttenuationOnWhitePaperKeepsAllLightOfTheSky) {
    for (const double cosine : { 0.3, 0.9 }) {
        SurfaceSample surface = whitePaper(directionAt(cosine, 0));
        surface.coat = { 1, 0.5, kNormal, double3(0) };
        const double lobe = albedoOf(blackPaper(surface), {}, cosine);
        const double below = albedoOf(surface, {}, cosine) - lobe;
        EXPECT_NEAR(below, lib::coatTransmissionFromDfg(directionalAlbedo(cosine, 0.5), 1.0), 3e-3) << cosine;
    }
}

TEST(Coat, OfALightTheLesserOfBothDirectionsCounts) {
    const double3 light = inFrame(directionAt(0.15, 2));
    SurfaceSample surface = whitePaper(directionAt(0.9, 0));
    surface.coat = { 1, 0.3, kNormal, double3(0) };
    const double lobe = Bsdf(blackPaper(surface), {}, false).evaluate(light, LightSource::Direct).x;
    const double found = Bsdf(surface, {}, false).evaluate(light, LightSource::Direct).x - lobe;
    const double passed = lib::coatTransmissionFromDfg(directionalAlbedo(0.15, 0.3), 1.0);
    EXPECT_NEAR(found, passed * 0.15 / kPiExact, 1e-6);
}

/// Light between a smooth coat and a mirror of GGX facets below it, bounce by bounce, seen from above: the light that
/// leaves.
double walkedAlbedo(double nov, double alpha, double f0Below, uint32_t count) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> unit(1e-9, 1);
    const auto coatFresnel = [](double insideCosine) {
        const double sine2 = lib::kCoatIor * lib::kCoatIor * (1 - insideCosine * insideCosine);
        return sine2 >= 1 ? 1 : lib::fresnelComplex(std::sqrt(1 - sine2), lib::kCoatIor, 0.0);
    };
    const double outer = lib::fresnelComplex(nov, lib::kCoatIor, 0.0);
    double sum = 0;
    for (uint32_t i = 0; i < count; ++i) {
        double weight = 1 - outer;
        double3 view(std::sqrt(1 - nov * nov) / lib::kCoatIor, 0, lib::refractedCosine(nov, lib::kCoatIor));
        for (int bounce = 0; bounce < 64 && weight > 1e-6; ++bounce) {
            const double3 h = sampleVisibleNormal(view, double2(alpha), { unit(random), unit(random) });
            const double voh = glm::dot(view, h);
            const double3 light = 2 * voh * h - view;
            if (light.z <= 0) break;
            // Shadowing of one bounce, height-correlated.
            const double passed = lib::visibilitySmithGgxCorrelated(view.z, light.z, alpha) * 4 * light.z * view.z /
                                  smithMasking(view, double2(alpha));
            weight *= passed * (f0Below + (1 - f0Below) * lib::pow5(1 - voh));
            const double back = coatFresnel(light.z);
            sum += weight * (1 - back);
            weight *= back;
            view = { light.x, light.y, light.z }; // mirrored by the coat: comes back at the same angle
        }
    }
    return outer + sum / count;
}

TEST(Coat, ExactIsWhatAWalkThroughBothInterfacesFinds) {
    for (const double cosine : { 0.4, 0.7, 0.95 }) {
        for (const double roughness : { 0.1, 0.5 }) {
            const double f0 = 0.6;
            SurfaceSample surface = surfaceOf(roughness, 1, double3(f0), directionAt(cosine, 0));
            surface.coat = { 1, 0.045, kNormal, double3(f0) };
            const double below = lib::f0UnderCoat(f0);
            BsdfModel model = kExact;
            model.energy = EnergyTerm::SingleScatter;
            const double walked = walkedAlbedo(cosine, roughness * roughness, below, 200'000);
            const double found = albedoOf(surface, model, cosine);
            // Light that a rough base sends beyond the critical angle returns to it; the closed form lets it leave.
            const double lacking = roughness > 0.3 ? 0.08 : 0.01;
            EXPECT_LT(found, walked * 1.01) << cosine << ' ' << roughness;
            EXPECT_GT(found, walked * (1 - lacking)) << cosine << ' ' << roughness;
        }
    }
}

TEST(Coat, OfStrengthZeroIsNotThere) {
    const SurfaceSample bare = plain(directionAt(0.6, 0)), none = coated(bare, 0, 0.3);
    const double3 light = inFrame(directionAt(0.7, 2));
    for (BsdfModel const& model : { BsdfModel{}, kExact }) {
        EXPECT_EQ(Bsdf(none, model, false).evaluate(light, LightSource::Direct),
                  Bsdf(bare, model, false).evaluate(light, LightSource::Direct));
    }
}

TEST(Coat, ItsTableIsTheIntegralOfFresnelsEquationsOverTheLobe) {
    for (const double cosine : { 0.1, 0.5, 0.9 }) {
        for (const double roughness : { 0.35, 0.8 }) {
            SurfaceSample surface = surfaceOf(1, 0, double3(0), directionAt(cosine, 0));
            surface.f0 = double3(0);
            surface.f90 = 0;
            surface.coat = { 1, roughness, kNormal, double3(0) };
            EXPECT_NEAR(albedoOf(surface, kExact, cosine), coatAlbedo(cosine, roughness), 2e-3);
        }
    }
}

TEST(Sheen, ExactOnWhitePaperReflectsAllLight) {
    for (const double cosine : { 0.15, 0.5, 0.9 }) {
        for (const double roughness : { 0.4, 0.7, 1.0 }) {
            const SurfaceSample surface = fuzzy(whitePaper(directionAt(cosine, 0)), double3(1), roughness);
            EXPECT_NEAR(albedoOf(surface, kExact, cosine), 1, 5e-3) << cosine << ' ' << roughness;
        }
    }
}

TEST(Sheen, ItsTableIsTheIntegralOfTheLobeOverLights) {
    for (const double cosine : { 0.2, 0.6, 1.0 }) {
        for (const double roughness : { 0.4, 0.8 }) {
            SurfaceSample black = whitePaper(directionAt(cosine, 0));
            black.diffuse = double3(0);
            const double found = albedoOf(fuzzy(black, double3(1), roughness), {}, cosine);
            EXPECT_NEAR(std::min(sheenAlbedo(cosine, roughness), 1.0), found, 4e-3) << cosine << ' ' << roughness;
            EXPECT_NEAR(sheenAlbedo(cosine, roughness), integrateSheenAlbedo(cosine, roughness * roughness, 256), 2e-3);
        }
    }
}

TEST(Sheen, TheEnginesScalingIsTheLibrarys) {
    const SurfaceSample base = plain(directionAt(0.5, 0)), surface = fuzzy(base, double3(0.8, 0.4, 0.2), 0.6);
    const double3 light = inFrame(directionAt(0.7, 2)), half = glm::normalize(surface.view + light);
    const double alpha = 0.36, noh = glm::dot(half, kNormal);
    const auto scaling = [&](double cosine) {
        return lib::sheenAlbedoScaling(surface.sheen.color, sheenAlbedo(cosine, 0.6));
    };
    const double3 fibres = surface.sheen.color * (lib::ndfCharlie(noh, alpha) * lib::visibilityNeubelt(0.5, 0.7) * 0.7);
    const double3 below = Bsdf(base, {}, false).evaluate(light, LightSource::Direct);
    const double3 found = Bsdf(surface, {}, false).evaluate(light, LightSource::Direct);
    EXPECT_LT(glm::distance(found, fibres + below * std::min(scaling(0.5), scaling(0.7))), 1e-9);
}

TEST(Anisotropy, WithEqualRoughnessesTheLobeIsRound) {
    const SurfaceSample round = plain(directionAt(0.4, 0));
    const SurfaceSample same = stretched(round, double2(0.25), { 0.3, 1, 0 });
    const double3 light = inFrame(directionAt(0.6, 2.5));
    const double3 a = Bsdf(round, {}, false).evaluate(light, LightSource::Direct),
                  b = Bsdf(same, {}, false).evaluate(light, LightSource::Direct);
    EXPECT_LT(glm::distance(a, b), 1e-9 * glm::length(a));
}

TEST(Anisotropy, TheHighlightIsDrawnOutAlongTheTangent) {
    const SurfaceSample surface =
            stretched(surfaceOf(0.4, 1, double3(1), directionAt(1, 0)), { 0.5, 0.05 }, { 1, 0, 0 });
    const Bsdf bsdf(surface, {}, false);
    const double along = bsdf.evaluate(inFrame(directionAt(0.9, 0)), LightSource::Direct).x;
    const double across = bsdf.evaluate(inFrame(directionAt(0.9, kPiExact / 2)), LightSource::Direct).x;
    EXPECT_GT(along, 20 * across);
}

// One side reflects F and lets 1 - F in; both sides of a clear sheet together lose nothing.
TEST(Transmission, AClearSheetReflectsAndTransmitsAllLight) {
    for (const double cosine : { 0.2, 0.6, 1.0 }) {
        for (const FresnelTerm term : { FresnelTerm::Schlick, FresnelTerm::Exact }) {
            SurfaceSample surface = glass(0.2, directionAt(cosine, 0), 1.5, true);
            const Interface both(surface, term);
            const double f = term == FresnelTerm::Schlick ? lib::fresnelSchlick(surface.f0, 1.0, cosine).x
                                                          : lib::fresnelComplex(cosine, 1.5, 0.0);
            EXPECT_NEAR(both.reflectance(cosine).x, lib::thinReflectance(double3(f)).x, 1e-12);
            EXPECT_NEAR(both.reflectance(cosine).x + both.transmittance(cosine).x, 1, 1e-12);
            surface.transmission.absorption = double3(100);
            surface.transmission.thickness = 0.01;
            const Interface dark(surface, term);
            EXPECT_LT(dark.reflectance(cosine).x + dark.transmittance(cosine).x, 0.9);
            EXPECT_GT(dark.reflectance(cosine).x, f);
        }
    }
}

TEST(Transmission, FresnelIsTheSameFromBothSidesAndTotalBeyondTheCriticalAngle) {
    const SurfaceSample outside = glass(0.2, directionAt(0.5, 0), 1.5, false);
    const SurfaceSample inside = glass(0.2, directionAt(0.5, 0), 1.5, false, true);
    for (const FresnelTerm term : { FresnelTerm::Schlick, FresnelTerm::Exact }) {
        const Interface in(outside, term), out(inside, term);
        for (const double cosine : { 0.05, 0.3, 0.7, 1.0 }) {
            EXPECT_NEAR(in.reflectance(cosine).x, out.reflectance(lib::refractedCosine(cosine, 1.5)).x, 1e-9);
        }
        EXPECT_EQ(out.reflectance(0.7).x, 1) << "sin = 0.714 > 1 / 1.5";
    }
}

// f(v, l) / n_v^2 = f(l, v) / n_l^2: the path is reversible, with radiance scaled by the square of the index.
TEST(Transmission, LightTakesTheSameWayBackThroughAnInterface) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0.1, 1);
    const double ior = 1.5;
    int compared = 0;
    for (int i = 0; i < 200; ++i) {
        const double3 above = directionAt(unit(random), 7 * unit(random));
        const double3 straight(-above.x / ior, -above.y / ior, -lib::refractedCosine(above.z, ior));
        const double3 below = glm::normalize(straight + 0.2 * (double3(unit(random), unit(random), 0) - 0.5));
        const Bsdf in(glass(0.6, above, ior, false), {}, false);
        // From inside, the normal points the other way: rotate the world about the surface.
        SurfaceSample inside = glass(0.6, above, ior, false, true);
        inside.normal = inside.geometricNormal = -kNormal;
        inside.view = inFrame(below);
        const Bsdf out(inside, {}, false);
        const double there = in.evaluate(inFrame(below), LightSource::Direct).x / -below.z;
        const double back = out.evaluate(inFrame(above), LightSource::Direct).x / above.z;
        if (there == 0 && back == 0) continue;
        ++compared;
        EXPECT_NEAR(there, back / (ior * ior), 1e-9 * there + 1e-12) << i;
    }
    EXPECT_GT(compared, 100);
}

TEST(Transmission, WithoutAChangeOfIndexLightGoesStraightOn) {
    const Bsdf bsdf(glass(0.5, directionAt(0.6, 0), 1, false), {}, false);
    EXPECT_EQ(bsdf.straightShare(), double3(1));
    const BsdfSample sample = bsdf.sample({ 0.3, 0.4 }, 0.5);
    EXPECT_TRUE(sample.isStraight);
    EXPECT_EQ(bsdf.evaluate(inFrame(directionAt(-0.6, kPiExact)), LightSource::Ambient), double3(0));
}

TEST(Cloth, ReachesAroundTheEdgeOnlyWithASubsurfaceColour) {
    const double3 behind = inFrame(directionAt(-0.2, 2));
    const SurfaceSample base = plain(directionAt(0.6, 0));
    EXPECT_EQ(Bsdf(clothOf(base, double3(0.5), {}), {}, false).evaluate(behind, LightSource::Direct), double3(0));
    const double3 color(0.3, 0.2, 0.1);
    const double3 found = Bsdf(clothOf(base, double3(0.5), color), {}, false).evaluate(behind, LightSource::Direct);
    const double3 expected = base.diffuse * color * (0.3 / 2.25 / kPiExact);
    EXPECT_LT(glm::distance(found, expected), 1e-9);
}

} // namespace
} // namespace filament_core::reference
