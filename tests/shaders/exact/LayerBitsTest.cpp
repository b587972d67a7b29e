// SPDX-License-Identifier: Apache-2.0
// The layers above, below and behind the base, on both devices: the same bits, and the values of the formulas in closed
// form.
#include "tests/shaders/exact/LayerFixture.h"

namespace filament_core::shader {
namespace {

using test::kBlack;
using test::LayerBits;
using test::MaterialScene;
using test::Pixels;

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
} // namespace filament_core::shader
