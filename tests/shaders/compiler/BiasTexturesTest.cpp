// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/BiasTextures.h"

#include "shaders/compiler/MaterialCompiler.h"
#include "shaders/compiler/SpirvWords.h"
#include "shaders/interface/ShaderInterface.h"
#include "tests/shaders/compiler/SpirvTools.h"

#include <gtest/gtest.h>

namespace filament_core::shader {
namespace {

/// Look-ups of a module, with and without a bias, and by gradients.
struct LookUps {
    int plain = 0, biased = 0, byGradients = 0, others = 0;
    friend bool operator==(LookUps const&, LookUps const&) = default;
};
void PrintTo(LookUps const& l, std::ostream* out) {
    *out << l.plain << " plain, " << l.biased << " biased, " << l.byGradients << " by gradients, " << l.others;
}

bool readsMipBias(Variant const& variant) {
    const std::string constant = "SPIRV_CROSS_CONSTANT_ID_" + std::to_string(kQualityMipBias);
    return variant.fragment->essl.find(constant) != std::string::npos;
}

LookUps lookUpsOf(std::span<const uint32_t> module) {
    LookUps found;
    forEachInstruction(module, [&](spv::Op op, std::span<const uint32_t> words) {
        const uint32_t mask = words.size() > 5 ? words[5] : 0;
        if (op == spv::OpImageSampleImplicitLod || op == spv::OpImageSampleProjImplicitLod)
            ++((mask & spv::ImageOperandsBiasMask) != 0 ? found.biased : found.plain);
        if (op == spv::OpImageSampleExplicitLod)
            ++((mask & spv::ImageOperandsGradMask) != 0 ? found.byGradients : found.others);
    });
    return found;
}

Variant compiled(std::string_view code) {
    const Result<MaterialPackage> material = compileMaterial(
            fmt::format("material {{ name : m, shadingModel : unlit, requires : [ uv0 ], variantFilter : [ fog, "
                        "skinning ],\n"
                        "parameters : [ {{ type : sampler2d, name : a }}, {{ type : samplerCubemap, name : b }} ] }}\n"
                        "fragment {{ {} }}",
                        code),
            "a.mat");
    if (!material) {
        ADD_FAILURE() << material.error().message;
        return {};
    }
    return *material->findVariant(0);
}

std::string inMaterial(std::string_view code) {
    return fmt::format("void material(inout MaterialInputs m) {{ prepareMaterial(m); m.baseColor = {}; }}", code);
}

TEST(BiasTextures, MakesEveryLookUpByDerivativesASecondTimeWithABias) {
    const std::pair<const char*, LookUps> cases[] = {
        { "texture(materialParams_a, getUV0())", { 1, 1, 0, 0 } },
        { "texture(materialParams_b, vec3(getUV0(), 1.0))", { 1, 1, 0, 0 } },
        { "textureProj(materialParams_a, vec3(getUV0(), 1.5))", { 1, 1, 0, 0 } },
        { "textureOffset(materialParams_a, getUV0(), ivec2(1, 2))", { 1, 1, 0, 0 } },
        { "texture(materialParams_a, getUV0(), 0.5)", { 0, 2, 0, 0 } },
        { "textureGrad(materialParams_a, getUV0(), vec2(0.1), vec2(0.2))", { 0, 0, 2, 0 } },
        { "textureLod(materialParams_a, getUV0(), 2.0)", { 0, 0, 0, 1 } },
        { "texelFetch(materialParams_a, ivec2(3), 0)", { 0, 0, 0, 0 } },
    };
    for (auto const& [code, expected] : cases) {
        const Variant variant = compiled(inMaterial(code));
        EXPECT_EQ(lookUpsOf(variant.fragment->spirv), expected) << code;
        EXPECT_EQ(test::validationErrors(variant.fragment->spirv), "") << code;
        EXPECT_EQ(readsMipBias(variant), expected.biased + expected.byGradients > 0) << code;
    }
}

TEST(BiasTextures, FindsLookUpsInFunctionsMacrosAndLoops) {
    const Variant variant = compiled("#define LOOK(image, at) texture(image, at)\n"
                                     "vec4 seen(sampler2D image, vec2 at) { return LOOK(image, at); }\n"
                                     "void material(inout MaterialInputs m) { prepareMaterial(m);\n"
                                     "for (int i = 0; i < int(getUV0().x * 9.0); ++i)\n"
                                     "    m.baseColor += seen(materialParams_a, getUV0() * float(i)); }");
    EXPECT_EQ(lookUpsOf(variant.fragment->spirv), (LookUps{ 1, 1, 0, 0 }));
    EXPECT_EQ(test::validationErrors(variant.fragment->spirv), "");
}

TEST(BiasTextures, LeavesWhatHasNoTexturesAndWhatDrawsPicturesAlone) {
    const Variant plain = compiled(inMaterial("vec4(getUV0(), 0.0, 1.0)"));
    EXPECT_FALSE(readsMipBias(plain));
    const Result<MaterialPackage> picture = compileMaterial(
            "material { name : p, domain : postprocess, parameters : [ { type : sampler2d, name : a } ] }\n"
            "fragment { void postProcess(inout PostProcessInputs p) {\n"
            "p.color = texture(materialParams_a, getNormalizedUV()); } }",
            "p.mat");
    ASSERT_TRUE(picture) << picture.error().message;
    EXPECT_EQ(lookUpsOf(picture->findVariant(0)->fragment->spirv), (LookUps{ 1, 0, 0, 0 }));
}

} // namespace
} // namespace filament_core::shader
