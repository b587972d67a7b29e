// SPDX-License-Identifier: Apache-2.0
// #include in blocks, as in C.
#include "shaders/compiler/MaterialCompiler.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

namespace filament_core::shader {
namespace {

using Files = std::map<std::string, std::string, std::less<>>;

Result<MaterialPackage> compile(std::string const& text, Files const& files) {
    CompileOptions options;
    options.includes = [&](std::string_view path) -> std::optional<std::string> {
        const auto found = files.find(path);
        return found == files.end() ? std::nullopt : std::optional(found->second);
    };
    return compileMaterial(text, "a.mat", options);
}

std::string fragment(std::string const& before, std::string const& code = "") {
    return "material { shadingModel : unlit }\nfragment {\n" + before +
           "\nvoid material(inout MaterialInputs material) { prepareMaterial(material); float r = 0.0;\n" + code +
           "\nmaterial.baseColor.r = r; } }";
}

void expectMessage(std::string const& text, Files const& files, std::string const& message) {
    const Result<MaterialPackage> package = compile(text, files);
    EXPECT_EQ(package ? "it compiles" : package.error().message, message);
}

void expectCompiles(std::string const& text, Files const& files) {
    const Result<MaterialPackage> package = compile(text, files);
    EXPECT_TRUE(package) << package.error().message;
}

TEST(Includes, InsertAFileAsOftenAsItIsNamed) {
    const Files files{ { "add.glsl", "r += STEP;\n" } };
    const std::string code = "#define STEP 0.25\n#include \"add.glsl\"\n#undef STEP\n#define STEP 0.5\n"
                             "#include \"add.glsl\"\nr = r == 0.75 ? r : missing;";
    expectMessage(fragment("", code), files, "a.mat:10: 'missing' : undeclared identifier");
    expectCompiles(fragment("", "#define STEP 0.25\n#include \"add.glsl\"\n#include \"add.glsl\""), files);
    expectMessage(fragment("#include \"f.glsl\"\n#include \"f.glsl\""), { { "f.glsl", "float f() { return 1.0; }" } },
                  "f.glsl:1: 'f' : function already has a body");
}

TEST(Includes, CannotIncludeThemselves) {
    expectMessage(fragment("#include \"a.glsl\""), { { "a.glsl", "\n#include \"a.glsl\"" } },
                  "a.glsl:2: \"a.glsl\" includes itself");
    expectMessage(fragment("#include \"a.glsl\""),
                  { { "a.glsl", "#include \"b.glsl\"" }, { "b.glsl", "#include \"a.glsl\"" } },
                  "b.glsl:1: \"a.glsl\" includes itself");
    expectMessage(fragment("#include \"a.glsl\""),
                  { { "a.glsl", "#ifndef A\n#define A\n#include \"a.glsl\"\n#endif" } },
                  "a.glsl:3: cannot find the file of this #include, or it includes itself");
}

TEST(Includes, AreRelativeToTheIncludingFile) {
    const Files files{ { "noise/all.glsl", "#include \"hash.glsl\"\n#include \"more/value.glsl\"" },
                       { "noise/hash.glsl", "float hash() { return 0.5; }" },
                       { "noise/more/value.glsl", "#include \"top.glsl\"\nfloat value() { return top(); }" },
                       { "top.glsl", "float top() { return 0.25; }" } };
    expectCompiles(fragment("#include \"noise/all.glsl\"", "r = hash() + value();"), files);
}

TEST(Includes, HaveBlanksAndComments) {
    const Files files{ { "a.glsl", "float a() { return 1.0; }" } };
    expectCompiles(fragment("  #  include \"a.glsl\" // why", "r = a();"), files);
    expectCompiles(fragment("// #include \"gone.glsl\"\n/*\n#include \"gone.glsl\"\n*/"), files);
}

TEST(Includes, AreNotReadInInactiveBranches) {
    expectCompiles(fragment("#if 0\n#include \"gone.glsl\"\n#endif"), {});
    expectCompiles(fragment("#ifdef GONE\n#include \"gone.glsl\"\n#else\nfloat a;\n#endif"), {});
    expectMessage(fragment("#if 1\n#include \"gone.glsl\"\n#endif"), {},
                  "a.mat:4: cannot find the file of this #include, or it includes itself");
    expectMessage(fragment("#include \"gone.glsl\""), {},
                  "a.mat:3: cannot find the file \"gone.glsl\" of this #include");
}

TEST(Includes, MayHaveBlanksBehindTheHash) {
    const std::string material = "material { shadingModel : unlit,\n#\t include \"parameters.inc\"\n }\n";
    const std::string vertex = "vertex { void materialVertex(inout MaterialVertexInputs material) {\n"
                               "  #  include \"lift.glsl\"\n} }\n";
    const std::string fragment =
            "fragment { void material(inout MaterialInputs material) { prepareMaterial(material);\n"
            "#\tinclude \"tint.glsl\"\n} }";
    const Files files{ { "parameters.inc", "# include \"more.inc\"\n" },
                       { "more.inc", "parameters : [ { name : tint, type : float4 } ]\n" },
                       { "lift.glsl", "# include \"deep/up.glsl\"\n" },
                       { "deep/up.glsl", "material.worldPosition.y += 1.0;\n" },
                       { "tint.glsl", " # include \"deep/color.glsl\"\n" },
                       { "deep/color.glsl", "material.baseColor = materialParams.tint;\n" } };
    expectCompiles(material + vertex + fragment, files);
}

TEST(Includes, MayReadTexturesInTheVertexStage) {
    const std::string text =
            "material { shadingModel : unlit, parameters : [ { name : heights, type : sampler2d } ] }\n"
            "vertex { void materialVertex(inout MaterialVertexInputs material) {\n#include \"lift.glsl\"\n} }\n"
            "fragment { void material(inout MaterialInputs material) { prepareMaterial(material); } }";
    expectCompiles(text, { { "lift.glsl", "material.worldPosition.y += textureLod(materialParams_heights, vec2(0.5), "
                                          "0.0).r;" } });
}

TEST(Includes, EndAtALimitAndNotAtTheMemory) {
    Files files;
    for (int i = 0; i < 14; ++i) {
        const std::string next = "#include \"" + std::to_string(i + 1) + ".glsl\"\n";
        files[std::to_string(i) + ".glsl"] = next + next + next + next + next + next + next + next;
    }
    files["14.glsl"] = "float a0;";
    const Result<MaterialPackage> package = compile(fragment("#include \"0.glsl\""), files);
    ASSERT_FALSE(package);
    EXPECT_NE(package.error().message.find("larger than 4 MiB"), std::string::npos) << package.error().message;
}

} // namespace
} // namespace filament_core::shader
