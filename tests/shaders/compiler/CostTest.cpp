// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/Cost.h"

#include "shaders/compiler/GlslToSpirv.h"

#include <gtest/gtest.h>

#include <string>

namespace filament_core::shader {
namespace {

InstructionCounts countsOf(std::string const& code) {
    const std::string text = "#version 450\nlayout(location = 0) in vec4 a;\nlayout(location = 0) out vec4 o;\n"
                             "layout(set = 1, binding = 1) uniform sampler2D t;\nvoid main() { " +
                             code + " }";
    const auto spirv = spirvFromGlsl(text, backend::ShaderStage::Fragment, "a");
    EXPECT_TRUE(spirv) << (spirv ? "" : spirv.error().message);
    const auto optimized = optimizeSpirv(*spirv);
    EXPECT_TRUE(optimized);
    return countInstructions(*optimized);
}

// Every main() returns: one of control.
TEST(Cost, CountsEachInstructionByItsKind) {
    EXPECT_EQ(countsOf("o = a;"), (InstructionCounts{ .control = 1, .memory = 2 }));
    EXPECT_EQ(countsOf("o = (a * a) / (a - 1.0);"), (InstructionCounts{ .arithmetic = 3, .control = 1, .memory = 2 }));
    EXPECT_EQ(countsOf("o = sin(a);"), (InstructionCounts{ .transcendental = 1, .control = 1, .memory = 2 }));
    EXPECT_EQ(countsOf("o = max(a, exp2(a));"),
              (InstructionCounts{ .arithmetic = 1, .transcendental = 1, .control = 1, .memory = 2 }));
    EXPECT_EQ(countsOf("o = texture(t, vec2(0.5));"), // the texture is loaded before it is read
              (InstructionCounts{ .control = 1, .memory = 2, .fetches = 1 }));
}

TEST(Cost, GrowsWithEveryFetchOfAMaterial) {
    const auto fetches = [](std::string const& code) {
        const auto package =
                compileMaterial("material { requires : [ uv0 ], parameters : [ { name : t, type : sampler2d } "
                                "] }\nfragment { void material(inout MaterialInputs m) { " +
                                        code + " } }",
                                "a.mat");
        EXPECT_TRUE(package) << (package ? "" : package.error().message);
        return countInstructions(package->variants[0].fragment->spirv).fetches;
    };
    const uint32_t none = fetches("prepareMaterial(m);");
    EXPECT_EQ(fetches("prepareMaterial(m); m.baseColor = texture(materialParams_t, getUV0());"), none + 2)
            << "with the bias of a view and without";
    EXPECT_EQ(fetches("m.normal = texture(materialParams_t, getUV0()).xyz; prepareMaterial(m); m.roughness = "
                      "texture(materialParams_t, getUV0() * 2.0).g;"),
              none + 4);
}

} // namespace
} // namespace filament_core::shader
