// SPDX-License-Identifier: Apache-2.0
// Alternative parameters of the base's reflectance, and occlusion by its surroundings, on both devices: the same bits,
// and the values of the formulas in closed form.
#include "shaders/lib/LibCpp.h"
#include "tests/shaders/exact/LayerFixture.h"

namespace filament_core::shader {
namespace {

using test::kBlack;
using test::LayerBits;
using test::MaterialScene;
using test::Pixels;

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

// ---------------------------------------------------------------------------------------- index and reflectance

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

} // namespace
} // namespace filament_core::shader
