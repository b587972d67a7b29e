// SPDX-License-Identifier: Apache-2.0
// The effects of a material's quality, platform and featureLevel.
#include "shaders/compiler/Cost.h"
#include "shaders/compiler/MaterialCompiler.h"

#include <gtest/gtest.h>

#include <string>

namespace filament_core::shader {
namespace {

std::string lit(std::string const& properties, std::string const& line = "") {
    return "material { name : lit, " + properties +
           " }\nfragment {\nint ownBits(int x) { return x; }\nvoid material(inout MaterialInputs m) { "
           "prepareMaterial(m); "
           "m.ambientOcclusion = 0.5; m.roughness = 0.4; " +
           line + " } }\n";
}

MaterialPackage compiled(std::string const& text, Platform platform = Platform::All) {
    Result<MaterialPackage> package = compileMaterial(text, "lit.mat", { .platform = platform });
    if (package) return std::move(*package);
    ADD_FAILURE() << package.error().message;
    return {};
}

TEST(Platform, MobileMeansTheDefaultsThatTheGuideGivesForPhones) {
    const MaterialPackage stated =
            compiled(lit("quality : low, multiBounceAmbientOcclusion : false, specularAmbientOcclusion : none"));
    EXPECT_EQ(compiled(lit("doubleSided : false"), Platform::Mobile).quality, MaterialQuality::Low);
    EXPECT_EQ(writePackage(compiled(lit("shadingModel : lit"), Platform::Mobile)), writePackage(stated));
    EXPECT_NE(writePackage(compiled(lit("shadingModel : lit"))), writePackage(stated));
}

TEST(Platform, WhatTheAuthorStatesIsTheSameOnAllOfThem) {
    const std::string text =
            lit("quality : normal, multiBounceAmbientOcclusion : true, specularAmbientOcclusion : simple");
    const MaterialPackage all = compiled(text);
    EXPECT_EQ(compiled(text, Platform::Mobile), all);
    EXPECT_EQ(compiled(text, Platform::Desktop), all);
}

TEST(Platform, DesktopsHaveTheCodeOfAllAndHighQuality) {
    const MaterialPackage all = compiled(lit("shadingModel : lit"));
    const MaterialPackage desktop = compiled(lit("shadingModel : lit"), Platform::Desktop);
    EXPECT_EQ(all.quality, MaterialQuality::Default);
    EXPECT_EQ(desktop.quality, MaterialQuality::High);
    EXPECT_EQ(desktop.variants, all.variants);
}

TEST(MaterialQuality, LowComputesLessAndTheOthersTheSame) {
    const auto work = [](std::string const& properties) {
        constexpr uint16_t kLights = kVariantSun | kVariantPunctual;
        const Result<MaterialPackage> package = compileMaterial(lit(properties), "lit.mat", { .onlyVariant = kLights });
        EXPECT_TRUE(package);
        return package ? countInstructions(package->findVariant(kLights)->fragment->spirv).sum() : 0;
    };
    EXPECT_LT(work("quality : low"), work("quality : default"));
    EXPECT_EQ(work("quality : normal"), work("quality : default"));
    EXPECT_EQ(work("quality : high"), work("quality : default"));
}

TEST(FeatureLevel, FunctionsOfEssl310CompileFromLevelTwoOn) {
    const std::string use = "m.roughness = float(bitCount(7)) * 0.1;";
    const auto compiles = [](std::string const& text) {
        return compileMaterial(text, "lit.mat", { .filteredVariants = kAllVariantBits }).ok();
    };
    EXPECT_TRUE(compiles(lit("featureLevel : 2", use)));
    EXPECT_FALSE(compiles(lit("featureLevel : 1", use)));
    EXPECT_TRUE(compiles(lit("featureLevel : 1", "m.roughness = float(ownBits(1)) * 0.5;")))
            << "functions of the author are no features";
}

TEST(PrimitiveId, RequiresTheExtensionOfEssl310WhereItIsRead) {
    const auto essl = [](std::string const& line) {
        return compiled(lit("shadingModel : lit", line)).variants[0].fragment->essl;
    };
    const std::string extension = "#extension GL_EXT_geometry_shader : require";
    EXPECT_NE(essl("m.baseColor.r = float(gl_PrimitiveID & 1);").find(extension), std::string::npos);
    EXPECT_EQ(essl("m.baseColor.r = float(ownBits(1));").find(extension), std::string::npos);
}

TEST(SampleMask, IsInTheCodeOfMaterialsWithAlphaToCoverageAlone) {
    const auto essl = [](std::string const& properties) {
        return compiled(lit(properties, "m.roughness = 0.5;")).variants[0].fragment->essl;
    };
    const std::string extension = "#extension GL_OES_sample_variables : enable",
                      mask = "#define written_samples gl_SampleMask";
    for (const char* properties : { "blending : masked", "alphaToCoverage : true" }) {
        EXPECT_NE(essl(properties).find(extension), std::string::npos) << properties;
        EXPECT_NE(essl(properties).find(mask), std::string::npos) << properties;
        EXPECT_NE(essl(properties).find("written_samples[0] = "), std::string::npos) << properties;
    }
    for (const char* properties : { "blending : opaque", "blending : masked, alphaToCoverage : false" }) {
        EXPECT_EQ(essl(properties).find(extension), std::string::npos) << properties;
        EXPECT_EQ(essl(properties).find("gl_SampleMask"), std::string::npos) << properties;
    }
}

} // namespace
} // namespace filament_core::shader
