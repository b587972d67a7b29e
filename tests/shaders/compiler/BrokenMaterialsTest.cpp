// SPDX-License-Identifier: Apache-2.0
// The messages for mistakes of authors: materials with one error each, and the whole message.
#include "shaders/compiler/MaterialCompiler.h"

#include <gtest/gtest.h>

#include <iterator>
#include <span>
#include <string>

namespace filament_core::shader {
namespace {

struct Broken {
    const char* text;
    const char* message;
};

#define GOOD_FRAGMENT "fragment { void material(inout MaterialInputs material) { prepareMaterial(material); } }"
#define FRAGMENT(code) "fragment {\n void material(inout MaterialInputs material) {\n" code "\n}\n}"

constexpr Broken kSyntax[] = {
    { "", "a.mat:1: there is no material block" },
    { "material", "a.mat:1: expected '{', found the end of the file" },
    { "material { domain : postprocess }",
      "a.mat:1: there is no fragment block, and without one an effect has no colour" },
    { "material {}\nmaterial {}", "a.mat:2: there are two material blocks" },
    { "materiel {}", "a.mat:1: expected 'material', 'vertex' or 'fragment', found 'materiel'" },
    { "material {\n name stone }", "a.mat:2: expected ':', found 'stone'" },
    { "material {\n name : }", "a.mat:2: expected a value, found '}'" },
    { "material {\n name : \"stone }", "a.mat:2: this string has no closing quote" },
    { "material {\n name : stone\n shadingModel : lit }", "a.mat:3: expected ',' or '}', found 'shadingModel'" },
    { "material {\n requires : [ uv0 uv1 ] }", "a.mat:2: expected ',' or ']', found 'uv1'" },
    { "material {}\nfragment {\n void f() {", "a.mat:2: this block has no closing brace" },
};

constexpr Broken kValues[] = {
    { "material {\n\n blendMode : add }" GOOD_FRAGMENT, "a.mat:3: there is no property 'blendMode'" },
    { "material {\n doubleSided : 1 }" GOOD_FRAGMENT, "a.mat:2: 'doubleSided' must be a boolean, not a number" },
    { "material {\n culling : \"\" }" GOOD_FRAGMENT, "a.mat:2: 'culling' cannot be ''" },
    { "material {\n shadingModel : litt }" GOOD_FRAGMENT,
      "a.mat:2: 'shadingModel' cannot be 'litt'; did you mean 'lit'?" },
    { "material {\n featureLevel : 4 }" GOOD_FRAGMENT, "a.mat:2: 'featureLevel' must lie in [0, 3], it is 4" },
    { "material {\n featureLevel : 1 }\nfragment {\n void material(inout MaterialInputs m) {\n prepareMaterial(m);\n"
      " // textureGather(later)\n m.roughness = float(bitCount(3)); } }",
      "a.mat:7: 'bitCount' came with ESSL 3.10, which featureLevel 1 does not have; use featureLevel : 2" },
    { "material {\n featureLevel : 1.5 }" GOOD_FRAGMENT, "a.mat:2: 'featureLevel' is 0, 1, 2 or 3" },
    { "material {\n maskThreshold : -0.1 }" GOOD_FRAGMENT, "a.mat:2: 'maskThreshold' must lie in [0, 1], it is -0.1" },
    { "material {\n name : a,\n name : b }" GOOD_FRAGMENT, "a.mat:3: the property 'name' is given twice" },
    { "material {\n requires : [ custom8 ] }" GOOD_FRAGMENT,
      "a.mat:2: 'requires' cannot be 'custom8'; did you mean 'custom0'?" },
    { "material {\n variables : [ a, b, c, d, e, f ] }" GOOD_FRAGMENT, "a.mat:2: 'variables' has more than 5 entries" },
    { "material {\n parameters : [ { name : 2x, type : float } ] }" GOOD_FRAGMENT,
      "a.mat:2: parameter \"2x\" is not a usable GLSL identifier" },
    { "material {\n parameters : [ { name : x } ] }" GOOD_FRAGMENT, "a.mat:2: a parameter needs the field 'type'" },
    { "material {\n parameters : [ { name : x, type : sampler2d[2] } ] }" GOOD_FRAGMENT,
      "a.mat:2: samplers cannot be arrays; use sampler2dArray" },
    { "material {\n parameters : [ { name : a, type : samplerCubemapArray } ] }" GOOD_FRAGMENT,
      "a.mat:2: a samplerCubemapArray needs featureLevel : 2 (table 13 of the guide)" },
    { "material {\n parameters : [ { name : x, type : float, format : int } ] }" GOOD_FRAGMENT,
      "a.mat:2: only samplers have a format, and 'x' is not a sampler" },
    { "material {\n constants : [ { name : x, type : float2 } ] }" GOOD_FRAGMENT,
      "a.mat:2: 'type' cannot be 'float2'; did you mean 'float'?" },
    { "material {\n constants : [ { name : x, type : int, default : 0.5 } ] }" GOOD_FRAGMENT,
      "a.mat:2: the default of an int is a 32-bit integer" },
    { "material {\n variantFilter : [ shadows ] }" GOOD_FRAGMENT, "a.mat:2: 'variantFilter' cannot be 'shadows'" },
    { "material {\n blending : custom, blendFunction : { srcRGB : two, srcA : one, dstRGB : one, dstA : one } "
      "}" GOOD_FRAGMENT,
      "a.mat:2: 'srcRGB' cannot be 'two'" },
    { "material {\n blending : custom, blendFunction : { srcRGB : one } }" GOOD_FRAGMENT,
      "a.mat:2: blendFunction needs the field 'srcA'" },
    { "material {\n blending : custom, blendFunction : { sourceRGB : one } }" GOOD_FRAGMENT,
      "a.mat:2: blendFunction has no field 'sourceRGB'; did you mean 'srcRGB'?" },
};

constexpr Broken kContradictions[] = {
    { "material {\n blendFunction : { srcRGB : one, srcA : one, dstRGB : one, dstA : one } }" GOOD_FRAGMENT,
      "a.mat:2: blendFunction is only read with blending : custom; set that, or leave the function out" },
    { "material {\n blending : custom }" GOOD_FRAGMENT,
      "a.mat:2: blending : custom needs a blendFunction : { srcRGB : ..., srcA : ..., dstRGB : ..., dstA : ... }" },
    { "material {\n transparency : twoPassesOneSide }" GOOD_FRAGMENT,
      "a.mat:2: two passes need a blended material; set a blending, for instance transparent" },
    { "material {\n blending : fade,\n transparency : twoPassesOneSide,\n refractionMode : cubemap }" GOOD_FRAGMENT,
      "a.mat:3: two passes are for materials that do not refract; leave out transparency or refractionMode" },
    { "material {\n blending : fade, transparency : twoPassesOneSide,\n depthCulling : false }" GOOD_FRAGMENT,
      "a.mat:2: twoPassesOneSide needs the depth test to find the nearest surface; leave out depthCulling : false" },
    { "material { shadingModel : unlit, vertexDomain : device, fullScreenTriangle : true,\n instanced : true "
      "}" GOOD_FRAGMENT,
      "a.mat:2: a full-screen triangle has no instances; leave out instanced" },
    { "material {\n wideLines : true }" GOOD_FRAGMENT,
      "a.mat:2: wideLines finds the other end of a segment in custom0; add requires : [ custom0 ], and make the mesh "
      "with makeLineQuads() of <filament_core/Lines.h>" },
    { "material { shadingModel : unlit, vertexDomain : device, requires : [ custom0 ],\n wideLines : true "
      "}" GOOD_FRAGMENT,
      "a.mat:2: wideLines needs positions in space; leave out vertexDomain : device" },
    { "material { shadingModel : unlit, vertexDomain : device,\n sizedPoints : true }" GOOD_FRAGMENT,
      "a.mat:2: sizedPoints needs positions in space; leave out vertexDomain : device" },
    { "material { requires : [ custom0 ], wideLines : true,\n sizedPoints : true }" GOOD_FRAGMENT,
      "a.mat:2: a mesh holds points or lines; leave out sizedPoints or wideLines" },
    { "material {}\n" FRAGMENT("prepareMaterial(material);\nmaterial.roughness = float(getInstanceIndex());"),
      "a.mat:2: this block calls getInstanceIndex(); that needs the property instanced : true" },
    { "material {\n blending : transparent,\n refractionMode : cubemap }" GOOD_FRAGMENT,
      "a.mat:3: a refracting material shows the background itself; leave out blending, or set blending : fade where "
      "alpha is coverage" },
    { "material {\n shadingModel : unlit,\n refractionMode : cubemap }" GOOD_FRAGMENT,
      "a.mat:3: an unlit material cannot refract; use shadingModel : lit" },
    { "material {\n shadowMultiplier : true }" GOOD_FRAGMENT,
      "a.mat:2: a lit surface that only shows shadows is transparent; set blending : transparent" },
    { "material {\n shadingModel : cloth,\n shadowMultiplier : true, blending : transparent }" GOOD_FRAGMENT,
      "a.mat:3: shadowMultiplier is for shadingModel : unlit or lit" },
    { "material {\n customSurfaceShading : true,\n shadowMultiplier : true, blending : transparent }" GOOD_FRAGMENT,
      "a.mat:3: the shares of shadows are those of the standard model; leave out customSurfaceShading and "
      "refractionMode" },
    { "material {\n shadingModel : cloth,\n refractionMode : cubemap }" GOOD_FRAGMENT,
      "a.mat:3: cloth lets light through without refraction; use shadingModel : lit" },
    { "material {\n shadingModel : subsurface,\n refractionMode : cubemap }" GOOD_FRAGMENT,
      "a.mat:3: a subsurface material scatters light, and its thickness is a fraction; to refract, use "
      "shadingModel : lit" },
    { "material {\n clothDistribution : ashikhmin }" GOOD_FRAGMENT,
      "a.mat:2: clothDistribution is for shadingModel : cloth" },
    { "material { customSurfaceShading : true }\n" GOOD_FRAGMENT,
      "a.mat:2: this block must define vec3 surfaceShading(const MaterialInputs materialInputs, const ShadingData "
      "shadingData, const LightData lightData), as customSurfaceShading : true says" },
    { "material {\n customSurfaceShading : true, shadingModel : cloth }" GOOD_FRAGMENT,
      "a.mat:2: customSurfaceShading works with shadingModel : lit only" },
    { "material {\n domain : postprocess,\n shadingModel : lit }" GOOD_FRAGMENT,
      "a.mat:3: a material of the domain postprocess cannot be lit" },
    { "material { constants : [ { name : hasX, type : bool } ],\n parameters : [ { name : x, type : sampler2d, usedIf "
      ": "
      "hasY } ] }" GOOD_FRAGMENT,
      "a.mat:2: there is no constant 'hasY'; did you mean 'hasX'?" },
    { "material { constants : [ { name : hasX, type : int } ],\n parameters : [ { name : x, type : sampler2d, usedIf : "
      "[ hasX ] } ] }" GOOD_FRAGMENT,
      "a.mat:2: usedIf names constants of type bool, and 'hasX' is not one" },
    { "material {\n parameters : [ { name : x, type : float, usedIf : hasX } ] }" GOOD_FRAGMENT,
      "a.mat:2: usedIf is only for samplers that can be read anywhere, and 'x' is not one" },
    { "material {\n parameters : [ { name : x, type : sampler2d, usedIf : [] } ] }" GOOD_FRAGMENT,
      "a.mat:2: usedIf names at least one constant" },
    { "material { requires : [ uv0 ], constants : [ { name : hasX, type : bool }, { name : hasY, type : bool } ],\n"
      " parameters : [ { name : x, type : sampler2d, usedIf : hasX } ] }\n" FRAGMENT(
              "prepareMaterial(material); if (materialConstants_hasY) material.baseColor = texture(materialParams_x, "
              "getUV0());"),
      "a.mat:2: 'x' is also read where hasX is false; read it only inside of if (materialConstants_...) of a constant "
      "that its usedIf names" },
    { "material { constants : [ { name : hasX, type : bool } ],\n parameters : [ { name : x, type : sampler2d, usedIf "
      ": "
      "hasX } ] }\nvertex { void materialVertex(inout MaterialVertexInputs material) { "
      "material.worldPosition += textureLod(materialParams_x, vec2(0.0), 0.0); } }\n" GOOD_FRAGMENT,
      "a.mat:2: 'x' has usedIf, so only the fragment block can read it" },
    { "material {\n parameters : [ { name : x, type : samplerCubemap, currentPixel : true } ] }" GOOD_FRAGMENT,
      "a.mat:2: only a sampler2d of format float can have currentPixel, and 'x' is not one" },
    { "material {\n parameters : [ { name : x, type : sampler2d, format : int, currentPixel : true } ] }" GOOD_FRAGMENT,
      "a.mat:2: only a sampler2d of format float can have currentPixel, and 'x' is not one" },
    { "material {\n parameters : [ { name : x, type : sampler2d, currentPixel : true } ] }" GOOD_FRAGMENT,
      "a.mat:2: currentPixel exists only in the domain postprocess" },
    { "material {\n parameters : [ { name : x, type : sampler2dMS } ] }" GOOD_FRAGMENT,
      "a.mat:2: a sampler2dMS exists only in the domain postprocess" },
    { "material { domain : postprocess,\n parameters : [ { name : x, type : sampler2d, currentPixel : true },\n"
      "{ name : y, type : subpassInput } ] }\nfragment { void postProcess(inout PostProcessInputs inputs) {} }",
      "a.mat:2: 'y' is a subpassInput, so every pass of this material is merged and 'x' cannot be a texture; make both "
      "sampler2d with currentPixel : true" },
};

// Messages of the GLSL compiler, with suggestions.
constexpr Broken kMisspelt[] = {
    { "material {}\n" FRAGMENT("prepareMaterial(material);\nmaterial.metalic = 1.0;"),
      "a.mat:5: 'metalic' : no such field in structure 'material'; did you mean 'metallic'?" },
    { "material { parameters : [ { name : albedo, type : float4 } ] }\n" FRAGMENT(
              "prepareMaterial(material);\nmaterial.baseColor = materialParams.albdo;"),
      "a.mat:5: 'albdo' : no such field in structure 'materialParams'; did you mean 'albedo'?" },
    { "material { parameters : [ { name : albedo, type : float4 } ] }\n" FRAGMENT(
              "prepareMaterial(material);\nmaterial.baseColor = material.albedo;"),
      "a.mat:5: 'albedo' : no such field in structure 'material'; the parameter is materialParams.albedo" },
    { "material { parameters : [ { name : albedo, type : sampler2d } ], requires : [ uv0 ] }\n" FRAGMENT(
              "prepareMaterial(material);\nmaterial.baseColor = texture(materialParams_albdo, getUV0());"),
      "a.mat:5: 'materialParams_albdo' : undeclared identifier; did you mean 'materialParams_albedo'?" },
    { "material { constants : [ { name : wet, type : bool } ] }\n" FRAGMENT(
              "prepareMaterial(material);\nif (materialConstants_wett) material.roughness = 0.0;"),
      "a.mat:5: 'materialConstants_wett' : undeclared identifier; did you mean 'materialConstants_wet'?" },
    { "material { domain : postprocess, parameters : [ { name : x, type : sampler2d, currentPixel : true } ] }\n"
      "fragment {\n void postProcess(inout PostProcessInputs inputs) {\n"
      "inputs.color = texture(materialParams_x, vec2(0.5)); } }",
      "a.mat:4: 'texture' : no matching overloaded function found; only "
      "getCurrentPixel(materialParams_x) can read a currentPixel parameter" },
};

// Names from other places.
constexpr Broken kForeign[] = {
    { "material {}\n" FRAGMENT("prepareMaterial(material);\nmaterial.baseColor.xy = getUV0();"),
      "a.mat:5: 'getUV0' : no matching overloaded function found; add requires : [ uv0 ]" },
    { "material { shadingModel : cloth }\n" FRAGMENT("prepareMaterial(material);\nmaterial.metallic = 1.0;"),
      "a.mat:5: 'metallic' : no such field in structure 'material'; shadingModel : cloth has no metallic, which is for "
      "lit, subsurface" },
    { "material {}\n" FRAGMENT("prepareMaterial(material);\nmaterial.absorption = vec3(1.0);"),
      "a.mat:5: 'absorption' : no such field in structure 'material'; shadingModel : lit has no absorption, which is "
      "for "
      "materials with a refractionMode" },
    { "material { parameters : [ { name : albedo, type : float4 }, { name : map, type : sampler2d } ] }\n" FRAGMENT(
              "prepareMaterial(material);\nmaterial.baseColor = albedo;\nmaterial.baseColor *= texture(map, "
              "vec2(0.0));"),
      "a.mat:5: 'albedo' : undeclared identifier; the parameter is materialParams.albedo\n"
      "a.mat:6: 'map' : undeclared identifier; the parameter is materialParams_map" },
    { "material { parameters : [ { name : map, type : sampler2d } ] }\n" FRAGMENT(
              "prepareMaterial(material);\nmaterial.baseColor = texture2D(materialParams_map, vec2(0.0));"),
      "a.mat:5: 'texture2D' : this and textureCube are older GLSL; use texture" },
    { "material {\n parameters : [ { name : tint, type : vec3 } ] }" GOOD_FRAGMENT,
      "a.mat:2: 'type' cannot be 'vec3'; did you mean 'float3'?" },
    { "material {\n parameters : [ { name : half, type : float } ] }" GOOD_FRAGMENT,
      "a.mat:2: parameter \"half\" is a word that GLSL reserves; choose another name" },
    { "material {\n linearFog : yes,\n constants : [ { name : wet, type : bool, mutable : 1 } ] }" GOOD_FRAGMENT,
      "a.mat:2: 'linearFog' must be a boolean, not a string\na.mat:3: 'mutable' must be a boolean, not a number" },
    { "material {\n buffers : [],\n groupSize : [ 1, 1, 1 ],\n subpasses : [] }" GOOD_FRAGMENT,
      "a.mat:2: there is no property 'buffers': materials have no storage buffers; use parameters that are arrays, or "
      "a "
      "texture\n"
      "a.mat:3: there is no property 'groupSize': there are no materials of compute stages\n"
      "a.mat:4: there is no property 'subpasses': declare it as a parameter of the type subpassInput" },
    { "material {}\nvertex {\nvoid materialVertex(inout MaterialVertexInputs m) {\n"
      "m.worldNormal = objectUniforms.worldFromModelNormalMatrix * m.worldNormal; } }\n" GOOD_FRAGMENT,
      "a.mat:4: 'worldFromModelNormalMatrix' : no such field in structure 'objectUniforms'; what is in there is the "
      "engine's: use functions, such as getWorldFromModelNormalMatrix()" },
    { "material {\n variables : [ output ] }" GOOD_FRAGMENT,
      "a.mat:2: variable \"output\" is a word that GLSL reserves; choose another name" },
    { "material {\n variables : [ worldNormal ] }" GOOD_FRAGMENT,
      "a.mat:2: MaterialVertexInputs of this material has a member 'worldNormal' already; choose another name for the "
      "variable" },
};

// What would otherwise be found in the engine's text.
constexpr Broken kBehind[] = {
    { "material {}\n\nfragment { void material(inout MaterialInputs m) { prepareMaterial(m); }\n#if 1\n}",
      "a.mat:3: this block has an #if without its #endif" },
    { "material {}\nfragment {\n#define material foo\nvoid material(inout MaterialInputs m) { prepareMaterial(m); } }",
      "a.mat:2: the engine's code behind this block does not compile with it: 'material' : no matching overloaded "
      "function found" },
    { "material {\n variables : [ float3 ] }" GOOD_FRAGMENT,
      "a.mat:2: variable \"float3\" is a word that GLSL reserves; choose another name" },
    { "material {}\nvertex {\nvoid materialVertex(inout MaterialVertexInputs m) { m.uv0.x = 1.0; } }\n" GOOD_FRAGMENT,
      "a.mat:3: 'uv0' : no such field in structure 'm'; add requires : [ uv0 ]" },
    { "material {}\nfragment {\nuniform sampler2D mine;\nvoid material(inout MaterialInputs m) { prepareMaterial(m); } "
      "}",
      "a.mat:3: 'binding' : sampler/texture/image requires layout(binding=X); declare it in the list of parameters, "
      "and "
      "read materialParams_ and its name" },
};

// Several mistakes: a line for each.
constexpr Broken kSeveral[] = {
    { "material {\n blendMode : add,\n shadingModel : litt,\n requires : [ uv7,\n uv8 ] }" GOOD_FRAGMENT,
      "a.mat:2: there is no property 'blendMode'\na.mat:3: 'shadingModel' cannot be 'litt'; did you mean 'lit'?\n"
      "a.mat:4: 'requires' cannot be 'uv7'; did you mean 'uv0'?\n"
      "a.mat:5: 'requires' cannot be 'uv8'; did you mean 'uv0'?" },
    { "material {}\nvertex {\nvoid materialVertex(inout MaterialVertexInputs m) {\nm.x = 1.0; } }\n" FRAGMENT(
              "prepareMaterial(material);\nmaterial.a = 1.0;\nmaterial.roughness = 0.5;\nmaterial.b = 1.0;"),
      "a.mat:4: 'x' : no such field in structure 'm'\na.mat:8: 'a' : no such field in structure 'material'\n"
      "a.mat:10: 'b' : no such field in structure 'material'" },
    { "material {}\nfragment {\nfloat f(float x) { return f(x - 1.0); }\nfloat g(float x);\n"
      "void material(inout MaterialInputs m) { prepareMaterial(m); m.roughness = f(1.0) + g(2.0); } }",
      "a.mat:3: f() calls itself, directly or through others; GLSL has no recursion, use a loop\n"
      "a.mat:4: g() is declared and called but not defined" },
};

constexpr Broken kCode[] = {
    { "material {}\nfragment {\nfloat f;\n}",
      "a.mat:2: this block must define void material(inout MaterialInputs material)" },
    { "material {}\nfragment {\n\nvoid material(MaterialInputs a, float b) {} }",
      "a.mat:4: material() must be void material(inout MaterialInputs material)" },
    { "material { customSurfaceShading : true }\nfragment {\nvoid material(inout MaterialInputs m) {}\n"
      "float3 surfaceShading(const ShadingData d) { return float3(0.0); } }",
      "a.mat:4: surfaceShading() must be vec3 surfaceShading(const MaterialInputs materialInputs, const ShadingData "
      "shadingData, const LightData lightData), as customSurfaceShading : true says" },
    { "material {}\nfragment {\nvoid main() {}\nvoid material(inout MaterialInputs m) {} }",
      "a.mat:3: the engine itself defines 'main'; choose another name" },
    { "material {}\nfragment {\nfloat filament_x;\nvoid material(inout MaterialInputs m) {} }",
      "a.mat:3: names that begin with filament_ are the engine's; choose another name" },
    { "material {}\n" FRAGMENT("\n #include \"gone.glsl\""),
      "a.mat:5: cannot find the file \"gone.glsl\" of this #include" },
    { "material {}\n" FRAGMENT("prepareMaterial(material);\nwhile (true) material.roughness += 0.1;"),
      "a.mat:5: this loop never ends; give it a condition that becomes false, a break or a return" },
    { "material { shadingModel : unlit }\nfragment {\nfloat wait() {\n for (int i = 0;; ++i) {\n if (i > 3) continue;"
      "\n }\n return 1.0;\n}\nvoid material(inout MaterialInputs material) {\n material.baseColor.r = wait(); } }",
      "a.mat:4: this loop never ends; give it a condition that becomes false, a break or a return" },
    { "material { shadingModel : unlit }\nvertex {\nfloat f;\n}\n" GOOD_FRAGMENT,
      "a.mat:2: this block must define void materialVertex(inout MaterialVertexInputs material)" },
};

static_assert(std::size(kSyntax) + std::size(kValues) + std::size(kContradictions) + std::size(kMisspelt) +
                      std::size(kCode) >=
              40);

/// Loops that look endless and are not.
constexpr const char* kEndingLoops[] = {
    "while (true) { material.roughness += 0.1; if (material.roughness > 1.0) break; }",
    "for (;;) { material.roughness += 0.1; if (material.roughness > 1.0) return; }",
    "do { material.roughness += 0.1; if (material.roughness > 1.0) discard; } while (true);",
    "for (int i = 0; i < 3; ++i) { if (i == 1) continue; material.roughness += 0.1; }",
};

void expectMessages(std::span<const Broken> materials) {
    for (Broken const& broken : materials) {
        const Result<MaterialPackage> package = compileMaterial(broken.text, "a.mat");
        EXPECT_EQ(package ? "it compiles" : package.error().message, broken.message) << broken.text;
    }
}

TEST(BrokenMaterials, NameTheLineWhereTheTextStopsMakingSense) { expectMessages(kSyntax); }
TEST(BrokenMaterials, NameTheValueAndWhatItMayBe) { expectMessages(kValues); }
TEST(BrokenMaterials, NameTheContradictionAndItsCure) { expectMessages(kContradictions); }
TEST(BrokenMaterials, NameWhatWasProbablyMeantInTheCode) { expectMessages(kMisspelt); }
TEST(BrokenMaterials, NameWhatThisLanguageCallsIt) { expectMessages(kForeign); }
TEST(BrokenMaterials, NameTheBlockThatTheEngineCannotFollow) { expectMessages(kBehind); }
TEST(BrokenMaterials, NameEveryMistake) { expectMessages(kSeveral); }
TEST(BrokenMaterials, AreNotThoseWhoseLoopsHaveAnExit) {
    for (const std::string loop : kEndingLoops) {
        const std::string text = "material {}\nfragment { void material(inout MaterialInputs material) { "
                                 "prepareMaterial(material); " +
                                 loop + " } }";
        const Result<MaterialPackage> package = compileMaterial(text, "a.mat", { .filteredVariants = kAllVariantBits });
        EXPECT_TRUE(package) << loop << ": " << package.error().message;
    }
}

TEST(BrokenMaterials, NameTheLineOfTheCode) { expectMessages(kCode); }

} // namespace
} // namespace filament_core::shader
