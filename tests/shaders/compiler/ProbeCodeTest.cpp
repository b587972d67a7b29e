// SPDX-License-Identifier: Apache-2.0
// The code of reflection probes in lit materials: one function, and no array of cubes in programs without probes.
#include "shaders/compiler/KeepCalls.h"

#include "shaders/compiler/GlslToSpirv.h"
#include "shaders/compiler/MaterialCompiler.h"
#include "shaders/compiler/SpirvWords.h"
#include "shaders/interface/ShaderInterface.h"
#include "tests/shaders/compiler/SpirvTools.h"

#include <gtest/gtest.h>

namespace filament_core::shader {
namespace {

size_t callsIn(std::span<const uint32_t> module) {
    size_t calls = 0;
    forEachInstruction(module, [&](spv::Op op, SpirvWords) { calls += op == spv::OpFunctionCall; });
    return calls;
}

TEST(KeepCalls, AFunctionOfTheListIsCalledAndOthersAreInlined) {
    for (const auto& [name, calls] : { std::pair("probedRadiance", 2u), std::pair("probedRadiances", 0u) }) {
        const std::string text = fmt::format(R"(#version 450
            layout(location = 0) in vec4 v;
            layout(location = 0) out vec4 color;
            vec3 {0}(vec3 a, float b) {{ return sin(a) * b; }}
            void main() {{ color = vec4({0}(v.xyz, v.w) + {0}(v.yzw, v.x), 1.0); }})",
                                             name);
        const Result<std::vector<uint32_t>> parsed = spirvFromGlsl(text, backend::ShaderStage::Fragment, "a");
        ASSERT_TRUE(parsed) << parsed.error().message;
        const Result<std::vector<uint32_t>> fast = optimizeSpirv(keepCalls(*parsed), Optimization::Performance);
        ASSERT_TRUE(fast);
        EXPECT_EQ(callsIn(*fast), calls) << name;
        EXPECT_EQ(test::validationErrors(*fast), "");
    }
}

TEST(ProbeCode, OpenGlEsDeclaresAnArrayOfCubesWhereTheConstantAsksForIt) {
    const Result<MaterialPackage> material = compileMaterial(
            "material { name : m, shadingModel : lit, variantFilter : [ fog, skinning, shadowReceiver ] }\n"
            "fragment { void material(inout MaterialInputs m) { prepareMaterial(m); m.roughness = 0.5; } }",
            "a.mat");
    ASSERT_TRUE(material) << material.error().message;
    const std::string essl = material->findVariant(0)->fragment->essl;
    const std::string constant = "SPIRV_CROSS_CONSTANT_ID_" + std::to_string(kQualityReflectionProbes);
    for (const std::string line :
         { "#extension GL_EXT_texture_cube_map_array : require", "samplerCubeArray passProbes;" }) {
        const size_t at = essl.find(line);
        ASSERT_NE(at, std::string::npos) << line;
        const size_t before = essl.rfind("#if ", at);
        EXPECT_EQ(essl.substr(before, essl.find('\n', before) - before), "#if " + constant + " != 0") << line;
        EXPECT_EQ(essl.find("#endif", before), essl.find('\n', at) + 1) << line;
    }
    EXPECT_EQ(essl.find("samplerCubeArray"), essl.rfind("samplerCubeArray")) << "one";
}

} // namespace
} // namespace filament_core::shader
