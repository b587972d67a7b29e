// SPDX-License-Identifier: Apache-2.0
// Every property of chapter 4.2 of the materials guide: what the definition keeps of it.
#include "shaders/compiler/DefinitionRules.h"
#include "shaders/compiler/MaterialDefinition.h"
#include "shaders/interface/SamplerBudget.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace filament_core::shader {
namespace {

using backend::BlendFactor;
using ::testing::HasSubstr;

/// Only the definition; what the shader text can do with it is tested elsewhere.
Result<MaterialDefinition> define(std::string const& properties) {
    Result<MaterialText> text = parseMaterialText(
            "material {\n" + properties + "\n}\nfragment { void material(inout MaterialInputs material) { } }",
            "wood.mat", {});
    if (!text) return text.error();
    return defineMaterial(std::move(*text), "wood.mat");
}

MaterialDefinition defined(std::string const& properties) {
    Result<MaterialDefinition> definition = define(properties);
    EXPECT_TRUE(definition) << properties << ": " << (definition ? "" : definition.error().message);
    return definition ? std::move(*definition) : MaterialDefinition{};
}

MaterialPackage packageOf(std::string const& properties) { return defined(properties).package; }

TEST(Properties, HaveTheDefaultsOfTheGuide) {
    const MaterialDefinition definition = defined("");
    MaterialPackage const& package = definition.package;
    EXPECT_EQ(package.featureLevel, 1);
    EXPECT_EQ(package.shading, ShadingModel::Lit);
    EXPECT_EQ(package.quality, MaterialQuality::Default);
    EXPECT_EQ(package.interpolation, Interpolation::Smooth);
    EXPECT_EQ(package.postLightingBlending, PostLightingBlending::Transparent);
    EXPECT_EQ(package.transparency, TransparencyMode::Default);
    EXPECT_EQ(package.refractionMode, RefractionMode::None);
    EXPECT_EQ(package.refractionType, RefractionType::Solid);
    EXPECT_EQ(package.reflections, Reflections::Default);
    EXPECT_FALSE(package.instanced || package.vertexDomainDeviceJittered || package.alphaToCoverage);
    EXPECT_FALSE(package.shadowMultiplier || package.transparentShadow || definition.customSurfaceShading);
    EXPECT_TRUE(definition.flipUv && definition.clearCoatIorChange && definition.multiBounceAmbientOcclusion);
    EXPECT_EQ(definition.specularAmbientOcclusion, SpecularAmbientOcclusion::Simple);
    EXPECT_FALSE(definition.specularAntiAliasing.enabled);
    EXPECT_EQ(definition.specularAntiAliasing.variance, 0.15f);
    EXPECT_EQ(definition.specularAntiAliasing.threshold, 0.2f);
}

TEST(Properties, NameEveryShadingModelWithAndWithoutQuotes) {
    EXPECT_EQ(packageOf("shadingModel : lit").shading, ShadingModel::Lit);
    EXPECT_EQ(packageOf("shadingModel : \"subsurface\"").shading, ShadingModel::Subsurface);
    EXPECT_EQ(packageOf("shadingModel : CLOTH").shading, ShadingModel::Cloth);
    EXPECT_EQ(packageOf("shadingModel : unlit,").shading, ShadingModel::Unlit);
    EXPECT_EQ(packageOf("\"shadingModel\" : specularglossiness").shading, ShadingModel::SpecularGlossiness);
}

TEST(Properties, SetTheStateOfTheMaterial) {
    EXPECT_EQ(packageOf("featureLevel : 3").featureLevel, 3);
    EXPECT_EQ(packageOf("quality : low").quality, MaterialQuality::Low);
    EXPECT_TRUE(packageOf("instanced : true").instanced);
    EXPECT_TRUE(packageOf("vertexDomainDeviceJittered : true").vertexDomainDeviceJittered);
    EXPECT_EQ(packageOf("interpolation : flat").interpolation, Interpolation::Flat);
    EXPECT_EQ(packageOf("postLightingBlending : add").postLightingBlending, PostLightingBlending::Add);
    EXPECT_EQ(packageOf("postLightingBlending : multiply").postLightingBlending, PostLightingBlending::Multiply);
    EXPECT_EQ(packageOf("blending : fade, transparency : twoPassesTwoSides").transparency,
              TransparencyMode::TwoPassesTwoSides);
    EXPECT_EQ(packageOf("refractionMode : cubemap, refractionType : thin").refractionType, RefractionType::Thin);
    EXPECT_EQ(packageOf("refractionMode : screenspace").refractionMode, RefractionMode::ScreenSpace);
    EXPECT_EQ(packageOf("reflections : screenspace").reflections, Reflections::ScreenSpace);
    EXPECT_TRUE(packageOf("shadingModel : unlit, shadowMultiplier : true").shadowMultiplier);
    EXPECT_TRUE(packageOf("transparentShadow : true").transparentShadow);
    EXPECT_FALSE(defined("clearCoatIorChange : false").clearCoatIorChange);
    EXPECT_FALSE(defined("multiBounceAmbientOcclusion : false").multiBounceAmbientOcclusion);
    EXPECT_TRUE(defined("customSurfaceShading : true").customSurfaceShading);
}

TEST(Properties, TakeBooleansForSpecularAmbientOcclusion) {
    EXPECT_EQ(defined("specularAmbientOcclusion : true").specularAmbientOcclusion, SpecularAmbientOcclusion::Simple);
    EXPECT_EQ(defined("specularAmbientOcclusion : false").specularAmbientOcclusion, SpecularAmbientOcclusion::None);
    EXPECT_EQ(defined("specularAmbientOcclusion : bentNormals").specularAmbientOcclusion,
              SpecularAmbientOcclusion::BentNormals);
}

TEST(Properties, SpellOutACustomBlendFunction) {
    const BlendFunction function = packageOf("blending : custom, blendFunction : { srcRGB : one, srcA : zero, "
                                             "dstRGB : oneMinusSrcColor, dstA : srcAlphaSaturate }")
                                           .blendFunction;
    EXPECT_EQ(function, (BlendFunction{ BlendFactor::One, BlendFactor::Zero, BlendFactor::OneMinusSrcColor,
                                        BlendFactor::SrcAlphaSaturate }));
}

TEST(Properties, LetAlphaToCoverageFollowTheMaskUnlessToldOtherwise) {
    EXPECT_TRUE(packageOf("blending : masked").alphaToCoverage);
    EXPECT_FALSE(packageOf("blending : masked, alphaToCoverage : false").alphaToCoverage);
    EXPECT_TRUE(packageOf("alphaToCoverage : true").alphaToCoverage);
}

TEST(Properties, FilterEveryVariantOfTheGuide) {
    EXPECT_EQ(packageOf("variantFilter : [ directionalLighting, dynamicLighting, shadowReceiver, skinning, fog, vsm, "
                        "ssr, stereo, ]")
                      .filteredVariants,
              255);
    EXPECT_EQ(packageOf("variantFilter : [ SKINNING ]").filteredVariants, kVariantSkinning);
}

TEST(Properties, SpellMatricesAsTheGuideDoes) {
    const MaterialPackage package = packageOf("parameters : [ { name : a, type : float3\xC3\x97"
                                              "3 }, { name : b, type : float4x4 }, { name : c, type : \"float3\xC3\x97"
                                              "3[2]\" } ]");
    ASSERT_EQ(package.parameters.size(), 3u);
    EXPECT_EQ(package.parameters[0].type, ParameterType::Float3x3);
    EXPECT_EQ(package.parameters[1].type, ParameterType::Float4x4);
    EXPECT_EQ(package.parameters[2].type, ParameterType::Float3x3);
    EXPECT_EQ(package.parameters[2].arraySize, 2u);
}

TEST(Properties, KeepTheFormatOfSamplers) {
    const MaterialPackage package = packageOf("parameters : [ { type : sampler2d, format : int, name : ids }, "
                                              "{ type : sampler2dArray, format : float, name : layers }, "
                                              "{ type : samplerCubemap, format : uint, name : flags } ]");
    EXPECT_EQ(package.findParameter("flags")->format, SamplerFormat::Uint);
    EXPECT_EQ(package.findParameter("ids")->format, SamplerFormat::Int);
    EXPECT_EQ(package.findParameter("layers")->format, SamplerFormat::Float);
}

TEST(Properties, AreCaseSensitiveThemselves) {
    const Result<MaterialDefinition> definition = define("ShadingModel : lit");
    ASSERT_FALSE(definition);
    EXPECT_THAT(definition.error().message, HasSubstr("did you mean 'shadingModel'?"));
}

// ---------------------------------------------------------------------------------------------- samplers (chapter 7)

std::string withSamplers(uint32_t count, std::string const& others) {
    std::string list;
    for (uint32_t i = 0; i < count; ++i) list += "{ name : s" + std::to_string(i) + ", type : sampler2d },\n";
    return others + " parameters : [\n" + list + "]";
}

struct Budget {
    const char* properties;
    uint32_t samplers;
};

// SamplerBudget.h compares them with the guide's.
constexpr Budget kBudgets[] = {
    { "", samplersOfMaterial(PassKind::Lit) },
    { "featureLevel : 2,", samplersOfMaterial(PassKind::Lit) },
    { "featureLevel : 3,", 24 },
    { "variantFilter : [ fog ],", samplersOfMaterial(PassKind::Lit, false) },
    { "refractionMode : screenspace,", samplersOfMaterial(PassKind::LitScreen) },
    { "reflections : screenspace, variantFilter : [ fog ],", samplersOfMaterial(PassKind::LitScreen, false) },
    { "refractionMode : cubemap,", samplersOfMaterial(PassKind::Lit) },
    { "shadingModel : unlit,", samplersOfMaterial(PassKind::Unlit) },
    { "shadingModel : unlit, variantFilter : [ fog ],", samplersOfMaterial(PassKind::Unlit, false) },
};

TEST(Properties, AllowAsManySamplersAsChapterSevenAndTheDeviceDo) {
    for (Budget const& budget : kBudgets) {
        EXPECT_TRUE(define(withSamplers(budget.samplers, budget.properties))) << budget.properties;
        const Result<MaterialDefinition> tooMany = define(withSamplers(budget.samplers + 1, budget.properties));
        ASSERT_FALSE(tooMany) << budget.properties;
        EXPECT_THAT(tooMany.error().message,
                    HasSubstr("sampler 's" + std::to_string(budget.samplers) + "' is one too many"));
        EXPECT_THAT(tooMany.error().message, HasSubstr("has at most " + std::to_string(budget.samplers) + ";"));
        EXPECT_THAT(tooMany.error().message,
                    HasSubstr("wood.mat:" + std::to_string(3 + budget.samplers) + ": ")); // one a line, from line 3 on
    }
}

} // namespace
} // namespace filament_core::shader
