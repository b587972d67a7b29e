// SPDX-License-Identifier: Apache-2.0
// Text that would overflow glslang's stack or fill the memory is refused before glslang sees it.
#include "shaders/compiler/GlslLimits.h"
#include "shaders/compiler/MaterialCompiler.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace filament_core::shader {
namespace {

using testing::HasSubstr;

std::string repeated(std::string_view text, size_t times) {
    std::string all;
    for (size_t i = 0; i < times; ++i) all += text;
    return all;
}

std::string refusal(std::string const& glsl) {
    const Result<void> within = checkGlslLimits(glsl, "a.mat");
    return within ? "is within the limits" : within.error().message;
}

/// The error of a material, on the lines from 2 of which the code stands.
std::string materialError(std::string const& body, std::string const& globals = "") {
    const Result<MaterialPackage> package = compileMaterial(
            "material { shadingModel : unlit }\nfragment { " + globals +
                    "\nvoid material(inout MaterialInputs m) { prepareMaterial(m); float f = 1.0;\n" + body + "\n} }",
            "bomb.mat", { .essl = false });
    return package ? "compiles" : package.error().message;
}

TEST(GlslLimits, ChainsOfSwizzlesAreRefusedAndNameTheLine) {
    const std::string chain = "vec4 v = vec4(f)" + repeated(".xyzw", 50'000) + ";";
    EXPECT_THAT(materialError(chain), HasSubstr("bomb.mat:4: this expression has too many operators"));
}

TEST(GlslLimits, EveryWayToNestOperatorsIsRefused) {
    for (std::string const& text :
         { "f = f" + repeated(" + f", 5000) + ";", "f = " + repeated("-", 5000) + "f;",
           "f = " + repeated("f > 0.0 ? f : ", 5000) + "f;", "f = f" + repeated(", f = f", 5000) + ";",
           repeated("if (f > 0.0) ", 5000) + "f = 1.0;", repeated("for (;;) ", 5000) + "f = 1.0;",
           repeated("do ", 5000) + "f = 1.0;", "f = m" + repeated("[0]", 5000) + ";",
           "f = " + repeated("(f + ", 100) + repeated("f * ", 2950) + "f" + repeated(")", 100) + ";" })
        EXPECT_THAT(refusal(text), HasSubstr("a.mat:1: this expression has too many operators")) << text.substr(0, 40);
    EXPECT_THAT(refusal("f = " + repeated("(", 300) + "f" + repeated(")", 300)), HasSubstr("nested too deeply"));
    EXPECT_THAT(refusal("f = " + repeated("g(f, ", 300) + "f" + repeated(")", 300)), HasSubstr("nested too deeply"));
    EXPECT_THAT(refusal(repeated("{", 300)), HasSubstr("nested too deeply"));
    EXPECT_THAT(refusal("void f() { " + repeated("if (a) { b; } else ", 5000) + "{} }"), HasSubstr("thousand else"));
}

TEST(GlslLimits, MacrosCountWithWhatTheyExpandTo) {
    std::string doubling = "#define A0 f.x + f.x\n";
    for (int i = 1; i <= 40; ++i) doubling += fmt::format("#define A{} A{} + A{}\n", i, i - 1, i - 1);
    EXPECT_THAT(refusal(doubling + "float a = A5;"), HasSubstr("is within"));
    EXPECT_THAT(refusal(doubling + "float a = A40;"), HasSubstr("a.mat:42: the macros of this shader expand to more"));
    EXPECT_THAT(refusal("#define TWICE(x) x x\nfloat a = " + repeated("TWICE(", 40) + "f" + repeated(")", 40) + ";"),
                HasSubstr("the macros of this shader expand"));
    EXPECT_THAT(refusal("#define T(x) x x\n#define S(x) " + repeated("T(", 40) + "x" + repeated(")", 40) + "\nS(f)"),
                HasSubstr("the macros of this shader expand"));
    EXPECT_THAT(refusal("#define C " + repeated(".xyzw", 1000) + "\n#define D C C\nvec4 v = f D D;"),
                HasSubstr("a.mat:3: this expression has too many operators"));
    EXPECT_THAT(materialError("f = A40;", "\n" + doubling), HasSubstr("the macros of this shader expand"));
}

TEST(GlslLimits, MacrosThatUseThemselvesOrEachOtherEndlesslyAreHarmless) {
    EXPECT_THAT(refusal("#define A B\n#define B A\nfloat a = A + B;"), HasSubstr("is within"));
    std::string chain = "#define A0 1\n";
    for (int i = 1; i <= 60'000; ++i) chain += fmt::format("#define A{} A{}\n", i, i - 1);
    EXPECT_THAT(refusal(chain + "float a = A60000;"), HasSubstr("macros use macros more than 100 deep"));
    EXPECT_THAT(refusal("#define T(x) x x\n#define S " + repeated("T(", 60'000) + "\nfloat a = S;"),
                HasSubstr("macros use macros more than 100 deep"));
}

TEST(GlslLimits, FunctionsCountWithThoseThatTheyCall) {
    std::string doubling = "float f0(float x) { return x; }\n";
    for (int i = 1; i <= 40; ++i)
        doubling += fmt::format("float f{}(float x) {{ return f{}(x) + f{}(x); }}\n", i, i - 1, i - 1);
    EXPECT_THAT(refusal(doubling), HasSubstr("functions that call functions add up to too much code"));
}

// What authors write: tables, long functions, polynomials.
TEST(GlslLimits, LargeTablesAndLongFunctionsAreWithinThem) {
    EXPECT_THAT(refusal("const vec3 table[2048] = vec3[](" + repeated("vec3(-0.1, 0.2, -0.3), ", 2047) + "vec3(0));"),
                HasSubstr("is within"));
    EXPECT_THAT(refusal("const float table[] = { " + repeated("-1.0e-5, ", 4096) + "0.0 };"), HasSubstr("is within"));
    EXPECT_THAT(refusal("void f() { " + repeated("x = a * b + c.xyz; if (x > y) { z(x, y); } ", 5000) + "}"),
                HasSubstr("is within"));
    EXPECT_THAT(refusal("float p = " + repeated("x * (c + ", 150) + "x" + repeated(")", 150) + ";"),
                HasSubstr("is within"));
}

// Just below the limits, on the stack of a worker: what is not refused must compile.
TEST(GlslLimits, WhatIsWithinThemCompiles) {
    EXPECT_EQ(materialError("vec4 v = vec4(f)" + repeated(".xyzw", 2900) + "; m.baseColor = v;"), "compiles");
    EXPECT_EQ(materialError("f = f" + repeated(" + f", 2900) + "; m.baseColor.x = f;"), "compiles");
    EXPECT_EQ(materialError(repeated("if (f > 0.5) { f += 0.1; } else ", 300) + "{} m.baseColor.x = f;"), "compiles");
}

} // namespace
} // namespace filament_core::shader
