// SPDX-License-Identifier: Apache-2.0
// Uses glslang's C interface: its C++ classes have no run-time type information, which UBSan needs.
#include "tests/backend/vulkan/ShaderText.h"

#include <glslang/Include/glslang_c_interface.h>
#include <glslang/Public/resource_limits_c.h>
#include <gtest/gtest.h>

#include <memory>

namespace filament_core::backend::vulkan {

std::vector<uint32_t> spirvFromGlsl(ShaderStage stage, std::string const& text) {
    static const bool initialized = glslang_initialize_process() != 0;
    EXPECT_TRUE(initialized);
    const std::string whole = "#version 450\n" + text;
    glslang_input_t input{};
    input.language = GLSLANG_SOURCE_GLSL;
    input.stage = stage == ShaderStage::Vertex ? GLSLANG_STAGE_VERTEX : GLSLANG_STAGE_FRAGMENT;
    input.client = GLSLANG_CLIENT_VULKAN;
    input.client_version = GLSLANG_TARGET_VULKAN_1_1;
    input.target_language = GLSLANG_TARGET_SPV;
    input.target_language_version = GLSLANG_TARGET_SPV_1_3;
    input.code = whole.c_str();
    input.default_version = 450;
    input.default_profile = GLSLANG_NO_PROFILE;
    input.messages = static_cast<glslang_messages_t>(GLSLANG_MSG_SPV_RULES_BIT | GLSLANG_MSG_VULKAN_RULES_BIT);
    input.resource = glslang_default_resource();

    const std::unique_ptr<glslang_shader_t, decltype(&glslang_shader_delete)> shader(glslang_shader_create(&input),
                                                                                     &glslang_shader_delete);
    const bool parsed = glslang_shader_preprocess(shader.get(), &input) && glslang_shader_parse(shader.get(), &input);
    EXPECT_TRUE(parsed) << glslang_shader_get_info_log(shader.get());
    if (!parsed) return {};
    const std::unique_ptr<glslang_program_t, decltype(&glslang_program_delete)> program(glslang_program_create(),
                                                                                        &glslang_program_delete);
    glslang_program_add_shader(program.get(), shader.get());
    const bool linked = glslang_program_link(program.get(), input.messages) != 0;
    EXPECT_TRUE(linked) << glslang_program_get_info_log(program.get());
    if (!linked) return {};
    glslang_program_SPIRV_generate(program.get(), input.stage);
    std::vector<uint32_t> words(glslang_program_SPIRV_get_size(program.get()));
    glslang_program_SPIRV_get(program.get(), words.data());
    return words;
}

} // namespace filament_core::backend::vulkan
