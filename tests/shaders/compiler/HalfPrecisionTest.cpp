// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/HalfPrecision.h"

#include "shaders/compiler/GlslToSpirv.h"

#include <gtest/gtest.h>

namespace filament::shader {
namespace {

TEST(HalfPrecision, RenamesTypesAndNothingThatContainsTheirNames) {
    EXPECT_EQ(float16FromGlsl("vec3 f(const vec4 sh[9], float x) { return vec3(sh[0]) * x; }"),
              "f16vec3 f(const f16vec4 sh[9], float16_t x) { return f16vec3(sh[0]) * x; }");
    EXPECT_EQ(float16FromGlsl("floatBitsToUint(myvec3, ivec2(1))"), "floatBitsToUint(myvec3, ivec2(1))");
}

TEST(HalfPrecision, WritesLiteralsAsTheNearestNumberOf16Bits) {
    EXPECT_EQ(float16FromGlsl("1.0f"), "1.00000000000hf");
    EXPECT_EQ(float16FromGlsl("0.318309886183791f"), "0.318359375000hf") << "cut off it would be 0.318115234375";
    EXPECT_EQ(float16FromGlsl("x*.5+1e-10f"), "x*0.500000000000hf+0.00000000000hf");
    EXPECT_EQ(float16FromGlsl("1e4f-x"), "10000.0000000hf-x");
}

TEST(HalfPrecision, LeavesWholeNumbersAsTheyAre) {
    EXPECT_EQ(float16FromGlsl("i << 16u & 0x00FF0eFFu | sh[8] == 3"), "i << 16u & 0x00FF0eFFu | sh[8] == 3");
}

TEST(HalfPrecision, PutsNoArithmeticOf32BitsIntoTheModule) {
    const std::string text = "#version 450\n" + std::string(kFloat16Prelude) +
                             "layout(location = 0) in vec4 a; layout(location = 0) out vec4 color;\n" +
                             float16FromGlsl("float sq1(float x) { return (x + 0.5f) * 1e-3f * x; }\n") +
                             "void main() { color = vec4(float(sq1(float16_t(a.x)))); }\n";
    const Result<std::vector<uint32_t>> spirv = spirvFromGlsl(text, backend::ShaderStage::Fragment, "half");
    ASSERT_TRUE(spirv) << spirv.error().message;
    size_t conversions = 0; // OpFConvert: one in, one out
    for (size_t at = 5; at < spirv->size(); at += (*spirv)[at] >> 16) conversions += ((*spirv)[at] & 0xFFFFu) == 115;
    EXPECT_EQ(conversions, 2u);
}

} // namespace
} // namespace filament::shader
