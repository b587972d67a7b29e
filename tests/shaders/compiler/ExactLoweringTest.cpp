// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/ExactLowering.h"

#include "shaders/compiler/GlslToSpirv.h"
#include "tests/shaders/compiler/SpirvTools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace filament_core::shader {
namespace {

/// A fragment shader that stores `expression` (a vec4) made from the uniforms a, b, c (vec4), x, y, s (float), m, n
/// (mat4).
std::string shaderOf(std::string const& expression) {
    return R"(#version 450
layout(set = 0, binding = 0, std140) uniform U { mat4 m, n; mat3 m3; vec4 a, b, c; vec4 s; } u;
layout(constant_id = 0) const float kSpec = 3.0;
layout(location = 0) out vec4 color;
void main() { color = )" +
           expression + "; }";
}

std::vector<uint32_t> asWritten(std::string const& expression) {
    Result<std::vector<uint32_t>> spirv = spirvFromGlsl(shaderOf(expression), backend::ShaderStage::Fragment, "test");
    EXPECT_TRUE(spirv) << (spirv ? "" : spirv.error().message);
    return *spirv;
}

std::vector<uint32_t> optimized(std::string const& expression) {
    Result<std::vector<uint32_t>> spirv = optimizeSpirv(asWritten(expression));
    EXPECT_TRUE(spirv);
    return *spirv;
}

struct Operation {
    const char* opcode;     ///< as the disassembly spells it
    const char* expression; ///< GLSL that produces it
};

class ExactLoweringOf : public ::testing::TestWithParam<Operation> {};

TEST_P(ExactLoweringOf, LeavesNoneAndKeepsTheModuleValid) {
    const std::string pattern = std::string(" ") + GetParam().opcode;
    const std::vector<uint32_t> before = asWritten(GetParam().expression);
    ASSERT_NE(test::disassembly(before).find(pattern), std::string::npos) << "the test does not produce the operation";
    const std::vector<uint32_t> after = lowerExactly(before);
    EXPECT_EQ(test::validationErrors(after), "") << test::disassembly(after);
    EXPECT_EQ(test::disassembly(after).find(pattern), std::string::npos) << test::disassembly(after);
}

INSTANTIATE_TEST_SUITE_P(
        EveryOperation, ExactLoweringOf,
        ::testing::Values(
                Operation{ "OpDot", "vec4(dot(u.a.xyz, u.b.xyz))" }, Operation{ "OpMatrixTimesVector", "u.m * u.a" },
                Operation{ "OpVectorTimesMatrix", "u.a * u.m" }, Operation{ "OpMatrixTimesMatrix", "(u.m * u.n)[2]" },
                Operation{ "OpOuterProduct", "outerProduct(u.a, u.b)[1]" }, Operation{ "OpFMod", "mod(u.a, u.b)" },
                Operation{ "OpSMod", "vec4(int(u.a.x) % int(u.a.y))" }, Operation{ "OpFDiv", "u.a / 3.0" },
                Operation{ "FClamp", "clamp(u.a, u.b, u.c)" },
                Operation{ "FClamp", "clamp(u.a, vec4(0), vec4(1,1,-1,1))" },
                Operation{ "SClamp", "vec4(clamp(int(u.a.x), int(u.b.x), 3))" },
                Operation{ "UClamp", "vec4(clamp(uint(u.a.x), uint(u.b.x), 3u))" },
                Operation{ "OpFDiv", "u.a / vec4(3.0, 5.0, 7.0, 9.0)" },
                Operation{ "Length", "vec4(length(u.a), length(u.a.x), 0, 0)" },
                Operation{ "Distance", "vec4(distance(u.a, u.b))" },
                Operation{ "Normalize", "vec4(normalize(u.a.xyz), 1)" }, Operation{ "Reflect", "reflect(u.a, u.b)" },
                Operation{ "Refract", "refract(u.a, u.b, u.s.x)" },
                Operation{ "FaceForward", "faceforward(u.a, u.b, u.c)" }, Operation{ "FMix", "mix(u.a, u.b, u.c)" },
                Operation{ "SmoothStep", "smoothstep(u.a, u.b, u.c)" },
                Operation{ "SmoothStep", "smoothstep(0.2, 0.7, u.c)" }, Operation{ "Fma", "fma(u.a, u.b, u.c)" },
                Operation{ "Determinant", "vec4(determinant(u.m), determinant(u.m3), determinant(mat2(u.a)), 0)" },
                Operation{ "MatrixInverse", "inverse(u.m)[0] + vec4(inverse(u.m3)[1], inverse(mat2(u.a))[1].x)" },
                Operation{ "Radians", "radians(u.a)" }, Operation{ "Degrees", "degrees(u.a)" },
                Operation{ "Cross", "vec4(cross(u.a.xyz, u.b.xyz), 1)" }, Operation{ "Tan", "tan(u.a)" },
                Operation{ "Acos", "acos(u.a)" }, Operation{ "Atan", "atan(u.a)" },
                Operation{ "Atan2", "atan(u.a, u.b)" }, Operation{ "Asin", "asin(u.a)" },
                Operation{ "Sinh", "sinh(u.a)" }, Operation{ "Cosh", "cosh(u.a)" }, Operation{ "Tanh", "tanh(u.a)" },
                Operation{ "Asinh", "asinh(u.a)" }, Operation{ "Acosh", "acosh(u.a)" },
                Operation{ "Atanh", "atanh(u.a)" }),
        [](auto const& each) { return std::to_string(each.index) + "_" + each.param.opcode; });

TEST(ExactLowering, DividesByASpecialisationConstantThroughItsReciprocal) {
    const std::string text = test::disassembly(lowerExactly(optimized("u.a * (u.s.x / kSpec)")));
    EXPECT_NE(text.find("OpFDiv %float %float_1 %kSpec"), std::string::npos) << text;
}

TEST(ExactLowering, TreatsWhatFollowsFromSpecialisationConstantsAsConstant) {
    const std::string text =
            test::disassembly(lowerExactly(optimized("vec4(u.s.x / (kSpec > 2.0 ? 7.0 : kSpec * 5.0))")));
    EXPECT_EQ(test::validationErrors(lowerExactly(optimized("vec4(u.s.x / (kSpec > 2.0 ? 7.0 : kSpec * 5.0))"))), "");
    EXPECT_NE(text.find("OpFDiv %float %float_1 "), std::string::npos) << text;
}

TEST(ExactLowering, KeepsClampsWhoseBoundsAreInOrder) {
    const std::vector<uint32_t> before = asWritten("clamp(u.a, vec4(0.0), vec4(1.0, 0.0, 2.0, 3.0))");
    EXPECT_EQ(lowerExactly(before), before);
}

TEST(ExactLowering, ChoosesQuotientsByZeroUnlessTheDivisorIsConstant) {
    for (const char* by :
         { "vec4(int(u.a.x) / int(u.b.x))", "vec4(uint(u.a.x) / uint(u.b.x))", "vec4(uvec4(u.a) % uvec4(u.b))",
           "vec4(ivec4(u.a) % ivec4(u.b))", "vec4(ivec4(u.a) / 0)" }) {
        const std::vector<uint32_t> before = asWritten(by), after = lowerExactly(before);
        EXPECT_EQ(test::validationErrors(after), "") << by;
        EXPECT_NE(test::disassembly(after).find("OpIEqual"), std::string::npos) << by;
    }
    for (const char* by : { "vec4(int(u.a.x) / 3)", "vec4(ivec4(u.a) / ivec4(1, 2, 3, -4))", "vec4(uvec4(u.a) % 7u)" })
        EXPECT_EQ(test::disassembly(lowerExactly(optimized(by))).find("OpIEqual"), std::string::npos) << by;
}

/// A fragment shader with a flat texture, an array of such and a cube.
std::string afterLookUp(std::string const& lookUp) {
    const std::string text = R"(#version 450
layout(set = 0, binding = 0) uniform sampler2D flat2d;
layout(set = 0, binding = 1) uniform sampler2DArray layers;
layout(set = 0, binding = 2) uniform samplerCube cube;
layout(location = 0) in vec4 at;
layout(location = 0) out vec4 color;
void main() { color = )" + lookUp +
                             "; }";
    const Result<std::vector<uint32_t>> spirv = spirvFromGlsl(text, backend::ShaderStage::Fragment, "test");
    EXPECT_TRUE(spirv) << (spirv ? "" : spirv.error().message);
    const std::vector<uint32_t> after = lowerExactly(*spirv);
    EXPECT_EQ(test::validationErrors(after), "");
    return test::disassembly(after);
}

TEST(ExactLowering, ShortensNegativeCoordinatesOfFlatTextures) {
    for (const char* lookUp :
         { "texture(flat2d, at.xy)", "texture(flat2d, at.xy, 1.0)", "textureLod(flat2d, at.xy, 0.0)",
           "textureGrad(flat2d, at.xy, at.zw, at.wz)", "textureGather(flat2d, at.xy)", "texture(layers, at.xyz)" }) {
        const std::string text = afterLookUp(lookUp);
        EXPECT_NE(text.find("OpFSub"), std::string::npos) << lookUp;
        EXPECT_NE(text.find("OpSelect"), std::string::npos) << lookUp;
    }
    for (const char* lookUp : { "texture(cube, at.xyz)", "texelFetch(flat2d, ivec2(at.xy), 0)" })
        EXPECT_EQ(afterLookUp(lookUp).find("OpFSub"), std::string::npos) << lookUp;
}

/// By the two formulas of lp_build_sample_wrap_linear(), for a size that is a power of two.
struct Repeated {
    float texel, weight;
    friend bool operator==(Repeated const&, Repeated const&) = default;
};
Repeated byMask(float c, float size) {
    const float at = c * size - 0.5f, floor = std::floor(at), wrapped = floor - size * std::floor(floor / size);
    return { wrapped, at - floor };
}
Repeated byFraction(float c, float size) {
    const float at = (c - std::floor(c)) * size - 0.5f, floor = std::floor(at);
    return { at < 0 ? size - 1 : floor, at - floor };
}
float shortened(float c) { return c < 0 ? 0.5f + (c - 0.5f) : c; }

TEST(ExactLowering, BothWaysToRepeatATextureGiveTheSameBitsOfShortenedCoordinates) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> exponent(-30, 7);
    uint32_t different = 0;
    for (int i = 0; i < 1'000'000; ++i) {
        const float c = std::exp2(exponent(random)) * (i % 2 ? 1.0f : -1.0f);
        const auto size = static_cast<float>(1u << random() % 15);
        different += !(byMask(c, size) == byFraction(c, size));
        const float s = shortened(c);
        ASSERT_EQ(byMask(s, size), byFraction(s, size)) << c << " " << size;
        ASSERT_LE(std::abs(s - c), std::max(0x1p-24f, std::abs(c) * 0x1p-23f));
    }
    EXPECT_GT(different, 100'000u) << "the coordinates need no change";
}

TEST(ExactLowering, KeepsDivisionByAVariable) {
    const std::string text = test::disassembly(lowerExactly(optimized("u.a / u.b")));
    EXPECT_NE(text.find("OpFDiv"), std::string::npos);
}

TEST(ExactLowering, PassesMediumPrecisionOnToEveryStep) {
    Result<std::vector<uint32_t>> spirv = spirvFromGlsl(R"(#version 450
        layout(set = 0, binding = 0, std140) uniform U { mediump vec3 a; mediump vec3 b; } u;
        layout(location = 0) out mediump float color;
        void main() { color = dot(u.a, u.b); })",
                                                        backend::ShaderStage::Fragment, "test");
    ASSERT_TRUE(spirv);
    const std::vector<uint32_t> lowered = lowerExactly(*spirv);
    EXPECT_EQ(test::validationErrors(lowered), "");
    const std::string text = test::disassembly(lowered);
    size_t relaxed = 0, steps = 0;
    for (size_t at = 0; (at = text.find("RelaxedPrecision", at)) != std::string::npos; ++at) ++relaxed;
    for (const char* step : { "= OpFMul", "= OpFAdd", "= OpCompositeExtract" }) {
        for (size_t at = 0; (at = text.find(step, at)) != std::string::npos; ++at) ++steps;
    }
    EXPECT_EQ(steps, 1u + 2u + 3u);
    EXPECT_GE(relaxed, steps) << text;
}

TEST(ExactLowering, LeavesAModuleWithoutSuchOperationsAsItIs) {
    const std::vector<uint32_t> before = optimized("max(u.a * u.b, sqrt(u.c))");
    EXPECT_EQ(lowerExactly(before), before);
}

} // namespace
} // namespace filament_core::shader
