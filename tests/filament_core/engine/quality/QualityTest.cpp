// SPDX-License-Identifier: Apache-2.0
// Quality choices of the shading as images: each value draws the same bits on both APIs, and matches its formula.
// The formulas are the shader library compiled as C++ (shaders/lib/LibCpp.h), which has its own tests.
#include "base/math/Rgbm.h"
#include "base/math/SharedExponent.h"
#include "filament_core/assets/tables/DfgTable.h"
#include "tests/filament_core/engine/quality/QualityFixture.h"

#include "shaders/lib/LibCpp.h"

#include <algorithm>

namespace filament_core {
namespace {

namespace lib = shader::lib;
using test::Patch;

constexpr double kViewDegrees = 60;
constexpr float kRoughness = 0.5f;
const float3 kTowardsSun = glm::normalize(float3(-0.6f, 0.3f, 0.5f));

/// Cosines at the centre of a patch seen from kViewDegrees.
struct Angles {
    float nov, nol, noh, voh;
};

Angles angles() {
    const float3 v(std::sin(glm::radians(60.0f)), 0, std::cos(glm::radians(60.0f)));
    const float3 h = glm::normalize(v + kTowardsSun);
    return { v.z, kTowardsSun.z, h.z, glm::dot(v, h) };
}

/// The share of light that the specular lobe leaves to the diffuse one after one bounce.
float3 coupling(float3 f0) {
    const float alpha = lib::alphaFromPerceptual(kRoughness);
    const auto albedo = [&](float cosine) { return lib::specularDfg(f0, 1, assets::integrateDfg(cosine, alpha)); };
    const float3 average = lib::specularDfg(f0, 1, lib::dfgAverage(alpha));
    return lib::diffuseEntry(albedo(angles().nol)) * lib::diffuseExit(albedo(angles().nov), average);
}

/// Radiance of the patch under the sun of Patch::addSun(), without energy compensation.
float3 sunlit(float3 color, float metallic, float visibility, float3 fresnel, float diffuse) {
    const Angles at = angles();
    const float d = lib::ndfGgx(at.noh, lib::alphaFromPerceptual(kRoughness));
    const float3 specular = d * visibility * fresnel;
    const float3 scattered =
            lib::diffuseColor(color, metallic) * coupling(lib::f0FromBaseColor(color, metallic, 0.5f)) * diffuse;
    return (scattered + specular) * std::numbers::pi_v<float> * at.nol;
}

float3 schlick(float3 color, float metallic) {
    return lib::fresnelSchlick(lib::f0FromBaseColor(color, metallic, 0.5f), 1, angles().voh);
}

float correlated() {
    return lib::visibilitySmithGgxCorrelated(angles().nov, angles().nol, lib::alphaFromPerceptual(kRoughness));
}

void expectNear(float3 actual, float3 expected) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(actual[c], expected[c], 0.003f * expected[c] + 0.0005f) << "component " << c;
}

class QualityTest : public testing::TestWithParam<Backend> {
protected:
    /// The centre of a sunlit patch under `quality`, without energy compensation.
    float3 sunlitPatch(float4 color, float metallic, Quality quality) {
        auto engine = test::makeEngine(GetParam());
        if (!engine) return {};
        Patch patch(*engine, kViewDegrees);
        patch.setSurface(color, metallic, kRoughness);
        patch.addSun(kTowardsSun);
        quality.energyCompensation = false;
        patch.view.quality = quality;
        const float3 center = patch.renderCenter();
        test::expectNoErrors(*engine);
        return center;
    }

    static constexpr float4 kCopper{ 0.95f, 0.64f, 0.54f, 1 };
};

TEST_P(QualityTest, EachVisibilityTermDrawsItsFormula) {
    const std::pair<SpecularVisibility, float (*)(float, float, float)> terms[] = {
        { SpecularVisibility::Correlated, lib::visibilitySmithGgxCorrelated },
        { SpecularVisibility::Fast, lib::visibilitySmithGgxCorrelatedFast },
        { SpecularVisibility::Uncorrelated, lib::visibilitySmithGgxUncorrelated },
    };
    const Angles at = angles();
    for (auto const& [choice, formula] : terms) {
        SCOPED_TRACE(toString(choice));
        const float visibility = formula(at.nov, at.nol, lib::alphaFromPerceptual(kRoughness));
        expectNear(sunlitPatch(kCopper, 1, { .specularVisibility = choice }),
                   sunlit(float3(kCopper), 1, visibility, schlick(float3(kCopper), 1), 0));
    }
}

TEST_P(QualityTest, TheExactFresnelTermIsThatOfMetalsAndDielectrics) {
    const float3 color(0.95f, 0.64f, 0.54f);
    for (const float metallic : { 0.0f, 1.0f }) {
        SCOPED_TRACE(metallic);
        const float3 f0 = lib::f0FromBaseColor(color, metallic, 0.5f);
        const float3 exact = lib::fresnelExact(f0, metallic, angles().voh);
        expectNear(sunlitPatch(kCopper, metallic, { .fresnel = FresnelTerm::Exact }),
                   sunlit(color, metallic, correlated(), exact, lib::diffuseLambert()));
    }
}

TEST_P(QualityTest, DisneysDiffuseLobeIsBurleys) {
    const Angles at = angles();
    const float diffuse = lib::diffuseDisney(at.nov, at.nol, at.voh, kRoughness);
    const float3 color(kCopper);
    expectNear(sunlitPatch(kCopper, 0, { .diffuse = DiffuseTerm::Disney }),
               sunlit(color, 0, correlated(), schlick(color, 0), diffuse));
}

TEST_P(QualityTest, WithoutCouplingTheDiffuseLobeGetsWhatIsReflectedAsWell) {
    const float4 chalk(0.5f, 0.5f, 0.5f, 1);
    const float3 coupled = sunlitPatch(chalk, 0, {}), whole = sunlitPatch(chalk, 0, { .diffuseCoupling = false });
    const float missing = 1 - coupling(float3(0.04f)).x;
    EXPECT_GT(missing, 0.02f);
    expectNear(whole - coupled,
               float3(0.5f * lib::diffuseLambert() * missing * std::numbers::pi_v<float> * angles().nol));
}

// 16 bits keep 11 binary digits; the terms of the sum have similar sizes, so the error is a few roundings.
TEST_P(QualityTest, HalfPrecisionShadesTheSameLightToAPercentDownToTheRoughnessThatItHolds) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    const float3 mirror = glm::normalize(float3(-std::sin(glm::radians(60.0f)), 0, std::cos(glm::radians(60.0f))));
    int differing = 0;
    for (const float roughness : { 0.1f, 0.25f, 0.5f, 1.0f }) {
        for (const float metallic : { 0.0f, 1.0f }) {
            Patch patch(*engine, kViewDegrees);
            patch.setSurface(kCopper, metallic, roughness);
            patch.addSun(mirror); // the peak of the lobe
            patch.addEnvironment({ float4(0.5f), float4(0.1f), float4(0.2f) });
            const float3 full = patch.renderCenter();
            patch.view.quality.shadingPrecision = ShadingPrecision::Half;
            const float3 half = patch.renderCenter();
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(half[c], full[c], 0.015f * full[c])
                        << "roughness " << roughness << ", metallic " << metallic;
            differing += half != full;
        }
    }
    EXPECT_GT(differing, 2) << "else it was not half precision";
    test::expectNoErrors(*engine);
}

// In an environment of radiance 1, a white metal reflects the table's second entry, or everything with compensation.
TEST_P(QualityTest, WithoutEnergyCompensationARoughWhiteMetalLosesWhatTheTableSays) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    Patch patch(*engine);
    patch.setSurface(float4(1), 1, 1);
    patch.addEnvironment({ float4(1) }, 1);
    EXPECT_NEAR(patch.renderCenter().x, 1.0f, 0.002f);
    patch.view.quality.energyCompensation = false;
    const float lastTexel = 1 - 0.5f / 64; // the table is clamped to its edge
    EXPECT_NEAR(patch.renderCenter().x, assets::integrateDfg(lastTexel, lastTexel * lastTexel).y, 0.002f);
    test::expectNoErrors(*engine);
}

TEST_P(QualityTest, TheAnalyticSplitSumIsKarissFitAndTableSizesAgreeToTheirTexels) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    Patch patch(*engine, kViewDegrees);
    patch.setSurface(float4(1), 1, kRoughness);
    patch.addEnvironment({ float4(1) }, 1);
    patch.view.quality.energyCompensation = false;
    patch.view.quality.splitSum = SplitSum::Analytic;
    EXPECT_NEAR(patch.renderCenter().x, lib::dfgAnalytic(0.5f, kRoughness).y, 0.002f);
    patch.view.quality.splitSum = SplitSum::Table;
    const float exact = assets::integrateDfg(0.5f, kRoughness * kRoughness).y;
    for (const uint16_t size : { uint16_t{ 16 }, uint16_t{ 64 }, uint16_t{ 256 } }) {
        patch.view.quality.dfgTableSize = size;
        EXPECT_NEAR(patch.renderCenter().x, exact, 0.02f) << "table of " << size;
    }
    test::expectNoErrors(*engine);
}

TEST_P(QualityTest, EachBandAddsItsTermsToTheDiffuseLight) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    Patch patch(*engine);
    patch.setSurface(float4(1, 1, 1, 1), 0, 1);
    std::array<float4, 9> sh{ float4(1) };
    sh[2] = float4(0.5f);   // n.z = 1: adds 0.5
    sh[6] = float4(0.125f); // 3 n.z^2 - 1 = 2: adds 0.25
    patch.addEnvironment(sh);
    patch.view.quality.diffuseIrradiance = DiffuseIrradiance::SphericalHarmonics;
    std::array<float, 3> radiance{};
    for (uint8_t bands = 1; bands <= 3; ++bands) {
        patch.view.quality.shBands = bands;
        radiance[bands - 1u] = patch.renderCenter().x;
    }
    const float perUnit = (radiance[1] - radiance[0]) / 0.5f; // contribution of irradiance 1
    EXPECT_NEAR(radiance[2] - radiance[1], 0.25f * perUnit, 0.003f);
    EXPECT_GT(perUnit, 0.9f);
    patch.view.quality.diffuseIrradiance = DiffuseIrradiance::LastSpecularLevel;
    EXPECT_NEAR(patch.renderCenter().x - radiance[0], (3.0f - 1.0f) * perUnit, 0.006f) << "level 2 holds radiance 3";
    test::expectNoErrors(*engine);
}

// A white metal shows the radiance of its level; Patch::addEnvironment() numbers the levels from 1.
TEST_P(QualityTest, EachRoughnessMappingReadsTheLevelThatItsFormulaSays) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    const auto levelRead = [&](RoughnessMapping mapping, float roughness) {
        Patch patch(*engine);
        patch.setSurface(float4(1), 1, roughness);
        patch.addEnvironment({}, 5, mapping);
        return patch.renderCenter().x - 1;
    };
    for (const float r : { 0.3f, 0.5f, 0.7f, 1.0f }) {
        EXPECT_NEAR(levelRead(RoughnessMapping::Quadratic, r), 4 * r * (2 - r), 0.02f) << r;
        EXPECT_NEAR(levelRead(RoughnessMapping::Logarithmic, r), 4 + std::log2(r * r), 0.02f) << r;
        EXPECT_NEAR(levelRead(RoughnessMapping::Linear, r), 4 * r, 0.02f) << r;
    }
    EXPECT_NEAR(levelRead(RoughnessMapping::Logarithmic, 0.2f), 0, 0.02f) << "alpha below 2^-4 is the mirror";
    test::expectNoErrors(*engine);
}

Owned<Texture> halfCube(Engine& engine, float3 radiance) {
    std::vector<uint16_t> texels;
    for (int face = 0; face < 6; ++face) {
        for (const float value : { radiance.x, radiance.y, radiance.z, 1.0f }) texels.push_back(halfFromFloat(value));
    }
    return engine.own(engine.create(TextureDesc{ .kind = TextureKind::Cube,
                                                 .format = Format::RGBA16F,
                                                 .layers = 6,
                                                 .pixels = std::as_bytes(std::span(texels)) }));
}

TEST_P(QualityTest, TheIrradianceCubeTakesThePlaceOfTheCoefficientsWhereThereIsOne) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    const auto shown = [&](std::array<float4, 9> const& sh, Texture cube, DiffuseIrradiance choice) {
        Patch patch(*engine);
        patch.setSurface(float4(1), 0, 1);
        patch.addEnvironment(sh, 3, RoughnessMapping::Quadratic, cube);
        patch.view.quality.diffuseIrradiance = choice;
        return patch.renderCenter();
    };
    const float3 light(0.5f, 1, 2);
    const Owned<Texture> cube = halfCube(*engine, light);
    const float3 fromCube = shown({}, cube, DiffuseIrradiance::Cube);
    expectNear(fromCube, shown({ float4(light, 0) }, cube, DiffuseIrradiance::SphericalHarmonics));
    EXPECT_NE(fromCube, shown({}, cube, DiffuseIrradiance::SphericalHarmonics));
    EXPECT_EQ(shown({ float4(light, 0) }, {}, DiffuseIrradiance::Cube),
              shown({ float4(light, 0) }, {}, DiffuseIrradiance::SphericalHarmonics))
            << "without a cube the coefficients serve";
    test::expectNoErrors(*engine);
}

TEST_P(QualityTest, ASkyInRgbmIsDecoded) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    const float3 light(3, 0.5f, 0.04f);
    const std::vector<uint32_t> texels(6, packRgbm(light));
    const Owned<Texture> cube = engine->own(engine->create(
            TextureDesc{ .kind = TextureKind::Cube, .layers = 6, .pixels = std::as_bytes(std::span(texels)) }));
    const Owned<Skybox> sky = engine->own(engine->create(SkyboxDesc{ .cube = cube }));
    Scene scene(*engine);
    View view{ .size = { 4, 4 } };
    scene.setSkybox(sky, Lux{ 1 / view.camera.exposure.factor() });
    expectNear(float3(test::halfPixel(test::renderLinear(*engine, scene, view), 2, 2)), unpackRgbm(texels[0]));
    test::expectNoErrors(*engine);
}

// Radiance 1 is radiance 1 in the image, in every format of an environment.
TEST_P(QualityTest, EnvironmentsOfEveryFormatAreSampledAsWhatTheyHold) {
    auto engine = test::makeEngine(GetParam());
    ASSERT_TRUE(engine);
    const float3 radiance(1.5f, 0.5f, 0.25f);
    const std::tuple<Format, uint32_t, float3> formats[] = {
        { Format::R11G11B10F, packR11G11B10F(radiance), radiance },
        { Format::RGB9E5, packRgb9E5(radiance), radiance },
        { Format::RGBA8, packRgbm(radiance), unpackRgbm(packRgbm(radiance)) },
    };
    for (auto const& [format, texel, held] : formats) {
        Patch patch(*engine);
        const std::array<uint32_t, 6> texels{ texel, texel, texel, texel, texel, texel };
        const Owned<Texture> cube =
                engine->own(engine->create(TextureDesc{ .kind = TextureKind::Cube,
                                                        .format = format,
                                                        .layers = 6,
                                                        .pixels = std::as_bytes(std::span(texels)) }));
        const Owned<IndirectLight> light = engine->own(engine->create(IndirectLightDesc{ .specular = cube }));
        patch.scene.setIndirectLight(light, Lux{ 1 / patch.view.camera.exposure.factor() });
        patch.setSurface(float4(1), 1, 0.3f);
        expectNear(patch.renderCenter(), held);
    }
    test::expectNoErrors(*engine);
}

INSTANTIATE_TEST_SUITE_P(BothApis, QualityTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

std::vector<Image> renderEveryValue(Backend backend) {
    std::vector<Image> images;
    auto engine = test::makeEngine(backend);
    if (!engine) return images;
    Patch patch(*engine, kViewDegrees);
    patch.setSurface({ 0.9f, 0.5f, 0.3f, 1 }, 0.5f, kRoughness);
    patch.addSun(kTowardsSun);
    const Owned<Texture> irradiance = halfCube(*engine, { 0.6f, 0.5f, 0.4f });
    patch.addEnvironment({ float4(0.5f), float4(0.1f), float4(0.2f), float4(0.05f), float4(0.04f), float4(0.03f),
                           float4(0.02f), float4(0.01f), float4(0.03f) },
                         3, RoughnessMapping::Quadratic, irradiance);
    for (Option const& choice : optionsOf<Quality>()) {
        for (const std::string_view value : choice.values) {
            patch.view.quality = {};
            if (choice.name == "shBands") patch.view.quality.diffuseIrradiance = DiffuseIrradiance::SphericalHarmonics;
            EXPECT_TRUE(setOption(patch.view.quality, choice.name, value));
            images.push_back(patch.render());
        }
    }
    test::expectNoErrors(*engine);
    return images;
}

/// Choices without effect on a flat, untextured patch that faces the camera: QualityViewTest.cpp, QualityToneTest.cpp,
/// AntiAliasingTest.cpp, ResolutionTest.cpp and the conformance scenes quality, shadows, area-lights, materials-sheen,
/// ambient-occlusion, contact-shadows, refraction, transparency, reflections and reflection-probes have images for
/// them.
bool isOfTheView(std::string_view name) {
    if (name.starts_with("refraction") || name.starts_with("transparency") || name == "depthPrepass" ||
        name == "antiAliasing" || name == "msaaResolve" || name == "mipBias")
        return true;
    return name == "textureFilter" || name == "reflectionProbes" || name == "depthRange" || name == "cameraRelative" ||
           name == "toneMapping" || name == "specularLookUps" || name == "anisotropicLookUps" || name == "areaLights" ||
           name == "areaShadows" || name == "coloredShadows" || name.starts_with("shadow");
}

/// Drivers may round half floats differently: a difference of one step at most, not the same bits.
bool isRoundedByTheDriver(std::string_view name, std::string_view value) {
    return name == "shadingPrecision" && value == "half";
}

void expectNearly(Image const& a, Image const& b) {
    ASSERT_EQ(a.pixels.size(), b.pixels.size());
    for (uint32_t y = 0; y < a.height; ++y) {
        for (uint32_t x = 0; x < a.width; ++x)
            EXPECT_LT(glm::distance(test::halfPixel(a, x, y), test::halfPixel(b, x, y)), 0.01f) << x << ", " << y;
    }
}

TEST(QualityBits, EveryValueOfEveryChoiceDrawsTheSameBitsOnBothApisAndAPictureOfItsOwn) {
    const std::vector<Image> vulkan = renderEveryValue(Backend::Vulkan), gles = renderEveryValue(Backend::Gles);
    ASSERT_EQ(vulkan.size(), gles.size());
    size_t at = 0;
    for (Option const& choice : optionsOf<Quality>()) {
        std::vector<std::vector<std::byte>> different;
        for (const std::string_view value : choice.values) {
            if (isRoundedByTheDriver(choice.name, value))
                expectNearly(vulkan[at], gles[at]);
            else
                EXPECT_EQ(vulkan[at].pixels, gles[at].pixels) << choice.name << '=' << value;
            if (std::ranges::find(different, vulkan[at].pixels) == different.end())
                different.push_back(vulkan[at].pixels);
            ++at;
        }
        if (isOfTheView(choice.name)) continue;
        EXPECT_EQ(different.size(), choice.values.size()) << choice.name << ": two values draw the same picture";
    }
}

} // namespace
} // namespace filament_core
