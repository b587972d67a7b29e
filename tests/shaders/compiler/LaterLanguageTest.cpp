// SPDX-License-Identifier: Apache-2.0
// What later versions of the language have: fields of parameters, outputs of effects, a fifth variable, bumps.
#include "shaders/compiler/MaterialCompiler.h"
#include "tests/shaders/compiler/SpirvTools.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace filament_core::shader {
namespace {

std::string surfaceOfLater(std::string const& head, std::string const& code = "", std::string const& vertex = "") {
    return "material {\n" + head + " }\n" + vertex +
           "fragment { void material(inout MaterialInputs material) { prepareMaterial(material);\n" + code + "\n} }";
}

std::string effectOfLater(std::string const& head, std::string const& code) {
    return "material { domain : postprocess,\n" + head +
           " }\nfragment { void postProcess(inout PostProcessInputs inputs) {\n" + code + "\n} }";
}

Result<MaterialPackage> packageOfLater(std::string const& text) {
    Result<MaterialPackage> package = compileMaterial(text, "a.mat", { .filteredVariants = kAllVariantBits });
    if (package) {
        for (Variant const& variant : package->variants) {
            EXPECT_EQ(test::validationErrors(variant.vertex->spirv), "") << text;
            EXPECT_EQ(test::validationErrors(variant.fragment->spirv), "") << text;
        }
    }
    return package;
}

std::string messageOfLater(std::string const& text) {
    const Result<MaterialPackage> package = packageOfLater(text);
    return package ? "compiles" : package.error().message;
}

std::string parametersOfLater(std::string const& entries) { return "parameters : [\n" + entries + " ]"; }

TEST(LaterLanguage, LeavesTheVertexBlockOutOfDepthIfTheMaterialAsksForIt) {
    const std::string head = "variables : [ wave ]";
    const std::string block = "vertex { void materialVertex(inout MaterialVertexInputs m) { m.wave = "
                              "vec4(getUserTime().x); } }\n";
    const auto with = compileMaterial(surfaceOfLater(head + ", useDefaultDepthVariant : true", "", block), "a.mat");
    const auto all = compileMaterial(surfaceOfLater(head, "", block), "a.mat");
    const auto none = compileMaterial(surfaceOfLater(head), "a.mat");
    ASSERT_TRUE(with && all && none) << with.error().message;
    EXPECT_TRUE(all->depthReadsParameters);
    EXPECT_FALSE(with->depthReadsParameters);
    for (Variant const& variant : with->variants) {
        MaterialPackage const& same = (variant.key & kVariantDepth) != 0 ? *none : *all;
        ASSERT_NE(same.findVariant(variant.key), nullptr) << variant.key;
        EXPECT_EQ(*same.findVariant(variant.key), variant) << variant.key;
    }
}

TEST(LaterLanguage, HasMultisampledTextures) {
    const std::string marked = "{ type : sampler2d, name : x, multisample : true }";
    const std::string read = "inputs.color = texelFetch(materialParams_x, ivec2(gl_FragCoord.xy), 0);";
    const auto package = packageOfLater(effectOfLater(parametersOfLater(marked), read));
    ASSERT_TRUE(package) << package.error().message;
    EXPECT_EQ(package->findParameter("x")->type, ParameterType::Sampler2DMS);
    EXPECT_EQ(package->variants,
              packageOfLater(effectOfLater(parametersOfLater("{ type : sampler2dMS, name : x }"), read))->variants);
    EXPECT_EQ(messageOfLater(surfaceOfLater(parametersOfLater("{ type : sampler2d, name : x, multisample : false }"))),
              "compiles");
    EXPECT_EQ(messageOfLater(surfaceOfLater(parametersOfLater(marked))),
              "a.mat:3: a sampler2dMS exists only in the domain postprocess");
    EXPECT_EQ(messageOfLater(
                      effectOfLater(parametersOfLater("{ type : samplerCubemap, name : x, multisample : true }"), "")),
              "a.mat:3: only a sampler2d without currentPixel can be multisampled, and 'x' is not one");
    EXPECT_EQ(messageOfLater(surfaceOfLater(parametersOfLater("{ type : float, name : x, multisample : true }"))),
              "a.mat:3: only samplers are multisampled or filterable, and 'x' is not one");
}

TEST(LaterLanguage, SaysWhetherTexturesAreFiltered) {
    for (const char* entry :
         { "{ type : sampler2d, name : x, filterable : false }", "{ type : sampler2d, name : x, filterable : true }",
           "{ type : sampler2d, name : x, format : int, filterable : false }" })
        EXPECT_EQ(messageOfLater(surfaceOfLater(parametersOfLater(entry))), "compiles") << entry;
    EXPECT_EQ(messageOfLater(surfaceOfLater(
                      parametersOfLater("{ type : sampler2d, format : uint, name : x, filterable : true }"))),
              "a.mat:3: 'x' has whole numbers, which no device filters; leave out filterable");
    EXPECT_EQ(messageOfLater(surfaceOfLater(parametersOfLater("{ type : sampler2d, name : x, filterable : 1 }"))),
              "a.mat:3: 'filterable' must be a boolean, not a number");
}

TEST(LaterLanguage, NamesTheTransformOfExternalTextures) {
    const std::string video = "{ type : samplerExternal, name : video, transformName : turned }";
    const auto code = [](char const* place) {
        return fmt::format("material.baseColor = texture(materialParams_video, {});", place);
    };
    const auto turned =
            packageOfLater(surfaceOfLater("shadingModel : unlit, requires : [ uv0 ], " + parametersOfLater(video),
                                          code("(materialParams.turned * vec3(getUV0(), 1.0)).xy")));
    ASSERT_TRUE(turned) << turned.error().message;
    EXPECT_EQ(turned->findParameter("turned"), nullptr) << "images are not turned: it is a constant";
    EXPECT_EQ(messageOfLater(surfaceOfLater(parametersOfLater("{ type : sampler2d, name : x, transformName : y }"))),
              "a.mat:3: transformName is for parameters of the type samplerExternal");
    EXPECT_EQ(messageOfLater(surfaceOfLater(parametersOfLater("{ type : float, name : y },\n" + video +
                                                              ",\n{ type : float, name : turned }"))),
              "a.mat:5: there are two parameters 'turned'");
}

TEST(LaterLanguage, HasSeveralOutputsOfAnEffect) {
    const auto text = effectOfLater("outputs : [ { name : light, target : color, type : float3 },\n"
                                    "{ name : share, type : float, location : 2, precision : medium },\n"
                                    "{ name : distance, target : depth } ]",
                                    "inputs.light = vec3(0.5); inputs.share = 0.25; inputs.distance = 0.125;");
    const auto package = packageOfLater(text);
    ASSERT_TRUE(package) << package.error().message;
    std::string const& code = package->variants.front().fragment->essl;
    EXPECT_NE(code.find("layout(location = 0) out"), std::string::npos) << code;
    EXPECT_NE(code.find("layout(location = 2) out"), std::string::npos) << code;
    EXPECT_EQ(code.find("layout(location = 1) out"), std::string::npos) << code;
    EXPECT_NE(code.find("gl_FragDepth"), std::string::npos) << code;
    const std::string usual = "inputs.color = vec4(0.5);";
    EXPECT_EQ(packageOfLater(effectOfLater("outputs : [ { name : color } ]", usual))->variants,
              packageOfLater(effectOfLater("", usual))->variants);
}

TEST(LaterLanguage, RefusesOutputsThatContradict) {
    const auto of = [](std::string const& outputs) {
        return messageOfLater(effectOfLater("outputs : [\n" + outputs + " ]", ""));
    };
    EXPECT_EQ(of("{ name : a },\n{ name : a }"), "a.mat:4: the outputs 'a' and 'a' have the same name or place");
    EXPECT_EQ(of("{ name : a },\n{ name : b, location : 0 }"),
              "a.mat:4: the outputs 'a' and 'b' have the same name or place");
    EXPECT_EQ(of("{ name : a, target : depth },\n{ name : b, target : depth }"),
              "a.mat:4: the outputs 'a' and 'b' have the same name or place");
    EXPECT_EQ(of("{ name : a, target : depth, type : float2 }"), "a.mat:3: the output of depth is a float");
    EXPECT_EQ(of("{ name : a, target : stencil }"), "a.mat:3: 'target' cannot be 'stencil'");
    EXPECT_EQ(of("{ name : a, qualifier : inout }"),
              "a.mat:3: an output is only written; to read the pixel, declare a parameter with currentPixel : true");
    EXPECT_EQ(of("{ name : a, location : 8 }"), "a.mat:3: 'location' must lie in [0, 7], it is 8");
    const auto ofSurface = [](std::string const& outputs, std::string const& model = "unlit") {
        return messageOfLater(surfaceOfLater("shadingModel : " + model + ", outputs : [ " + outputs + " ]"));
    };
    EXPECT_EQ(ofSurface("{ name : a }", "lit"),
              "a.mat:2: outputs are for the domain postprocess and for surfaces without light; say shadingModel : "
              "unlit, and draw them by a mesh pass");
    EXPECT_EQ(ofSurface("{ name : a }, { name : b, target : depth }"),
              "a.mat:2: the depth of a surface is that of its geometry; set pixelDepthOffset to move it");
    EXPECT_EQ(ofSurface("{ name : a, location : 1 }"), "a.mat:2: one of the outputs of a surface has location 0");
    EXPECT_EQ(ofSurface("{ name : emissive }"),
              "a.mat:2: MaterialInputs has a member with the name of an output; give it another");
    EXPECT_EQ(ofSurface("{ name : roughness }"), "compiles") << "which unlit materials do not have";
}

TEST(LaterLanguage, HasSeveralOutputsOfASurface) {
    const auto package =
            compileMaterial(surfaceOfLater("shadingModel : unlit, outputs : [ { name : color, type : float2 }, { name "
                                           ": b, precision : medium },\n"
                                           "{ name : c, type : float } ]",
                                           "material.color = vec2(0.25); material.b = vec4(1.0); material.c = 0.5;"),
                            "a.mat");
    ASSERT_TRUE(package) << package.error().message;
    for (Variant const& variant : package->variants) {
        const bool isPlain = (variant.key & ~kVariantSkinning) == 0;
        std::string const& code = variant.fragment->essl;
        for (const char* location : { "layout(location = 1) out", "layout(location = 2) out" })
            EXPECT_EQ(code.find(location) != std::string::npos, isPlain) << variant.key << code;
    }
}

TEST(LaterLanguage, HasFiveVariablesWithAndWithoutAnInstanceIndex) {
    const std::string vertex = "vertex { void materialVertex(inout MaterialVertexInputs material) {\n"
                               "material.a = material.b = material.c = material.d = material.e = getPosition(); } }\n";
    const std::string head =
            "shadingModel : lit, requires : [ color, uv0, uv1, custom0 ], variables : [ a, b, c, d, e ]";
    const std::string sum = "material.baseColor = variable_a + variable_b + variable_c + variable_d + variable_e + "
                            "getColor() + vec4(getUV0(), getUV1()) + getCustom0()";
    EXPECT_EQ(messageOfLater(surfaceOfLater(head, sum + ";", vertex)), "compiles");
    EXPECT_EQ(
            messageOfLater(surfaceOfLater(head + ", instanced : true", sum + " * float(getInstanceIndex());", vertex)),
            "compiles");
}

TEST(LaterLanguage, ShapesWithBumpsWithoutANormalMap) {
    const std::string head = "requires : [ uv0 ], " + parametersOfLater("{ type : sampler2d, name : heights }");
    const std::string bump = "applyBump(materialParams_heights, getUV0(), 0.01);";
    for (const char* model : { "lit", "cloth", "subsurface", "specularGlossiness" }) {
        const auto package = packageOfLater(surfaceOfLater(std::string("shadingModel : ") + model + ", " + head, bump));
        ASSERT_TRUE(package) << model << package.error().message;
        EXPECT_EQ(std::ranges::count(package->terms, "normal"), 1) << model;
    }
    const std::string own = "void applyBump(float x) {}\n";
    const std::string text =
            "material { }\nfragment { " + own +
            "void material(inout MaterialInputs material) { applyBump(1.0); prepareMaterial(material); } }";
    const auto package = packageOfLater(text);
    ASSERT_TRUE(package) << package.error().message;
    EXPECT_EQ(std::ranges::count(package->terms, "normal"), 0) << "a function of the author's is not the engine's";
}

TEST(LaterLanguage, MovesDepthOnlyOfMaterialsThatSetAnOffset) {
    for (const std::string model : { "lit", "unlit" }) {
        const std::string head = "shadingModel : " + model;
        const auto package = [&](std::string const& code) {
            return compileMaterial(surfaceOfLater(head, code), "a.mat");
        };
        const auto with = package("material.pixelDepthOffset = 0.5;"), none = package(""),
                   neutral = package("material.pixelDepthOffset = 0.0;");
        ASSERT_TRUE(with && none && neutral) << with.error().message;
        EXPECT_TRUE(with->depthReadsParameters);
        EXPECT_EQ(neutral->variants, none->variants);
        for (Variant const& variant : with->variants)
            EXPECT_NE(variant.fragment->essl.find("gl_FragDepth"), std::string::npos) << model << ' ' << variant.key;
        for (Variant const& variant : none->variants)
            EXPECT_EQ(variant.fragment->essl.find("gl_FragDepth"), std::string::npos) << model << ' ' << variant.key;
    }
}

TEST(LaterLanguage, HasPlacesInClipSpaceInEveryVariant) {
    const std::string vertex = "vertex { void materialVertex(inout MaterialVertexInputs material) {\n"
                               "material.clipSpacePosition.x += material.clipSpacePosition.w; } }\n";
    for (const char* domain : { "object", "world", "view", "device" }) {
        const auto package = compileMaterial(
                surfaceOfLater(std::string("shadingModel : unlit, vertexDomain : ") + domain, "", vertex), "a.mat");
        EXPECT_TRUE(package) << domain << package.error().message;
    }
    EXPECT_EQ(messageOfLater(surfaceOfLater("variables : [ clipSpacePosition ]", "", vertex)),
              "a.mat:2: MaterialVertexInputs of this material has a member 'clipSpacePosition' already; choose another "
              "name for the variable");
}

TEST(LaterLanguage, DecodesTangentFramesInBothBlocks) {
    const std::string decode = "vec3 n, t; toTangentFrame(vec4(0.0, 0.0, 0.0, 1.0), n); "
                               "toTangentFrame(vec4(0.0, 0.0, 0.0, 1.0), n, t); ";
    const std::string vertex = "vertex { void materialVertex(inout MaterialVertexInputs material) { " + decode +
                               "material.frame = vec4(n, t.x); } }\n";
    EXPECT_EQ(messageOfLater(surfaceOfLater("variables : [ frame ]",
                                            decode + "material.baseColor = variable_frame + vec4(n, t.x);", vertex)),
              "compiles");
}

} // namespace
} // namespace filament_core::shader
