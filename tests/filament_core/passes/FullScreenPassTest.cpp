// SPDX-License-Identifier: Apache-2.0
// Errors of full-screen materials that are detected before anything is drawn. Drawing is tested by
// devices/FullScreenPassTest.cpp.
#include "filament_core/passes/FullScreenPass.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace filament_core::passes {
namespace {

using shader::Parameter;

scene::Material bloom() {
    scene::Material material;
    material.name = "bloom";
    material.package.domain = MaterialDomain::PostProcess;
    material.package.parameters = { { .name = "color", .type = ParameterType::Sampler2D, .binding = 1 },
                                    { .name = "dirt", .type = ParameterType::Sampler2D, .binding = 2 },
                                    { .name = "strength", .type = ParameterType::Float },
                                    { .name = "weights", .type = ParameterType::Float4, .arraySize = 4 } };
    return material;
}

constexpr std::string_view kInputs[] = { "color", "dirt" };
constexpr FullScreenParameter kStrength[] = { { "strength", ParameterType::Float } };

std::string complaint(scene::Material const& material, std::span<const std::string_view> inputs = kInputs,
                      std::span<const FullScreenParameter> values = kStrength) {
    const Result<void> fits = checkFullScreenMaterial(material, { "glow", inputs, values });
    return fits ? "fits" : fits.error().message;
}

scene::Material withoutWeights() {
    scene::Material material = bloom();
    material.package.parameters.pop_back();
    return material;
}

TEST(FullScreenMaterial, FitsThePassThatGivesItAllThatItHas) { EXPECT_EQ(complaint(withoutWeights()), "fits"); }

TEST(FullScreenMaterial, NeedNotBeGivenWhatItsConstantsSwitchOff) {
    scene::Material material = withoutWeights();
    material.package.parameters[1].isBound = false;
    EXPECT_EQ(complaint(material, std::span(kInputs).first(1)), "fits");
    EXPECT_EQ(complaint(material), "fits") << "it may be";
}

TEST(FullScreenMaterial, IsRefusedWithTheNamesOfMaterialPassAndParameter) {
    constexpr std::string_view kMisspelt[] = { "colour", "dirt" };
    EXPECT_EQ(complaint(withoutWeights(), kMisspelt),
              "material 'bloom' has no input 'colour', which pass 'glow' gives it; did you mean 'color'?");
    EXPECT_EQ(complaint(withoutWeights(), std::span(kInputs).first(1)),
              "material 'bloom' has the input 'dirt', which pass 'glow' does not give it");
    EXPECT_EQ(complaint(withoutWeights(), kInputs, {}),
              "material 'bloom' has the value 'strength', which pass 'glow' does not give it");
    constexpr FullScreenParameter kWide[] = { { "strength", ParameterType::Float3 } };
    EXPECT_EQ(complaint(withoutWeights(), kInputs, kWide),
              "material 'bloom': value 'strength' is float, but pass 'glow' gives float3");
    constexpr FullScreenParameter kNoArray[] = { { "strength", ParameterType::Float },
                                                 { "weights", ParameterType::Float4 } };
    EXPECT_EQ(complaint(bloom(), kInputs, kNoArray),
              "material 'bloom': value 'weights' is float4[], but pass 'glow' gives float4");
}

TEST(FullScreenMaterial, IsRefusedWhereATextureIsTakenForAValueOrTheOtherWayRound) {
    constexpr std::string_view kValueAsInput[] = { "color", "dirt", "strength" };
    EXPECT_THAT(complaint(withoutWeights(), kValueAsInput), testing::HasSubstr("has no input 'strength'"));
    constexpr FullScreenParameter kInputAsValue[] = { { "strength", ParameterType::Float },
                                                      { "dirt", ParameterType::Float } };
    EXPECT_THAT(complaint(withoutWeights(), kInputs, kInputAsValue), testing::HasSubstr("has no value 'dirt'"));
}

TEST(FullScreenMaterial, IsRefusedWhereItDrawsSurfacesOrIsAlwaysMerged) {
    scene::Material surface = withoutWeights();
    surface.package.domain = MaterialDomain::Surface;
    EXPECT_EQ(complaint(surface),
              "material 'bloom' is of domain surface, and pass 'glow' draws a picture; say domain : "
              "postprocess in it");
    scene::Material merged = withoutWeights();
    merged.package.parameters[0].type = ParameterType::SubpassInput;
    EXPECT_EQ(complaint(merged),
              "material 'bloom': input 'color' is a subpassInput, so pass 'glow' cannot draw it unless it is "
              "merged; make it type : sampler2d, currentPixel : true");
}

} // namespace
} // namespace filament_core::passes
