// SPDX-License-Identifier: Apache-2.0
// What lies above, below and behind the base, on both devices: the same bits, and what the formulas say in closed form.
#include "shaders/lib/LibCpp.h"
#include "tests/shaders/exact/MaterialRig.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace filament::shader {
namespace {

using test::MaterialRig;
using test::MaterialScene;

/// One colour channel of the pixels that the object covers.
using Pixels = std::vector<float>;

class LayerBits : public ::testing::Test {
protected:
    struct Rigs {
        std::unique_ptr<MaterialRig> vulkan = MaterialRig::make(backend::BackendType::Vulkan);
        std::unique_ptr<MaterialRig> gles = MaterialRig::make(backend::BackendType::Gles);
    };

    static Rigs& rigs() {
        static auto* const made = new Rigs; // ends with the process: drivers do not like static destruction
        return *made;
    }

    void SetUp() override {
        if (!rigs().vulkan || !rigs().gles) GTEST_SKIP() << "needs a Vulkan and an OpenGL ES device";
    }

    /// `code` runs behind prepareMaterial(), `before` ahead of it; `amount` is the parameter materialParams.amount.
    static MaterialScene scene(std::string const& code, float amount = 1, std::string const& properties = "",
                               std::string const& before = "") {
        MaterialScene scene;
        scene.source = "material { parameters : [ { name : amount, type : float } ],\n" + properties +
                       " }\nfragment { void material(inout MaterialInputs m) {\n" + before + "\nprepareMaterial(m);\n" +
                       "float amount = materialParams.amount;\n" + code + "\n} }";
        scene.parameters = { { "amount", { amount } } };
        scene.frame.exposure.x = 1;
        return scene;
    }

    /// White light from everywhere.
    static MaterialScene furnace(MaterialScene scene) {
        scene.frame.ambient = { 1, 0, 3, 0 };
        scene.frame.irradianceSh[0] = { 1, 1, 1, 0 };
        return scene;
    }

    /// A sun, and lights around the surface of which one grazes it.
    static MaterialScene lights(MaterialScene scene) {
        scene.variant = kVariantSun | kVariantPunctual;
        scene.frame.sunDirection = { 0.36f, 0.48f, 0.8f, 1 };
        scene.frame.sunIlluminance = { 3, 2.5f, 2, 0 };
        scene.lights = {
            { { 0.5f, 0.4f, -1.2f, 0.04f }, { 2, 1, 0.5f, 0 }, { 0, 0, -1, 0 }, {} },
            { { -0.6f, -0.4f, -1.0f, 0 }, { 0.5f, 2, 1, 1 }, { 0.3f, 0.2f, -0.93f, 4 }, { -3, 0, 0, 0 } },
            { { 1.5f, 0.1f, -1.95f, 0 }, { 1, 1, 1, 0 }, { 0, 0, -1, 0 }, {} },
        };
        return scene;
    }

    /// Renders on both, expects finite values and, but for variants in 16 bits, equal bits. Returns one channel of what
    /// is covered.
    static Pixels render(MaterialScene const& scene, size_t channel = 0) {
        const Result<std::vector<float>> vulkan = rigs().vulkan->render(scene), gles = rigs().gles->render(scene);
        EXPECT_TRUE(vulkan) << (vulkan ? "" : vulkan.error().message) << scene.source;
        EXPECT_TRUE(gles) << (gles ? "" : gles.error().message) << scene.source;
        if (!vulkan || !gles) return {};
        const bool mustAgree = (scene.variant & kVariantHalf) == 0; // each driver rounds to 16 bits where it likes
        const bool agree = std::memcmp(vulkan->data(), gles->data(), vulkan->size() * sizeof(float)) == 0;
        EXPECT_TRUE(agree || !mustAgree) << "the APIs differ:\n" << scene.source;
        for (auto const* picture : { &*vulkan, &*gles }) {
            EXPECT_TRUE(std::ranges::all_of(*picture, [](float value) { return std::isfinite(value); }))
                    << scene.source;
        }
        Pixels pixels;
        for (size_t i = 0; i < vulkan->size(); i += 4) {
            if ((*vulkan)[i + 3] != 0.0f) pixels.push_back((*vulkan)[i + channel]);
        }
        EXPECT_GT(pixels.size(), 3000u);
        return pixels;
    }

    static double mean(Pixels const& pixels) {
        double sum = 0;
        for (const float value : pixels) sum += static_cast<double>(value);
        return sum / static_cast<double>(std::max<size_t>(pixels.size(), 1));
    }
    static float most(Pixels const& pixels) { return pixels.empty() ? 0 : std::ranges::max(pixels); }
    static float least(Pixels const& pixels) { return pixels.empty() ? 0 : std::ranges::min(pixels); }

    /// The largest difference.
    static float distance(Pixels const& a, Pixels const& b) {
        EXPECT_EQ(a.size(), b.size());
        float largest = 0;
        for (size_t i = 0; i < std::min(a.size(), b.size()); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
        return largest;
    }
};

constexpr const char* kBlack = "m.baseColor.rgb = vec3(0.0);";

// ------------------------------------------------------------------------------------------------ clear coat

TEST_F(LayerBits, AWhiteBaseUnderACoatSendsBackAllThatArrives) {
    for (const char* base : { "m.metallic = 1.0; m.roughness = 0.4;", "m.roughness = 0.7;" }) {
        for (const char* coat : { "m.clearCoatRoughness = 0.0;", "m.clearCoatRoughness = 0.6;" }) {
            const Pixels picture = render(furnace(
                    scene(std::string(base) + coat + "m.clearCoat = amount;", 1, "clearCoatIorChange : false")));
            EXPECT_GT(least(picture), 0.97f) << base << coat;
            EXPECT_LT(most(picture), 1.005f) << base << coat;
        }
    }
}

TEST_F(LayerBits, TheCoatAboveABlackBaseIsProportionalToItsStrength) {
    const std::string code = std::string(kBlack) + "m.reflectance = 0.0; m.specularFactor = 0.0; m.clearCoat = amount;"
                                                   "m.clearCoatRoughness = 0.3;";
    for (const bool lit : { false, true }) {
        const auto at = [&](float amount) {
            return render(lit ? lights(scene(code, amount)) : furnace(scene(code, amount)));
        };
        const Pixels none = at(0), half = at(0.5f), all = at(1);
        ASSERT_FALSE(all.empty());
        EXPECT_EQ(most(none), 0);
        EXPECT_GT(mean(all), 0.02);
        for (size_t i = 0; i < all.size(); ++i) ASSERT_NEAR(half[i], 0.5f * all[i], 1e-5f * (1 + all[i])) << i;
    }
}

TEST_F(LayerBits, APlasticBaseVanishesInACoatOfItsOwnIndexUnlessTheChangeIsSwitchedOff) {
    const std::string coat =
            std::string(kBlack) + "m.clearCoat = amount; m.clearCoatRoughness = 0.3; m.roughness = 0.5;";
    const Pixels matt = render(furnace(scene(coat + "m.specularFactor = 0.0;")));
    const Pixels plastic = render(furnace(scene(coat)));
    const Pixels unchanged = render(furnace(scene(coat, 1, "clearCoatIorChange : false")));
    ASSERT_FALSE(plastic.empty());
    EXPECT_LT(distance(plastic, matt), 1e-5f);
    EXPECT_GT(mean(unchanged), mean(plastic) + 0.03);
}

TEST_F(LayerBits, TheCoatKeepsTheNormalOfTheGeometryUnlessItHasItsOwn) {
    const std::string code = std::string(kBlack) + "m.specularFactor = 0.0; m.clearCoat = amount; "
                                                   "m.clearCoatRoughness = 0.3;";
    const char* const bumps = "m.normal = normalize(vec3(0.3, -0.2, 0.8));";
    const Pixels flat = render(lights(scene(code)));
    const Pixels bumped = render(lights(scene(code, 1, "", bumps)));
    const Pixels coatBumped =
            render(lights(scene(code, 1, "", "m.clearCoatNormal = normalize(vec3(0.3, -0.2, 0.8));")));
    const Pixels bothBumped = render(
            lights(scene(code, 1, "", std::string(bumps) + "m.clearCoatNormal = normalize(vec3(0.3, -0.2, 0.8));")));
    EXPECT_LT(distance(flat, bumped), 1e-5f);
    EXPECT_GT(distance(flat, coatBumped), 0.05f);
    EXPECT_LT(distance(coatBumped, bothBumped), 1e-5f);
}

// ------------------------------------------------------------------------------------------------ anisotropy

TEST_F(LayerBits, NegativeAnisotropyIsPositiveAcross) {
    const std::string metal = "m.metallic = 1.0; m.roughness = 0.5; m.anisotropy = amount;";
    for (const bool lit : { false, true }) {
        const auto at = [&](std::string const& direction, float amount) {
            const MaterialScene made = scene(metal + direction, amount);
            return render(lit ? lights(made) : furnace(made));
        };
        const Pixels along = at("m.anisotropyDirection = vec3(1.0, 0.0, 0.0);", 0.8f);
        const Pixels across = at("m.anisotropyDirection = vec3(0.0, 1.0, 0.0);", -0.8f);
        ASSERT_FALSE(along.empty());
        EXPECT_LT(distance(along, across), 2e-3f * most(along));
        if (!lit) continue;
        EXPECT_GT(distance(along, at("m.anisotropyDirection = vec3(1.0, 0.0, 0.0);", -0.8f)), 0.05f);
        EXPECT_GT(distance(along, at("m.anisotropyDirection = vec3(0.7, 0.7, 0.0);", 0.8f)), 0.05f);
    }
}

TEST_F(LayerBits, AnisotropyOfZeroIsNone) {
    const std::string metal = "m.metallic = 1.0; m.roughness = 0.5;";
    EXPECT_EQ(distance(render(lights(furnace(scene(metal)))),
                       render(lights(furnace(scene(metal + "m.anisotropy = amount;", 0))))),
              0);
}

// ------------------------------------------------------------------------------------------------ sheen

TEST_F(LayerBits, AWhiteSheenAboveAWhiteBaseGainsNothingAndLosesLittle) {
    for (const char* roughness : { "0.1", "0.4", "1.0" }) {
        const Pixels picture = render(furnace(scene("m.roughness = 0.8; m.sheenColor = vec3(amount);"
                                                    "m.sheenRoughness = " +
                                                    std::string(roughness) + ";")));
        EXPECT_LT(most(picture), 1.005f) << roughness;
        EXPECT_GT(least(picture), 0.97f) << roughness;
    }
}

TEST_F(LayerBits, SheenAboveBlackIsBrightestWhereTheViewGrazesAndFollowsItsColor) {
    const std::string code = std::string(kBlack) + "m.specularFactor = 0.0; m.sheenRoughness = 0.5; ";
    for (const bool lit : { false, true }) {
        const auto at = [&](std::string const& color, size_t channel) {
            const MaterialScene made = scene(code + "m.sheenColor = " + color + ";");
            return render(lit ? lights(made) : furnace(made), channel);
        };
        const Pixels full = at("vec3(1.0, 0.5, 0.0) * amount", 0), blue = at("vec3(1.0, 0.5, 0.0) * amount", 2);
        const Pixels half = at("vec3(0.5, 0.5, 0.0) * amount", 0);
        ASSERT_FALSE(full.empty());
        EXPECT_EQ(most(blue), 0);
        EXPECT_GT(most(full), 1.5f * least(full));
        for (size_t i = 0; i < full.size(); ++i) ASSERT_NEAR(half[i], 0.5f * full[i], 1e-5f * (1 + full[i])) << i;
    }
}

// ------------------------------------------------------------------------------------------------ specular weights

TEST_F(LayerBits, WithoutSpecularWeightOnlyLambertIsLeft) {
    const Pixels furnaced = render(furnace(scene("m.specularFactor = 1.0 - amount; m.roughness = 0.3;")));
    EXPECT_LT(distance(furnaced, Pixels(furnaced.size(), 1.0f)), 1e-6f);
    MaterialScene sun = scene("m.specularFactor = 1.0 - amount; m.roughness = 0.3;", 1);
    sun.variant = kVariantSun;
    sun.frame.sunDirection = { 0, 0, 1, 1 };
    sun.frame.sunIlluminance = { 2, 2, 2, 0 };
    const Pixels lit = render(sun);
    EXPECT_LE(most(lit), 2.0f / 3.14159265f + 1e-5f);
    EXPECT_GT(most(lit), 1.98f / 3.14159265f);
}

TEST_F(LayerBits, SpecularColorTintsDielectricsAndLeavesMetalsAlone) {
    const std::string dark = std::string(kBlack) + "m.roughness = 0.6; m.specularColorFactor = vec3(2.0, 1.0, 0.0) * "
                                                   "amount;";
    const Pixels red = render(furnace(scene(dark)), 0), green = render(furnace(scene(dark)), 1),
                 blue = render(furnace(scene(dark)), 2);
    const Pixels plain = render(furnace(scene(std::string(kBlack) + "m.roughness = 0.6;")), 1);
    EXPECT_LT(distance(green, plain), 1e-6f);
    EXPECT_GT(mean(red), mean(green) + 0.02);
    EXPECT_GT(mean(green), mean(blue) + 0.02);
    const std::string metal = "m.metallic = 1.0; m.roughness = 0.4; ";
    const Pixels bare = render(lights(furnace(scene(metal))));
    const Pixels tinted = render(lights(furnace(scene(metal + "m.specularColorFactor = vec3(0.2) * amount;"))));
    EXPECT_LT(distance(bare, tinted), 1e-6f * most(bare));
}

// ------------------------------------------------------------------------------------------------ iridescence

TEST_F(LayerBits, AFilmColorsAMetalAndGainsNothing) {
    const std::string metal = "m.baseColor.rgb = vec3(0.5); m.metallic = 1.0; m.roughness = 0.2; m.iridescence = 1.0; "
                              "m.iridescenceThickness = amount; m.iridescenceIor = 1.8;";
    const Pixels red = render(furnace(scene(metal, 350)), 0), blue = render(furnace(scene(metal, 350)), 2);
    EXPECT_GT(distance(red, blue), 0.1f);
    EXPECT_LT(std::max(most(red), most(blue)), 1.005f);
    EXPECT_GT(distance(render(lights(scene(metal, 350)), 0), render(lights(scene(metal, 520)), 0)), 0.02f);
}

TEST_F(LayerBits, AFilmBelowACoatOfAGreaterIndexReflectsNoLightTotally) {
    const std::string coated = std::string(kBlack) + "m.metallic = 1.0; m.roughness = 0.1; m.clearCoat = amount; "
                                                     "m.clearCoatRoughness = 0.1;";
    const Pixels none = render(furnace(scene(coated)));
    const Pixels filmed = render(furnace(scene(coated + "m.iridescence = 1.0; m.iridescenceIor = 1.2;")));
    EXPECT_GT(distance(none, filmed), 0.02f);
    EXPECT_LT(distance(none, filmed), 0.3f);
}

TEST_F(LayerBits, AFilmOfNoThicknessOrStrengthIsNone) {
    const std::string metal = "m.baseColor.rgb = vec3(0.6, 0.5, 0.2); m.metallic = 1.0; m.roughness = 0.4; ";
    const Pixels none = render(lights(furnace(scene(metal))));
    EXPECT_EQ(distance(none, render(lights(furnace(scene(metal + "m.iridescence = amount;", 0))))), 0);
    const Pixels thin =
            render(lights(furnace(scene(metal + "m.iridescence = 1.0; m.iridescenceThickness = amount;", 0))));
    EXPECT_LT(distance(none, thin), 2e-4f * most(none));
}

// ------------------------------------------------------------------------------------------------ diffuse transmission

TEST_F(LayerBits, TransmittedLightIsThatOfTheOtherSide) {
    const auto inSky = [](MaterialScene made, float gradient) {
        made = furnace(std::move(made));
        for (size_t i = 1; i < 4; ++i) made.frame.irradianceSh[i] = { gradient, gradient, gradient, 0 };
        return made;
    };
    const Pixels front = render(inSky(scene("m.specularFactor = 1.0 - amount;"), -0.2f));
    const Pixels behind =
            render(inSky(scene("m.specularFactor = 1.0 - amount; m.diffuseTransmission = amount;"), 0.2f));
    EXPECT_GT(most(front), least(front) + 0.1f);
    EXPECT_LT(distance(front, behind), 1e-5f);
}

TEST_F(LayerBits, ALightFromBehindShinesThroughAsFarAsItIsLet) {
    const auto from = [](std::string const& code, float z) {
        MaterialScene made = scene("m.specularFactor = 0.0; " + code);
        made.variant = kVariantSun;
        made.frame.sunDirection = { 0, 0, z, 1 };
        made.frame.sunIlluminance = { 1, 1, 1, 0 };
        return render(made);
    };
    const Pixels lambert = from("", 1), behind = from("m.diffuseTransmission = amount;", -1),
                 half = from("m.diffuseTransmission = 0.5 * amount;", -1);
    EXPECT_LT(distance(lambert, behind), 1e-6f);
    ASSERT_FALSE(half.empty());
    for (size_t i = 0; i < half.size(); ++i) ASSERT_NEAR(half[i], 0.5f * behind[i], 1e-6f);
    EXPECT_EQ(most(from("m.diffuseTransmission = amount;", 1)), 0);
    EXPECT_EQ(most(from("m.diffuseTransmission = amount; m.diffuseTransmissionColor = vec3(0.0);", -1)), 0);
}

// ------------------------------------------------------------------------------------------------ index and
// reflectance

TEST_F(LayerBits, IndexAndReflectanceSayTheSameAndReflectanceCountsWhereBothAreGiven) {
    const std::string dark = std::string(kBlack) + "m.roughness = 0.4; ";
    const auto of = [&](std::string const& code, float amount) {
        return render(lights(furnace(scene(dark + code, amount))));
    };
    const Pixels water = of("m.ior = amount;", 1.33f);
    const Pixels reflectance = of("m.reflectance = amount;", 2.5f * 0.33f / 2.33f);
    ASSERT_FALSE(water.empty());
    EXPECT_LT(distance(water, reflectance), 1e-5f * most(water));
    EXPECT_GT(mean(of("m.ior = amount;", 2.0f)), 1.2 * mean(water));
    EXPECT_EQ(distance(of("m.ior = amount; m.reflectance = 0.5;", 2.0f), of("", 0)), 0);
}

// ------------------------------------------------------------------------------------------------ specular-glossiness

TEST_F(LayerBits, SpecularGlossinessSaysTheStandardModelInOtherWords) {
    const std::string model = "shadingModel : specularGlossiness";
    const Pixels metal = render(lights(furnace(scene("m.baseColor.rgb = vec3(0.9, 0.6, 0.3); m.metallic = 1.0; "
                                                     "m.roughness = amount;",
                                                     0.25f))),
                                1);
    const Pixels specular = render(lights(furnace(scene(std::string(kBlack) + "m.specularColor = vec3(0.9, 0.6, 0.3); "
                                                                              "m.glossiness = 1.0 - amount;",
                                                        0.25f, model))),
                                   1);
    EXPECT_LT(distance(metal, specular), 1e-6f * most(metal));
    const Pixels white = render(furnace(scene("m.specularColor = vec3(amount);", 0.3f, model)));
    EXPECT_LT(most(white), 1.005f) << "what is reflected is taken from the diffuse lobe";
    MaterialScene layered = furnace(scene(std::string(kBlack) + "m.specularColor = vec3(1.0); m.glossiness = 0.5;"
                                                                "m.clearCoat = amount; m.sheenColor = vec3(amount);"
                                                                "m.anisotropy = 0.5 * amount;",
                                          1, model + ", halfPrecision : true"));
    const Pixels coated = render(layered);
    EXPECT_LT(most(coated), 1.005f);
    EXPECT_GT(least(coated), 0.9f);
    layered.variant |= kVariantHalf;
    EXPECT_LT(distance(render(layered), coated), 0.01f) << "16 bits are close";
}

// ------------------------------------------------------------------------------------------------ occlusion

TEST_F(LayerBits, OcclusionBouncesWithTheColorOfTheSurface) {
    const auto of = [](std::string const& color, const char* bounces) {
        return render(furnace(
                scene("m.specularFactor = 0.0; m.ambientOcclusion = amount; m.baseColor.rgb = vec3(" + color + ");",
                      0.5f, std::string("multiBounceAmbientOcclusion : ") + bounces)));
    };
    const Pixels once = of("0.8", "false"), often = of("0.8", "true"), dark = of("0.1", "true");
    EXPECT_LT(distance(once, Pixels(once.size(), 0.4f)), 1e-6f);
    const float bright = lib::multiBounceAo(0.5f, float3(0.8f)).x;
    EXPECT_GT(bright, 0.6f);
    EXPECT_LT(distance(often, Pixels(often.size(), 0.8f * bright)), 1e-6f);
    EXPECT_LT(distance(dark, Pixels(dark.size(), 0.1f * lib::multiBounceAo(0.5f, float3(0.1f)).x)), 1e-6f);
}

TEST_F(LayerBits, SpecularOcclusionFollowsTheBentNormal) {
    const auto of = [](const char* mode, std::string const& bent) {
        return render(furnace(
                scene("m.metallic = 1.0; m.roughness = 0.2; m.ambientOcclusion = amount;", 0.4f,
                      std::string("multiBounceAmbientOcclusion : false, specularAmbientOcclusion : ") + mode, bent)));
    };
    const Pixels none = of("none", ""), simple = of("simple", ""), along = of("bentNormals", "");
    const Pixels aside = of("bentNormals", "m.bentNormal = vec3(1.0, 0.0, 0.0);");
    EXPECT_GT(least(none), 0.97f);
    EXPECT_LT(mean(simple), mean(none) - 0.02);
    EXPECT_GT(most(along), 0.99f) << "what reflects the middle of the visible cone sees the sky";
    EXPECT_LT(least(along), 0.01f) << "and nothing beside it";
    EXPECT_GT(distance(along, aside), 0.9f);
}

TEST_F(LayerBits, DiffuseAmbientLightComesFromTheBentNormal) {
    const auto inSky = [](MaterialScene made) {
        made = furnace(std::move(made));
        for (size_t i = 1; i < 4; ++i) made.frame.irradianceSh[i] = { 0.2f, 0.2f, 0.2f, 0 };
        return made;
    };
    const char* const tilt = " = normalize(vec3(0.4, 0.2, 0.8));";
    const Pixels bent = render(inSky(scene("m.specularFactor = 0.0;", 1, "", "m.bentNormal" + std::string(tilt))));
    const Pixels turned = render(inSky(scene("m.specularFactor = 0.0;", 1, "", "m.normal" + std::string(tilt))));
    const Pixels straight = render(inSky(scene("m.specularFactor = 0.0;")));
    EXPECT_LT(distance(bent, turned), 1e-6f);
    EXPECT_GT(distance(bent, straight), 0.05f);
}

TEST_F(LayerBits, ReflectionsFadeAsANormalMapTurnsThemBelowTheSurface) {
    const auto tilted = [](std::string const& x, const char* metal = "m.metallic = 1.0; m.roughness = 0.1;") {
        return render(furnace(
                scene(metal, 1, "", "m.normal = normalize(vec3(" + x + ", 0.0, 1.0) * materialParams.amount);")));
    };
    const Pixels flat = tilted("0.0"), little = tilted("0.3"), more = tilted("1.0"), steep = tilted("4.0");
    EXPECT_GT(least(flat), 0.97f);
    EXPECT_LT(mean(little), mean(flat));
    EXPECT_LT(mean(more), mean(little) - 0.05);
    EXPECT_LT(mean(steep), mean(more) - 0.05);
    const Pixels matt = tilted("4.0", "m.specularFactor = 0.0;");
    EXPECT_LT(distance(matt, Pixels(matt.size(), 1.0f)), 1e-6f) << "diffuse light comes from everywhere";
}

// ------------------------------------------------------------------------------------------------ everything at once

constexpr const char* kEverything =
        "m.baseColor.rgb = vec3(0.7, 0.5, 0.3); m.metallic = 0.5; m.roughness = 0.3; m.clearCoat = 0.8 * amount;"
        "m.clearCoatRoughness = 0.1; m.sheenColor = vec3(0.3, 0.5, 0.7) * amount; m.sheenRoughness = 0.3;"
        "m.anisotropy = 0.7 * amount; m.anisotropyDirection = vec3(0.5, 0.8, 0.0); m.specularFactor = 0.5 * amount;"
        "m.specularColorFactor = vec3(1.0, 0.8, 0.6) * amount; m.iridescence = 0.6 * amount; m.ior = 1.0 + amount;"
        "m.diffuseTransmission = 0.4 * amount; m.ambientOcclusion = 0.6 * amount;";
constexpr const char* kNormals =
        "m.normal = normalize(vec3(0.2, -0.3, 0.9)); m.bentNormal = normalize(vec3(0.3, 0.2, 0.9));"
        "m.clearCoatNormal = normalize(vec3(-0.1, 0.2, 0.9));";

TEST_F(LayerBits, AllLayersTogetherHaveTheSameBits) {
    MaterialScene full = lights(furnace(scene(
            kEverything, 1, "halfPrecision : true, specularAntiAliasing : true, specularAmbientOcclusion : bentNormals",
            kNormals)));
    const Pixels exact = render(full);
    EXPECT_GT(most(exact) - least(exact), 0.2f);
    full.variant |= kVariantHalf;
    const Pixels half = render(full);
    EXPECT_LT(std::abs(mean(half) - mean(exact)), 0.01 * mean(exact)) << "16 bits are close";
}

TEST_F(LayerBits, LayersWithoutStrengthChangeNoBit) {
    const std::string base =
            "m.baseColor.rgb = vec3(0.7, 0.5, 0.3) + amount; m.metallic = 0.5 + amount; m.roughness = 0.3;";
    const std::string none =
            "m.clearCoat = amount; m.sheenColor = vec3(amount); m.anisotropy = amount; m.iridescence = "
            "amount; m.specularFactor = 1.0 - amount;";
    EXPECT_EQ(distance(render(lights(furnace(scene(base, 0)))), render(lights(furnace(scene(base + none, 0))))), 0);
}

TEST_F(LayerBits, PolishedLayersWithoutRoughnessStayFinite) {
    const std::string polished = "m.roughness = 0.0; m.clearCoat = amount; m.clearCoatRoughness = 0.0; "
                                 "m.sheenColor = vec3(1.0); m.sheenRoughness = 0.0; m.anisotropy = amount; "
                                 "m.iridescence = amount; m.iridescenceThickness = 1000.0;";
    for (const uint16_t half : { uint16_t{ 0 }, uint16_t{ kVariantHalf } }) {
        MaterialScene made = lights(furnace(scene(polished, 1, "halfPrecision : true")));
        made.variant |= half;
        EXPECT_FALSE(render(made).empty());
    }
}

} // namespace
} // namespace filament::shader
