// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/MaterialCompiler.h"

#include "jobsystem/JobSystem.h"
#include "shaders/compiler/MaterialDefinition.h"
#include "shaders/interface/ShaderInterface.h"
#include "shaders/package/GroupLayouts.h"
#include "tests/shaders/compiler/SpirvTools.h"

#include <fmt/core.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>

namespace filament_core::shader {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::string_view kEmptyFragment =
        "\nfragment {\n void material(inout MaterialInputs material) { prepareMaterial(material); }\n}\n";

std::string withProperties(std::string_view properties) {
    return "material {\n" + std::string(properties) + "\n}" + std::string(kEmptyFragment);
}

/// Compiles without the optimiser: the tests check contents, not speed.
Result<MaterialPackage> compile(std::string_view text, CompileOptions options = {}) {
    options.optimization = Optimization::None;
    return compileMaterial(text, "wood.mat", options);
}

Error failureOf(std::string_view text) {
    const Result<MaterialPackage> package = compile(text);
    return package ? Error{ ErrorCode::Internal, "no error" } : package.error();
}

std::string fragmentOf(std::string_view fragmentBlock, std::string_view properties = "shadingModel : lit") {
    const std::string text =
            "material {\n" + std::string(properties) + "\n}\nfragment {" + std::string(fragmentBlock) + "}\n";
    const Result<std::string> glsl = preprocessMaterial(text, "wood.mat");
    return glsl ? *glsl : glsl.error().message;
}

// ---------------------------------------------------------------------------------------------- properties

TEST(MaterialCompiler, FillsInTheDefaultsOfTheGuide) {
    const Result<MaterialPackage> package = compile(withProperties("name : stone"));
    ASSERT_TRUE(package) << package.error().message;
    EXPECT_EQ(package->name, "stone");
    EXPECT_EQ(package->domain, MaterialDomain::Surface);
    EXPECT_EQ(package->shading, ShadingModel::Lit);
    EXPECT_EQ(package->blending, Blending::Opaque);
    EXPECT_EQ(package->culling, Culling::Back);
    EXPECT_EQ(package->vertexDomain, VertexDomain::Object);
    EXPECT_TRUE(package->depthWrite && package->depthCulling && package->colorWrite);
    EXPECT_FALSE(package->doubleSided);
    EXPECT_EQ(package->maskThreshold, 0.4f);
    EXPECT_EQ(package->uniformBytes, 0u);
    EXPECT_EQ(package->requiredAttributes, 1u << kAttributePosition | 1u << kAttributeTangents);
}

TEST(MaterialCompiler, ReadsEnumValuesInAnyCase) {
    const Result<MaterialPackage> package =
            compile(withProperties("shadingModel : UNLIT, blending : \"Transparent\", culling : FrontAndBack"));
    ASSERT_TRUE(package) << package.error().message;
    EXPECT_EQ(package->shading, ShadingModel::Unlit);
    EXPECT_EQ(package->blending, Blending::Transparent);
    EXPECT_EQ(package->culling, Culling::FrontAndBack);
}

TEST(MaterialCompiler, LetsDefaultsFollowFromOtherProperties) {
    const Result<MaterialPackage> blended =
            compile(withProperties("shadingModel : unlit, blending : fade, doubleSided : true"));
    ASSERT_TRUE(blended) << blended.error().message;
    EXPECT_FALSE(blended->depthWrite) << "blended materials do not write depth";
    EXPECT_EQ(blended->culling, Culling::Back) << "of instances that are switched to one side";
    const Result<MaterialPackage> explicitOnes = compile(withProperties(
            "shadingModel : unlit, blending : fade, doubleSided : true, depthWrite : true, culling : front"));
    ASSERT_TRUE(explicitOnes) << explicitOnes.error().message;
    EXPECT_TRUE(explicitOnes->depthWrite);
    EXPECT_EQ(explicitOnes->culling, Culling::Front);
}

TEST(MaterialCompiler, LaysOutParametersOfEveryType) {
    std::string list;
    for (const char* type :
         { "bool",     "bool2",    "bool3",    "bool4", "float",     "float2",         "float3",        "float4",
           "int",      "int2",     "int3",     "int4",  "uint",      "uint2",          "uint3",         "uint4",
           "float3x3", "float4x4", "float[3]", "mat3",  "sampler2d", "sampler2dArray", "samplerCubemap" }) {
        list += "{ name : p" + std::to_string(list.size()) + ", type : " + type + ", precision : high },\n";
    }
    const Result<MaterialPackage> package =
            compile(withProperties("shadingModel : unlit, parameters : [" + list + "]"));
    ASSERT_TRUE(package) << package.error().message;
    ASSERT_EQ(package->parameters.size(), 23u);
    EXPECT_EQ(package->parameters[18].arraySize, 3u);
    EXPECT_EQ(package->parameters[20].type, ParameterType::Sampler2D);
    EXPECT_EQ(package->parameters[20].binding, 1);
    EXPECT_EQ(package->parameters[22].binding, 3);
    EXPECT_EQ(package->layout[kGroupMaterial].count, 4);
}

TEST(MaterialCompiler, KeepsConstantsWithTheirDefaults) {
    const Result<MaterialPackage> package = compile(R"(material { shadingModel : unlit,
        constants : [ { name : on, type : bool, default : true }, { name : count, type : int, default : -7 }, { name : scale, type : float, default : 0.25 } ] }
        fragment { void material(inout MaterialInputs material) { prepareMaterial(material);
            if (materialConstants_on && materialConstant_count < 0) material.baseColor *= materialConstants_scale; } })");
    ASSERT_TRUE(package) << package.error().message;
    ASSERT_EQ(package->constants.size(), 3u);
    EXPECT_EQ(package->findConstant("on")->defaultBits, 1u);
    EXPECT_EQ(static_cast<int32_t>(package->findConstant("count")->defaultBits), -7);
    EXPECT_EQ(std::bit_cast<float>(package->findConstant("scale")->defaultBits), 0.25f);
    EXPECT_THAT(package->variants[0].fragment->essl, HasSubstr("#define SPIRV_CROSS_CONSTANT_ID_1 -7"));
}

TEST(MaterialCompiler, GivesMaskedMaterialsASettableThreshold) {
    const Result<MaterialPackage> package =
            compile(withProperties("blending : masked, maskThreshold : 0.7, shadingModel : unlit"));
    ASSERT_TRUE(package) << package.error().message;
    EXPECT_EQ(package->maskThreshold, 0.7f);
    ASSERT_NE(package->findParameter("_maskThreshold"), nullptr);
    EXPECT_EQ(package->findParameter("_maskThreshold")->type, ParameterType::Float);
    EXPECT_EQ(package->uniformBytes, 16u);
}

// ---------------------------------------------------------------------------------------------- errors

/// EngineMaterials.TakeDerivativesBeforeTheyDiscard says why. Those materials have neither of these properties.
TEST(MaterialCompiler, TakesTheDerivativesOfMaskedMaterialsBeforeTheyDiscard) {
    for (const char* model : { "lit", "cloth", "subsurface", "specularGlossiness", "unlit, shadowMultiplier : true" }) {
        const std::string text = withProperties(fmt::format(
                "name : a, blending : masked, alphaToCoverage : true, specularAntiAliasing : true, shadingModel : {}",
                model));
        const Result<MaterialPackage> package = compile(text);
        ASSERT_TRUE(package) << package.error().message;
        size_t differentiating = 0;
        for (Variant const& variant : package->variants) {
            const test::DerivativeUse use = test::derivativeUse(variant.fragment->spirv);
            EXPECT_EQ(use.afterDiscard, 0u) << model << ' ' << int{ variant.key };
            differentiating += use.hasDiscard && use.beforeDiscard > 0;
        }
        EXPECT_GT(differentiating, 0u) << model;
    }
}

TEST(MaterialCompiler, SuggestsTheNameThatWasProbablyMeant) {
    EXPECT_EQ(failureOf(withProperties("shadingModle : lit")).message,
              "wood.mat:2: there is no property 'shadingModle'; did you mean 'shadingModel'?");
    EXPECT_THAT(failureOf(withProperties("blending : transparant")).message, HasSubstr("did you mean 'transparent'?"));
    EXPECT_THAT(failureOf(withProperties("requires : [ uvO ]")).message, HasSubstr("did you mean 'uv0'?"));
    EXPECT_THAT(failureOf(withProperties("parameters : [ { name : a, type : flaot } ]")).message,
                HasSubstr("did you mean 'float'?"));
    EXPECT_THAT(failureOf(withProperties("parameters : [ { nmae : a, type : float } ]")).message,
                HasSubstr("did you mean 'name'?"));
    EXPECT_THAT(failureOf(withProperties("variantFilter : [ dynamicLightning ]")).message,
                HasSubstr("did you mean 'dynamicLighting'?"));
}

TEST(MaterialCompiler, RefusesValuesOutsideOfTheirRangeOrType) {
    for (const char* properties : { "maskThreshold : 1.5",
                                    "maskThreshold : high",
                                    "doubleSided : 1",
                                    "requires : uv0",
                                    "parameters : {}",
                                    "parameters : [ { name : 9lives, type : float } ]",
                                    "parameters : [ { name : gl_x, type : float } ]",
                                    "parameters : [ { name : a, type : float }, { name : a, type : int } ]",
                                    "parameters : [ { name : a } ]",
                                    "parameters : [ { name : a, type : float[0] } ]",
                                    "parameters : [ { name : a, type : float[99999999999] } ]",
                                    "parameters : [ { name : a, type : float[2000] } ]",
                                    "parameters : [ { name : a, type : sampler2d[4] } ]",
                                    "constants : [ { name : a, type : bool, default : 3 } ]",
                                    "constants : [ { name : a, type : int, default : 0.5 } ]",
                                    "constants : [ { name : a, type : float3 } ]",
                                    "variables : [ a, b, c, d, e, f ]",
                                    "variables : [ a, a ]",
                                    "name : a, name : b",
                                    "domain : postprocess, shadingModel : lit",
                                    "fullScreenTriangle : true",
                                    "parameters : [ { name : a, type : subpassInput } ]" }) {
        const Error error = failureOf(withProperties(properties));
        EXPECT_EQ(error.code, ErrorCode::InvalidArgument) << properties << ": " << error.message;
        EXPECT_TRUE(error.message.starts_with("wood.mat:")) << error.message;
    }
}

TEST(MaterialCompiler, ReportsGlslErrorsAtTheLineOfTheAuthorsFile) {
    EXPECT_THAT(failureOf("material {\n shadingModel : lit\n}\n\nfragment {\n    void material(inout MaterialInputs "
                          "material) {\n"
                          "        prepareMaterial(material);\n        material.metalic = 1.0;\n    }\n}\n")
                        .message,
                HasSubstr("wood.mat:8: 'metalic'"));
    EXPECT_THAT(failureOf("material { shadingModel : unlit }\nvertex {\n\n void materialVertex(inout "
                          "MaterialVertexInputs m) { oops; }\n}" +
                          std::string(kEmptyFragment))
                        .message,
                HasSubstr("wood.mat:4: 'oops'"));
}

TEST(MaterialCompiler, ReportsGlslErrorsOfIncludedFilesThere) {
    CompileOptions options;
    options.includes = [](std::string_view path) -> std::optional<std::string> {
        return path == "noise.glsl" ? std::optional<std::string>("float a;\nfloat noise() { return b; }\n")
                                    : std::nullopt;
    };
    const std::string text = "material { shadingModel : unlit }\nfragment {\n#include \"noise.glsl\"\nvoid "
                             "material(inout MaterialInputs m) { prepareMaterial(m); }\n}";
    const Result<MaterialPackage> package = compile(text, options);
    ASSERT_FALSE(package);
    EXPECT_THAT(package.error().message, HasSubstr("noise.glsl:2: 'b'"));
    EXPECT_THAT(failureOf(text).message, HasSubstr("wood.mat:3: cannot find the file \"noise.glsl\""));
}

TEST(MaterialCompiler, SaysWhichFunctionABlockMustDefine) {
    EXPECT_THAT(failureOf("material {}\nfragment { void main2() {} }").message,
                HasSubstr("void material(inout MaterialInputs material)"));
    EXPECT_THAT(failureOf("material {}\nvertex { void main2() {} }" + std::string(kEmptyFragment)).message,
                HasSubstr("materialVertex"));
    EXPECT_THAT(failureOf("material { domain : postprocess }").message, HasSubstr("there is no fragment block"));
}

// ---------------------------------------------------------------------------------------------- variants and layout

TEST(MaterialCompiler, CompilesOneVariantAloneWithTheBytesThatItHasAmongAll) {
    const Result<MaterialPackage> all = compile(withProperties("")),
                                  one = compile(withProperties(""), { .onlyVariant = kVariantSun });
    ASSERT_TRUE(all && one);
    ASSERT_EQ(one->variants.size(), 1u);
    const auto same = std::ranges::find(all->variants, kVariantSun, &Variant::key);
    EXPECT_EQ(one->variants[0].fragment->spirv, same->fragment->spirv);
    EXPECT_EQ(one->variants[0].vertex->essl, same->vertex->essl);
    const Result<MaterialPackage> none =
            compile(withProperties("shadingModel : unlit"), { .onlyVariant = kVariantSun });
    ASSERT_FALSE(none);
    EXPECT_THAT(none.error().message, HasSubstr("wood.mat: the material has no variant 1"));
}

TEST(MaterialCompiler, KnowsTheNamesOfFiltersInAnyCase) {
    const std::string known[] = { "skinning", "ShadowReceiver" }, unknown[] = { "skining" };
    const Result<uint16_t> bits = variantBitsOfFilters(known), none = variantBitsOfFilters(unknown);
    ASSERT_TRUE(bits);
    EXPECT_EQ(*bits, kVariantSkinning | kVariantShadowReceiver);
    ASSERT_FALSE(none);
    EXPECT_THAT(none.error().message, HasSubstr("there is no variant 'skining'; did you mean 'skinning'?"));
}

TEST(MaterialCompiler, CompilesEveryVariantThatAStateCanSelectAndNoOther) {
    const auto keys = [](std::string_view properties, uint8_t filtered = 0) {
        const Result<MaterialPackage> package = compile(withProperties(properties), { .filteredVariants = filtered });
        EXPECT_TRUE(package) << (package ? "" : package.error().message);
        std::vector<int> found;
        for (Variant const& variant : package->variants) found.push_back(variant.key);
        return found;
    };
    EXPECT_EQ(keys("shadingModel : lit"),
              (std::vector<int>{ 0, 1, 2, 3, 5, 6, 7, 8, 9, 10, 11, 13, 14, 15, 1024, 1032, 4096, 4104 }));
    EXPECT_EQ(keys("shadingModel : unlit"),
              (std::vector<int>{ 0, kVariantSkinning, kVariantDepth, kVariantDepth | kVariantSkinning, kVariantDebug,
                                 kVariantDebug | kVariantSkinning }));
    EXPECT_EQ(keys("shadingModel : unlit, shadowMultiplier : true, blending : transparent"),
              (std::vector<int>{ 0, kVariantShadowReceiver, kVariantSkinning, kVariantShadowReceiver | kVariantSkinning,
                                 kVariantDebug, kVariantDebug | kVariantSkinning }));
    EXPECT_EQ(keys("shadingModel : lit, variantFilter : [ shadowReceiver, skinning ]"),
              (std::vector<int>{ 0, 1, 2, 3, kVariantDepth, kVariantDebug }));
    EXPECT_EQ(keys("shadingModel : unlit, blending : fade"),
              (std::vector<int>{ 0, kVariantSkinning, kVariantDebug, kVariantDebug | kVariantSkinning }))
            << "what blends leaves no depth";
    EXPECT_EQ(keys("shadingModel : unlit, vertexDomain : device"),
              (std::vector<int>{ 0, kVariantDepth, kVariantMotion, kVariantDebug }))
            << "only what is given in object space can be deformed, and what goes with the camera says so";
    EXPECT_EQ(keys("shadingModel : unlit, vertexDomain : world"),
              (std::vector<int>{ 0, kVariantDepth, kVariantDebug }));
    EXPECT_EQ(keys("shadingModel : lit, variantFilter : [ dynamicLighting, skinning ]"),
              (std::vector<int>{ 0, kVariantSun, kVariantSun | kVariantShadowReceiver, kVariantDepth, kVariantDebug }));
    EXPECT_EQ(keys("shadingModel : lit, variantFilter : [ directionalLighting ]", kVariantPunctual),
              (std::vector<int>{ 0, kVariantSkinning, kVariantDepth, kVariantDepth | kVariantSkinning, kVariantDebug,
                                 kVariantDebug | kVariantSkinning }));
    EXPECT_EQ(keys("shadingModel : unlit, variantFilter : [ debugViews, skinning ]"),
              (std::vector<int>{ 0, kVariantDepth }));
}

/// Only tools pay for debug views: everything else has the bytes that it has without them.
TEST(MaterialCompiler, KeepsEveryOtherVariantAsItIsWithoutDebugViews) {
    for (const char* properties :
         { "shadingModel : lit, requires : [ uv0 ]", "shadingModel : unlit, blending : masked",
           "shadingModel : cloth, blending : fade", "shadingModel : subsurface, variantFilter : [ skinning ]",
           "shadingModel : specularGlossiness, vertexDomain : world" }) {
        const Result<MaterialPackage> with = compile(withProperties(properties));
        const Result<MaterialPackage> without =
                compile(withProperties(properties), { .filteredVariants = kVariantDebug });
        ASSERT_TRUE(with && without) << properties;
        std::vector<Variant> others = with->variants;
        const size_t debug = std::erase_if(others, [](Variant const& v) { return (v.key & kVariantDebug) != 0; });
        EXPECT_GE(debug, 1u) << properties;
        EXPECT_EQ(others, without->variants) << properties;
        EXPECT_EQ(with->layout, without->layout) << properties;
        EXPECT_EQ(with->requiredAttributes, without->requiredAttributes) << properties;
        for (Variant const& variant : with->variants) {
            if ((variant.key & kVariantDebug) == 0) continue;
            EXPECT_EQ(variant.vertex->spirv, with->findVariant(variant.key & kVariantSkinning)->vertex->spirv);
            EXPECT_EQ(test::validationErrors(variant.fragment->spirv), "");
        }
    }
}

TEST(MaterialCompiler, DeformsInTheVertexStageAlone) {
    const Result<MaterialPackage> all = compile(withProperties("shadingModel : lit"));
    const Result<MaterialPackage> still = compile(withProperties("shadingModel : lit, variantFilter : [ skinning ]"));
    ASSERT_TRUE(all) << all.error().message;
    ASSERT_TRUE(still);
    EXPECT_EQ(all->requiredAttributes, still->requiredAttributes) << "what has no skin needs no joints";
    EXPECT_EQ(all->layout, still->layout);
    EXPECT_EQ(all->layout[kGroupDeformation].count, 0);
    for (Variant const& variant : still->variants) {
        EXPECT_EQ(variant, *all->findVariant(variant.key)) << "what is not deformed keeps its code";
        Variant const* deformed = all->findVariant(variant.key | kVariantSkinning);
        ASSERT_TRUE(deformed);
        EXPECT_EQ(deformed->fragment->spirv, variant.fragment->spirv);
        EXPECT_EQ(deformed->fragment->essl, variant.fragment->essl);
        EXPECT_NE(deformed->vertex->spirv, variant.vertex->spirv);
        EXPECT_EQ(test::validationErrors(deformed->vertex->spirv), "");
    }
}

TEST(MaterialCompiler, GivesUpJointsFiveToEightForCustomAttributesInTheirPlaces) {
    const auto vertexOf = [](std::string_view properties) {
        const Result<MaterialPackage> package = compile(withProperties(properties));
        EXPECT_TRUE(package) << (package ? "" : package.error().message);
        return package ? package->findVariant(kVariantSkinning)->vertex->essl : std::string();
    };
    EXPECT_THAT(vertexOf("shadingModel : unlit"), HasSubstr("mesh_weights1"));
    EXPECT_THAT(vertexOf("shadingModel : unlit, requires : [ custom6 ]"), Not(HasSubstr("mesh_weights1")));
}

TEST(MaterialCompiler, LightsInHalfPrecisionIfEnabledAndKeepsTheOtherVariants) {
    const Result<MaterialPackage> plain = compile(withProperties("shadingModel : lit, variantFilter : [ skinning ]"));
    const Result<MaterialPackage> both =
            compile(withProperties("shadingModel : lit, halfPrecision : true, variantFilter : [ skinning ]"));
    ASSERT_TRUE(plain);
    ASSERT_TRUE(both) << both.error().message;
    size_t lit = 0;
    for (Variant const& full : plain->variants) {
        ASSERT_NE(both->findVariant(full.key), nullptr) << full.key;
        EXPECT_EQ(*both->findVariant(full.key), full);
        if ((full.key & (kVariantDepth | kVariantDebug)) != 0) continue; // have one precision
        ++lit;
        ASSERT_NE(both->findVariant(full.key | kVariantHalf), nullptr) << full.key;
        Variant const& half = *both->findVariant(full.key | kVariantHalf);
        EXPECT_EQ(half.vertex->spirv, full.vertex->spirv) << "positions keep their precision";
        EXPECT_EQ(test::validationErrors(half.fragment->spirv), "");
        EXPECT_THAT(test::disassembly(half.fragment->spirv), HasSubstr("OpCapability Float16"));
        EXPECT_THAT(test::disassembly(half.fragment->spirv), HasSubstr("OpFMul %v3half"));
        EXPECT_THAT(test::disassembly(full.fragment->spirv), Not(HasSubstr("Float16")));
        EXPECT_THAT(half.fragment->essl, HasSubstr("mediump vec3"));
        EXPECT_THAT(full.fragment->essl, Not(HasSubstr("mediump vec3")));
    }
    EXPECT_GT(lit, 0u);
    EXPECT_EQ(both->variants.size(), plain->variants.size() + lit);
    EXPECT_THAT(
            failureOf("material { shadingModel : unlit, halfPrecision : true }" + std::string(kEmptyFragment)).message,
            HasSubstr("halfPrecision is only for lit materials"));
}

TEST(MaterialCompiler, KeepsAllBitsOfMediumPrecisionUnlessInexact) {
    const char* const text = R"(material { shadingModel : unlit, requires : [ uv0 ],
        parameters : [ { name : map, type : sampler2d, precision : medium }, { name : tint, type : float4, precision : low } ] }
        fragment { void material(inout MaterialInputs m) {
            prepareMaterial(m);
            mediump vec4 own = texture(materialParams_map, getUV0());
            m.baseColor = own * materialParams.tint; } })";
    for (const bool exact : { true, false }) {
        const Result<MaterialPackage> package = compileMaterial(text, "a.mat", { .exact = exact });
        ASSERT_TRUE(package) << package.error().message;
        const std::string& essl = package->variants[0].fragment->essl;
        EXPECT_EQ(essl.find("uniform mediump") == std::string::npos, exact) << essl;
        EXPECT_EQ(essl.find("mediump vec4") == std::string::npos, exact) << essl;
    }
}

TEST(MaterialCompiler, GivesAllSurfaceMaterialsTheSameViewGroup) {
    const Result<MaterialPackage> unlit = compile(withProperties("shadingModel : unlit"));
    const Result<MaterialPackage> lit = compile(withProperties("shadingModel : lit"));
    ASSERT_TRUE(unlit && lit);
    EXPECT_EQ(unlit->layout[kGroupView], viewGroupLayout());
    EXPECT_EQ(lit->layout[kGroupView], viewGroupLayout());
    EXPECT_EQ(unlit->layout[kGroupPass], passGroupLayout(PassKind::Unlit));
    EXPECT_EQ(lit->layout[kGroupPass], passGroupLayout(PassKind::Lit));
}

constexpr const char* kBlend = R"(material { domain : postprocess,
    parameters : [ { name : a, type : sampler2d, currentPixel : true }, { name : map, type : sampler2d },
                   { name : b, type : sampler2d, currentPixel : true } ] }
    fragment { void postProcess(inout PostProcessInputs inputs) {
        inputs.color = getCurrentPixel(materialParams_a) * texture(materialParams_map, getNormalizedUV())
                + getCurrentPixel(materialParams_b); } })";

TEST(MaterialCompiler, MakesTexturesAndSubpassInputsOfWhatReadsItsOwnPixel) {
    using enum backend::BindingType;
    const Result<MaterialPackage> package = compile(kBlend);
    ASSERT_TRUE(package) << package.error().message;
    ASSERT_EQ(package->variants.size(), 2u);
    const auto sampled = programLayout(*package, 0)[kGroupMaterial].bindings;
    for (int i = 0; i < 3; ++i) EXPECT_EQ(sampled[i].type, SampledTexture);
    std::string const& alone = package->findVariant(0)->fragment->essl;
    EXPECT_THAT(alone, HasSubstr("layout(location = 0) out"));
    EXPECT_THAT(alone, HasSubstr("texelFetch(materialParams_a"));

    const auto merged = programLayout(*package, kVariantMerged)[kGroupMaterial].bindings;
    const backend::BindingType types[] = { InputAttachment, SampledTexture, InputAttachment };
    for (int i = 0; i < 3; ++i) EXPECT_EQ(merged[i].type, types[i]);
    EXPECT_EQ(merged[2].inputAttachment, 1);
    std::string const& behind = package->findVariant(kVariantMerged)->fragment->essl;
    EXPECT_THAT(behind, HasSubstr("layout(location = 0) inout"));
    EXPECT_THAT(behind, HasSubstr("layout(location = 1) inout"));
    EXPECT_THAT(behind, HasSubstr("layout(location = 2) out"));
    EXPECT_THAT(behind, Not(HasSubstr("texelFetch")));
}

TEST(MaterialCompiler, MergesNothingThatReadsOtherPixels) {
    const Result<MaterialPackage> package = compile(R"(material { domain : postprocess,
        parameters : [ { name : a, type : sampler2d }, { name : b, type : sampler2d, currentPixel : false } ] }
        fragment { void postProcess(inout PostProcessInputs inputs) {
            inputs.color = texture(materialParams_a, getNormalizedUV()) + texture(materialParams_b, vec2(0.0)); } })");
    ASSERT_TRUE(package) << package.error().message;
    EXPECT_EQ(package->variants.size(), 1u);
}

TEST(MaterialCompiler, SeesThatATextureIsReadOnlyWhereOneOfItsConstantsIsTrue) {
    const auto reads = [](const char* code) {
        return compile(std::string(R"(material { requires : [ uv0 ],
            constants : [ { name : hasA, type : bool }, { name : hasB, type : bool }, { name : n, type : int } ],
            parameters : [ { name : map, type : sampler2d, usedIf : [ hasA, hasB ] } ] }
            fragment {
            vec4 texel() { return texture(materialParams_map, getUV0()); }
            void material(inout MaterialInputs m) { prepareMaterial(m); )") +
                       code + " } }");
    };
    for (const char* good : { "if (materialConstants_hasA || materialConstants_hasB) m.baseColor = texel();",
                              "if (materialConstants_hasA) m.baseColor = texel();",
                              "if (materialConstants_hasB) { for (int i = 0; i < materialConstants_n; ++i) "
                              "m.baseColor += texel(); }",
                              "m.baseColor = materialConstants_hasA ? texel() : vec4(1.0);", "m.metallic = 1.0;" }) {
        const Result<MaterialPackage> package = reads(good);
        ASSERT_TRUE(package) << good << ": " << package.error().message;
        EXPECT_EQ(package->findParameter("map")->usedIf, (std::vector<uint32_t>{ 0, 1 }));
    }
    for (const char* bad :
         { "m.baseColor = texel();", "if (materialConstants_n > 0) m.baseColor = texel();",
           "if (!materialConstants_hasA) m.baseColor = texel();", "if (m.baseColor.x > 0.5) m.baseColor = texel();" })
        EXPECT_FALSE(reads(bad)) << bad;
}

TEST(MaterialCompiler, ReadsAttachmentsInOrderAndWritesTheOneBehindThem) {
    const Result<MaterialPackage> package = compile(R"(material { domain : postprocess,
        parameters : [ { name : a, type : subpassInput }, { name : b, type : subpassInput } ] }
        fragment { void postProcess(inout PostProcessInputs inputs) {
            inputs.color = subpassLoad(materialParams_a) + subpassLoad(materialParams_b); } })");
    ASSERT_TRUE(package) << package.error().message;
    EXPECT_EQ(package->layout[kGroupView], viewGroupLayout());
    EXPECT_EQ(package->layout[kGroupPass], passGroupLayout(PassKind::Picture));
    EXPECT_EQ(package->layout[kGroupMaterial].bindings[1].inputAttachment, 1);
    std::string const& essl = package->variants[0].fragment->essl;
    EXPECT_THAT(essl, HasSubstr("layout(location = 0) inout"));
    EXPECT_THAT(essl, HasSubstr("layout(location = 1) inout"));
    EXPECT_THAT(essl, HasSubstr("layout(location = 2) out"));
    EXPECT_EQ(package->requiredAttributes, 0u);
}

TEST(MaterialCompiler, GivesTheSameBytesForAnyNumberOfWorkers) {
    const std::string text = withProperties("shadingModel : lit");
    const std::vector<std::byte> serial = writePackage(compile(text).value());
    for (const int workers : { 0, 1, 3 }) {
        jobs::JobSystem jobs({ .workers = workers });
        EXPECT_EQ(writePackage(compile(text, { .jobs = &jobs }).value()), serial) << workers;
    }
}

TEST(MaterialCompiler, LeavesOutUnrequestedLanguages) {
    const Result<MaterialPackage> vulkan = compile(withProperties("shadingModel : unlit"), { .essl = false });
    ASSERT_TRUE(vulkan);
    EXPECT_TRUE(vulkan->variants[0].vertex->essl.empty() && vulkan->variants[0].fragment->essl.empty());
    EXPECT_FALSE(vulkan->variants[0].fragment->spirv.empty());
    const Result<MaterialPackage> gles = compile(withProperties("shadingModel : unlit"), { .spirv = false });
    ASSERT_TRUE(gles);
    EXPECT_TRUE(gles->variants[0].vertex->spirv.empty() && gles->variants[0].fragment->spirv.empty());
    EXPECT_FALSE(gles->variants[0].fragment->essl.empty());
}

// ---------------------------------------------------------------------------------------------- what costs nothing

TEST(MaterialCompiler, PaysOnlyForPropertiesThatTheCodeSets) {
    const std::string plain =
            fragmentOf("void material(inout MaterialInputs m) { prepareMaterial(m); m.roughness = 0.5; }");
    for (const char* define : { "#define HAS_NORMAL", "#define HAS_EMISSIVE", "#define HAS_AMBIENT_OCCLUSION",
                                "#define NEEDS_TANGENT", "#define HAS_POST_LIGHTING_COLOR", "#define HAS_UV0" }) {
        EXPECT_THAT(plain, Not(HasSubstr(define)));
    }
    EXPECT_THAT(fragmentOf("void material(inout MaterialInputs m) { m.normal.xy = vec2(0.1); prepareMaterial(m); }"),
                HasSubstr("#define NEEDS_TANGENT"));
    EXPECT_THAT(fragmentOf("void glow(inout MaterialInputs x) { x . emissive = vec4(1); } void material(inout "
                           "MaterialInputs m) { prepareMaterial(m); glow(m); }"),
                HasSubstr("#define HAS_EMISSIVE"));
}

TEST(MaterialCompiler, IsNotFooledByCommentsOrParametersOfTheSameName) {
    const std::string text =
            fragmentOf("void material(inout MaterialInputs m) { prepareMaterial(m); /* m.normal */ // m.emissive\n"
                       " m.roughness = materialParams.emissive; }",
                       "parameters : [ { name : emissive, type : float } ]");
    EXPECT_THAT(text, Not(HasSubstr("#define HAS_NORMAL")));
    EXPECT_THAT(text, Not(HasSubstr("#define HAS_EMISSIVE")));
}

TEST(MaterialCompiler, FlipsUvUnlessTold) {
    EXPECT_THAT(fragmentOf("void material(inout MaterialInputs m) { prepareMaterial(m); }"),
                HasSubstr("#define FLIP_UV"));
    EXPECT_THAT(fragmentOf("void material(inout MaterialInputs m) { prepareMaterial(m); }", "flipUV : false"),
                Not(HasSubstr("#define FLIP_UV")));
}

// ---------------------------------------------------------------------------------------------- the public shader API

TEST(MaterialCompiler, OffersTheFunctionsOfTheGuide) {
    const Result<MaterialPackage> package =
            compile(R"(material { shadingModel : lit, requires : [ uv0, uv1, color, custom0, custom7 ],
        variables : [ eyeDirection, { name : tint, precision : medium } ], blending : masked, specularAntiAliasing : true }
    vertex {
        void materialVertex(inout MaterialVertexInputs material) {
            material.color *= getCustom0() + getCustom7();
            material.uv0 *= getUserTime().x;
            material.worldPosition.xyz += mulMat3x3Float3(getWorldFromViewMatrix(), getPosition().xyz) * getTime();
            material.worldNormal = getWorldFromModelNormalMatrix() * material.worldNormal;
            material.eyeDirection = getWorldFromModelMatrix() * mulMat4x4Float3(getViewFromClipMatrix(), float3(1.0));
            material.tint = float4(getVertexIndex() + getEyeIndex());
        }
    }
    fragment {
        void material(inout MaterialInputs material) {
            material.normal = float3(0.0, 0.0, 1.0);
            float3 geometric = getWorldGeometricNormalVector();
            prepareMaterial(material);
            material.baseColor = getColor() * variable_tint + variable_eyeDirection * luminance(float3(PI, HALF_PI, max3(geometric)));
            material.baseColor.rgb += getWorldPosition() + getUserWorldPosition() + getWorldViewVector() + getWorldNormalVector()
                    + getWorldReflectedVector() + getNormalizedViewportCoord() + getWorldTangentFrame()[0] + getWorldCameraPosition();
            material.baseColor.xy += getUV0() + getUV1() + uvToRenderTargetUV(getResolution().zw);
            material.roughness = saturate(getNdotV() + sq(getExposure()) + pow5(getEV100()) + getUserTimeMod(3.0)) + getMaskThreshold();
            material.postLightingColor = (getUserWorldFromWorldMatrix() * getClipFromWorldMatrix() * getWorldFromClipMatrix())[0];
        }
    })");
    ASSERT_TRUE(package) << package.error().message;
    EXPECT_EQ(package->requiredAttributes, 1u << 0 | 1u << 1 | 1u << 2 | 1u << 3 | 1u << 4 | 1u << 7 | 1u << 14);
    for (Variant const& variant : package->variants) {
        EXPECT_EQ(test::validationErrors(variant.vertex->spirv), "") << int{ variant.key };
        EXPECT_EQ(test::validationErrors(variant.fragment->spirv), "") << int{ variant.key };
    }
}

TEST(MaterialCompiler, CompilesEveryVertexDomainAndBlending) {
    for (const char* domain : { "object", "world", "view", "device" }) {
        for (const char* blending : { "opaque", "masked", "transparent", "fade", "add", "multiply", "screen" }) {
            const Result<MaterialPackage> package =
                    compile("material { vertexDomain : " + std::string(domain) + ", blending : " + blending +
                            ", doubleSided : true, variantFilter : [ dynamicLighting ] }\nfragment { void "
                            "material(inout MaterialInputs m) {"
                            " m.normal = vec3(0, 0, 1); prepareMaterial(m); m.emissive = vec4(1.0); m.ambientOcclusion "
                            "= 0.5; } }");
            ASSERT_TRUE(package) << domain << " " << blending << ": " << package.error().message;
            for (Variant const& variant : package->variants) {
                EXPECT_EQ(test::validationErrors(variant.vertex->spirv), "") << domain;
                EXPECT_EQ(test::validationErrors(variant.fragment->spirv), "") << blending;
            }
        }
    }
}

} // namespace
} // namespace filament_core::shader
