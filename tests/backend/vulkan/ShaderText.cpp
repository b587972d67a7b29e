// SPDX-License-Identifier: Apache-2.0
#include "tests/backend/vulkan/ShaderText.h"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>
#include <gtest/gtest.h>

namespace filament::backend::vulkan {

std::vector<uint32_t> spirvFromGlsl(ShaderStage stage, std::string const& text) {
    static const bool initialized = glslang::InitializeProcess();
    EXPECT_TRUE(initialized);
    const EShLanguage language = stage == ShaderStage::Vertex ? EShLangVertex : EShLangFragment;
    const std::string whole = "#version 450\n" + text;
    const char* const strings[] = { whole.c_str() };
    glslang::TShader shader(language);
    shader.setStrings(strings, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, language, glslang::EShClientVulkan, 110);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
    const auto rules = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    const bool parsed = shader.parse(GetDefaultResources(), 450, false, rules);
    EXPECT_TRUE(parsed) << shader.getInfoLog();
    if (!parsed) return {};
    glslang::TProgram program;
    program.addShader(&shader);
    EXPECT_TRUE(program.link(rules)) << program.getInfoLog();
    std::vector<uint32_t> words;
    glslang::GlslangToSpv(*program.getIntermediate(language), words);
    return words;
}

} // namespace filament::backend::vulkan
