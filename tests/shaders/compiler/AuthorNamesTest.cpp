// SPDX-License-Identifier: Apache-2.0
// Names that authors choose: all of the engine's are free, and its helpers remain callable beside the author's own.
#include "shaders/compiler/CompileProgram.h"
#include "shaders/compiler/EmbeddedSources.h"
#include "shaders/compiler/EngineNames.h"
#include "shaders/compiler/GlslOutline.h"
#include "shaders/compiler/MaterialCompiler.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <string>

namespace filament_core::shader {
namespace {

constexpr const char* kModels[] = { "lit", "unlit", "cloth", "subsurface", "specularGlossiness" };

std::string withDeclarations(std::string const& declarations, std::string const& use, const char* model) {
    return fmt::format("material {{ shadingModel : {}, variables : [ v ], variantFilter : [ skinning ] }}\n"
                       "vertex {{\n{}\nvoid materialVertex(inout MaterialVertexInputs material) {{ float r = 0.0;\n{}\n"
                       "material.v = vec4(r); }} }}\n"
                       "fragment {{\n{}\nvoid material(inout MaterialInputs material) {{ prepareMaterial(material); "
                       "float r = variable_v.x;\n{}\nmaterial.baseColor.r = r; }} }}",
                       model, declarations, use, declarations, use);
}

/// As written: names are a matter of the front end, and the optimiser takes most of the time.
Result<MaterialPackage> compileWith(std::string const& declarations, std::string const& use, const char* model) {
    return compileMaterial(withDeclarations(declarations, use, model), "a.mat", { .optimization = Optimization::None });
}

struct Own {
    const char* declarations;
    const char* use;
};

constexpr Own kOwn[] = {
    { "struct Light { float power; };", "Light l; l.power = 0.5; r += l.power;" },
    { "struct Surface { vec3 roughness; };", "r += Surface(vec3(0.2)).roughness.x;" },
    { "vec3 saturate(vec3 x) { return x * 2.0; }",
      "r += saturate(vec3(0.1)).x + saturate(0.1) + saturate(vec2(0.1)).x;" },
    { "float max3(vec3 x) { return x.y; }", "r += max3(vec3(0.1));" },
    { "float max3(float x, float y, float z) { return max(x, max(y, z)); }",
      "r += max3(0.1, 0.2, 0.3) + max3(vec3(0.1));" },
    { "float sq(float x) { return 2.0 * x; }\nfloat pow5(float x);\nfloat pow5(float x) { return x; }",
      "r += sq(0.1) + pow5(0.2);" },
    { "#define sq(x) ((x) + 1.0)\n#define saturate(x) (x)\n#define max min\n#define vec3 vec2", "r += sq(0.1);" },
    { "float luminance(vec3 c) { return c.g; }\nfloat luminance(vec4 c) { return c.a; }",
      "r += luminance(vec3(0.1)) + luminance(vec4(0.1));" },
    { "const float PI = 3.0;", "r += PI;" },
    { "#define PI 3.14159265359\n#ifndef HALF_PI\n#define HALF_PI 1.5\n#endif", "r += PI;" },
    { "const float kPi = 3.0, kInversePi = 0.25;", "r += kPi;" },
    { "struct Varyings { float a; };\nstruct ObjectRecord { float b; } objectUniforms;\nfloat frameUniforms = 1.0;",
      "r += frameUniforms;" },
    { "float ndfGgx(float noh, float alpha) { return noh; }\nvec3 fresnelSchlick(vec3 a, float b) { return a; }",
      "r += ndfGgx(0.1, 0.2);" },
    { "#define HAS_NORMAL 1\n#define VARIANT_SUN\n#define VARYING in", "" },
    { "vec2 meshUv(vec2 uv) { return uv; }\nfloat addLights() { return 1.0; }\nvoid initMaterial() {}",
      "r += addLights();" },
    { "vec2 hash22(vec2 p) { return fract(sin(p) * 43758.5453); }\nmat2 rotation(float a) { return mat2(1.0); }", "" },
};

TEST(AuthorNames, MayBeTheEnginesOwn) {
    for (Own const& own : kOwn) {
        for (const char* model : kModels) {
            const Result<MaterialPackage> package = compileWith(own.declarations, own.use, model);
            EXPECT_TRUE(package) << model << ": " << own.declarations << "\n" << package.error().message;
        }
    }
}

// Each name by itself, as a structure, a function and a macro.
TEST(AuthorNames, MayBeAnyThatAnEngineFileDeclares) {
    size_t count = 0;
    std::string structs, macros;
    NameSet known{ "main",        "prepareMaterial", "MaterialInputs", "MaterialVertexInputs", "PostProcessInputs",
                   "ShadingData", "LightData",       "getCurrentPixel" };
    for (const std::string_view path : embeddedPaths()) {
        if (!isEngineFile(path)) continue;
        for (GlslDeclaration const& each : outlineOf(*embeddedSource(path), path)) {
            const bool isReserved = each.name.starts_with(kReservedPrefix);
            if (isReserved || !known.insert(each.name).second || each.name == "max3") continue;
            ++count;
            const bool isTypeName = each.kind == GlslDeclaration::Kind::Macro;
            if (!isTypeName) structs += "struct " + each.name + " { float a; };\n";
            if (!isTypeName) macros += "#define " + each.name + " 0.0\n";
        }
    }
    EXPECT_GE(count, 300u) << "outlineOf() finds less than the engine declares";
    for (const char* model : kModels) {
        const Result<MaterialPackage> asTypes = compileWith(structs, "", model);
        EXPECT_TRUE(asTypes) << model << asTypes.error().message;
        const Result<MaterialPackage> asMacros = compileWith(macros, "", model);
        EXPECT_TRUE(asMacros) << model << asMacros.error().message;
    }
}

// What the author calls differently is the same program: the engine's arithmetic does not change.
TEST(AuthorNames, DoNotChangeTheProgram) {
    CompileOptions options;
    options.essl = false; // its local names may differ
    const auto compile = [&](const char* name) {
        const std::string text = withDeclarations(fmt::format("float {}(float x) {{ return x * 3.0; }}", name),
                                                  fmt::format("r += {}(0.1);", name), "lit");
        return compileMaterial(text, "a.mat", options);
    };
    const Result<MaterialPackage> free = compile("tripled"), taken = compile("pow5"), internal = compile("addLights");
    ASSERT_TRUE(free && taken && internal);
    EXPECT_EQ(free->variants, taken->variants);
    EXPECT_EQ(free->variants, internal->variants);
}

TEST(AuthorNames, LeaveTheHelpersForEveryVectorSize) {
    for (const char* type : { "float", "float2", "float3", "float4" }) {
        const std::string call = fmt::format("r += dot(saturate({0}(0.5)), sq({0}(0.5)) + pow5({0}(0.5)));", type);
        const std::string plain = fmt::format("{0} v = saturate({0}(0.5)) + sq({0}(0.5)) + pow5({0}(0.5));", type);
        const Result<MaterialPackage> package = compileWith("", type == std::string("float") ? plain : call, "unlit");
        EXPECT_TRUE(package) << type << package.error().message;
    }
}

TEST(AuthorNames, AreNotAffectedByIncludingAFileOfTheEngine) {
    const std::string text = "material { requires : [ uv0 ], parameters : [ { name : h, type : sampler2d } ] }\n"
                             "fragment {\n#define PARALLAX_HEIGHT(uv) textureLod(materialParams_h, uv, 0.0).r\n"
                             "#include \"shaders/lib/color.glsl\"\n"
                             "float toneMapped(vec3 c) { return toneMap(c, kToneMapAces).r; }\n"
                             "void material(inout MaterialInputs m) { prepareMaterial(m); "
                             "m.baseColor.r = PARALLAX_HEIGHT(getUV0()) + toneMapped(vec3(0.5)); } }";
    const Result<MaterialPackage> package = compileMaterial(text, "a.mat");
    EXPECT_TRUE(package) << package.error().message;
}

TEST(GlslOutline, ReadsWhatATextDeclares) {
    const auto found = outlineOf("const float a = f(1), b[2] = float[2](1.0, 2.0);\n"
                                 "struct S { float3 inner; } s;\n"
                                 "layout(std140, binding = 1) uniform U { vec4 v; } u;\n"
                                 "float3 g(const in highp float3 p, S q[2]) { if (a > 0.0) { return p; } return p; }\n"
                                 "#define M(x) \\\n x\n#line 40 \"other.glsl\"\nvoid h(void);",
                                 "a.glsl");
    std::string text;
    for (GlslDeclaration const& each : found) {
        text += fmt::format("{}:{} {}(", each.file, each.line, each.name);
        for (std::string const& type : each.parameters) text += type + ",";
        text += ") ";
    }
    EXPECT_EQ(text, "a.glsl:1 a() a.glsl:1 b() a.glsl:2 S() a.glsl:2 s() a.glsl:3 U() a.glsl:3 u() "
                    "a.glsl:4 g(vec3,S[2],) a.glsl:5 M() other.glsl:40 h() ");
}

} // namespace
} // namespace filament_core::shader
