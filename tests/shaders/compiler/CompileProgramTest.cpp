// SPDX-License-Identifier: Apache-2.0
#include "shaders/compiler/CompileProgram.h"

#include "tests/shaders/compiler/SpirvTools.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

namespace filament_core::shader {
namespace {

using backend::BindingType;
using backend::ShaderStage;
using test::validationErrors;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::string_view kVertex = R"(#version 450
layout(location = 0) in vec3 position;
layout(location = 3) in vec2 uv;
layout(location = 2) in vec4 neverRead;
layout(location = 0) out vec2 varyingUv;
layout(set = 0, binding = 0, std140) uniform Frame { mat4 clipFromWorld; } frame;
layout(set = 1, binding = 0, std140) uniform Params { vec4 tint; } params;
void main() {
    varyingUv = uv + params.tint.xy;
    gl_Position = frame.clipFromWorld * vec4(position, 1.0);
}
)";

constexpr std::string_view kFragment = R"(#version 450
layout(location = 0) in vec2 varyingUv;
layout(location = 0) out vec4 color;
layout(set = 0, binding = 5) uniform samplerCube sky;
layout(set = 1, binding = 2) uniform sampler2D albedo;
layout(set = 1, binding = 0, std140) uniform Params { vec4 tint; } params;
void main() { color = texture(albedo, varyingUv) * params.tint + texture(sky, vec3(varyingUv, 1.0)); }
)";

constexpr std::string_view kFullScreen = R"(#version 450
void main() { gl_Position = vec4(float(gl_VertexIndex & 1) * 4.0 - 1.0, float(gl_VertexIndex & 2) * 2.0 - 1.0, 0.0, 1.0); }
)";

TEST(CompileProgram, GivesValidSpirvAndEsslForBothStages) {
    const Result<ProgramShaders> program = compileProgram(kVertex, kFragment);
    ASSERT_TRUE(program) << program.error().message;
    EXPECT_EQ(validationErrors(program->vertexSpirv), "");
    EXPECT_EQ(validationErrors(program->fragmentSpirv), "");
    EXPECT_TRUE(program->vertexEssl.starts_with("#version 310 es\n"));
    EXPECT_TRUE(program->fragmentEssl.starts_with("#version 310 es\n"));
    EXPECT_THAT(program->fragmentEssl, HasSubstr("precision highp float;"));
}

TEST(CompileProgram, ReflectsBindingsOfBothStagesInAscendingOrder) {
    const Result<ProgramShaders> program = compileProgram(kVertex, kFragment);
    ASSERT_TRUE(program) << program.error().message;
    backend::ProgramLayout expected{};
    expected[0].count = 2;
    expected[0].bindings[0] = { .binding = 0,
                                .type = BindingType::DynamicUniformBuffer,
                                .stages = ShaderStage::Vertex };
    expected[0].bindings[1] = { .binding = 5, .type = BindingType::SampledTexture, .stages = ShaderStage::Fragment };
    expected[1].count = 2;
    expected[1].bindings[0] = { .binding = 0, .type = BindingType::UniformBuffer, .stages = ShaderStage::Both };
    expected[1].bindings[1] = { .binding = 2, .type = BindingType::SampledTexture, .stages = ShaderStage::Fragment };
    EXPECT_EQ(program->layout, expected);
    EXPECT_EQ(program->vertexInputs, 1u << 0 | 1u << 3) << "the attribute that is never read is not required";
}

TEST(CompileProgram, MarksTheListedUniformBuffersDynamicAndNoOthers) {
    const Result<ProgramShaders> program =
            compileProgram(kVertex, kFragment, { .dynamicUniformBuffers = { { { 1, 0 } } } });
    ASSERT_TRUE(program) << program.error().message;
    EXPECT_EQ(program->layout[0].bindings[0].type, BindingType::UniformBuffer);
    EXPECT_EQ(program->layout[1].bindings[0].type, BindingType::DynamicUniformBuffer);
}

TEST(CompileProgram, NumbersEsslBindingsByTheLayoutThatWasGiven) {
    backend::ProgramLayout layout{};
    layout[0].count = 3;
    layout[0].bindings[0] = { .binding = 0, .type = BindingType::DynamicUniformBuffer };
    layout[0].bindings[1] = { .binding = 1, .type = BindingType::DynamicUniformBuffer };
    layout[0].bindings[2] = { .binding = 5, .type = BindingType::SampledTexture };
    layout[1].count = 3;
    layout[1].bindings[0] = { .binding = 0, .type = BindingType::UniformBuffer };
    layout[1].bindings[1] = { .binding = 1, .type = BindingType::SampledTexture };
    layout[1].bindings[2] = { .binding = 2, .type = BindingType::SampledTexture };
    const Result<ProgramShaders> program = compileProgram(kVertex, kFragment, { .layout = layout });
    ASSERT_TRUE(program) << program.error().message;
    EXPECT_EQ(program->layout, layout);
    EXPECT_THAT(program->vertexEssl, HasSubstr("layout(binding = 0, std140) uniform Frame"));
    EXPECT_THAT(program->vertexEssl, HasSubstr("layout(binding = 2, std140) uniform Params"));
    EXPECT_THAT(program->fragmentEssl, HasSubstr("layout(binding = 0) uniform highp samplerCube sky"));
    EXPECT_THAT(program->fragmentEssl, HasSubstr("layout(binding = 2) uniform highp sampler2D albedo"));
}

TEST(CompileProgram, RefusesALayoutThatLacksABinding) {
    backend::ProgramLayout layout{};
    layout[0].count = 1;
    layout[0].bindings[0] = { .binding = 0, .type = BindingType::DynamicUniformBuffer };
    const Result<ProgramShaders> program = compileProgram(kVertex, kFragment, { .layout = layout });
    ASSERT_FALSE(program);
    EXPECT_EQ(program.error().code, ErrorCode::InvalidArgument);
    EXPECT_THAT(program.error().message, HasSubstr("set 0 binding 5"));
}

TEST(CompileProgram, TurnsASubpassInputIntoAFramebufferFetchOfTheSameAttachment) {
    const Result<ProgramShaders> program = compileProgram(kFullScreen, R"(#version 450
        layout(input_attachment_index = 0, set = 1, binding = 1) uniform subpassInput hdr;
        layout(location = 1) out vec4 color;
        void main() { color = subpassLoad(hdr) * 0.5; })");
    ASSERT_TRUE(program) << program.error().message;
    EXPECT_EQ(program->layout[1].bindings[0].type, BindingType::InputAttachment);
    EXPECT_EQ(program->layout[1].bindings[0].inputAttachment, 0);
    EXPECT_EQ(validationErrors(program->fragmentSpirv), "");
    EXPECT_THAT(program->fragmentEssl, HasSubstr("GL_EXT_shader_framebuffer_fetch"));
    EXPECT_THAT(program->fragmentEssl, HasSubstr("layout(location = 0) inout"));
    EXPECT_THAT(program->fragmentEssl, HasSubstr("layout(location = 1) out"));
}

TEST(CompileProgram, LeavesSpecialisationConstantsOpenInBothLanguages) {
    const Result<ProgramShaders> program = compileProgram(kFullScreen, R"(#version 450
        layout(constant_id = 3) const bool kRed = false;
        layout(location = 0) out vec4 color;
        void main() { color = kRed ? vec4(1, 0, 0, 1) : vec4(0, 1, 0, 1); })");
    ASSERT_TRUE(program) << program.error().message;
    EXPECT_THAT(program->fragmentEssl, HasSubstr("#ifndef SPIRV_CROSS_CONSTANT_ID_3"));
    EXPECT_THAT(test::disassembly(program->fragmentSpirv), HasSubstr("SpecId 3"));
}

TEST(CompileProgram, NamesFileAndLineOfAnErrorAndCountsTheOthers) {
    const Result<ProgramShaders> program = compileProgram(
            kFullScreen, "#version 450\nlayout(location = 0) out vec4 color;\nvoid main() {\n  color = metalic;\n}\n",
            { .fragmentName = "paint.frag" });
    ASSERT_FALSE(program);
    EXPECT_EQ(program.error().code, ErrorCode::InvalidArgument);
    EXPECT_TRUE(program.error().message.starts_with("paint.frag:4: 'metalic'")) << program.error().message;
    EXPECT_THAT(program.error().message, Not(HasSubstr("\n")));
}

TEST(CompileProgram, FollowsLineDirectivesThatNameAFile) {
    const Result<ProgramShaders> program =
            compileProgram(kFullScreen, "#version 450\n#extension GL_GOOGLE_cpp_style_line_directive : require\n"
                                        "#line 40 \"wood.mat\"\nvoid main() {\n  oops();\n}\n");
    ASSERT_FALSE(program);
    EXPECT_TRUE(program.error().message.starts_with("wood.mat:41: ")) << program.error().message;
}

TEST(CompileProgram, RefusesResourcesThatNoBindingTypeStandsFor) {
    const Result<ProgramShaders> program = compileProgram(kFullScreen, R"(#version 450
        layout(set = 0, binding = 0, rgba8) readonly uniform image2D picture;
        layout(location = 0) out vec4 color;
        void main() { color = imageLoad(picture, ivec2(0)); })");
    ASSERT_FALSE(program);
    EXPECT_THAT(program.error().message, HasSubstr("storage images"));
}

TEST(CompileProgram, AFragmentStageOnlyReadsStorageBuffersAndAVertexStageHasNone) {
    const auto fragment = [](std::string_view qualifier) {
        return fmt::format(
                "#version 450\nlayout(set = 2, binding = 3, std430) {} buffer B {{ vec4 values[]; }} table;\n"
                "layout(location = 0) out vec4 color;\nvoid main() {{ color = table.values[1]; }}\n",
                qualifier);
    };
    const Result<ProgramShaders> reads = compileProgram(kFullScreen, fragment("readonly"));
    ASSERT_TRUE(reads) << reads.error().message;
    EXPECT_EQ(reads->layout[2].bindings[0], (backend::BindingDesc{ .binding = 3,
                                                                   .type = backend::BindingType::StorageBuffer,
                                                                   .stages = backend::ShaderStage::Fragment }));
    const Result<ProgramShaders> mayWrite = compileProgram(kFullScreen, fragment(""));
    ASSERT_FALSE(mayWrite);
    EXPECT_THAT(mayWrite.error().message, HasSubstr("declare it readonly"));
    const Result<ProgramShaders> vertex = compileProgram(
            "#version 450\nlayout(set = 0, binding = 0, std430) readonly buffer B { vec4 at[]; } corners;\n"
            "void main() { gl_Position = corners.at[gl_VertexIndex]; }\n",
            kFragment);
    ASSERT_FALSE(vertex);
    EXPECT_THAT(vertex.error().message, HasSubstr("a vertex stage cannot have one"));
}

TEST(CompileProgram, AComputeStageIsNumberedByKindGroupAfterGroup) {
    const Result<ComputeShader> compute = compileCompute(R"(#version 450
        layout(local_size_x = 32, local_size_y = 2) in;
        layout(set = 0, binding = 4, std430) buffer A { uint a[]; };
        layout(set = 1, binding = 0, std140) uniform U { uvec4 u; };
        layout(set = 1, binding = 2, std430) readonly buffer B { uint b[]; };
        layout(set = 3, binding = 7) uniform highp sampler2D picture;
        void main() { a[0] = b[u.x] + uint(texelFetch(picture, ivec2(0), 0).x); })");
    ASSERT_TRUE(compute) << compute.error().message;
    EXPECT_EQ(backend::flatBinding(compute->layout, 0, 4), 0);
    EXPECT_EQ(backend::flatBinding(compute->layout, 1, 2), 1);
    EXPECT_EQ(backend::flatBinding(compute->layout, 1, 0), 0);
    EXPECT_EQ(backend::flatBinding(compute->layout, 3, 7), 0);
    for (const char* text :
         { "#version 310 es", "local_size_x = 32, local_size_y = 2", "binding = 1, std430", "readonly" }) {
        EXPECT_THAT(compute->essl, HasSubstr(text));
    }
    EXPECT_THAT(test::disassembly(compute->spirv), HasSubstr("OpEntryPoint GLCompute"));
}

TEST(CompileProgram, NamesFileAndLineOfAnErrorInAComputeStage) {
    const Result<ComputeShader> compute =
            compileCompute("#version 450\nlayout(local_size_x = 1) in;\nvoid main() {\n  oops();\n}\n",
                           { .computeName = "histogram.comp" });
    ASSERT_FALSE(compute);
    EXPECT_TRUE(compute.error().message.starts_with("histogram.comp:4: ")) << compute.error().message;
}

TEST(CompileProgram, GivesTheSameBytesFromEveryThread) {
    const Result<ProgramShaders> expected = compileProgram(kVertex, kFragment);
    ASSERT_TRUE(expected);
    std::vector<std::thread> threads;
    std::array<bool, 4> equal{};
    for (bool& same : equal) {
        threads.emplace_back([&] {
            const Result<ProgramShaders> again = compileProgram(kVertex, kFragment);
            same = again && again->fragmentSpirv == expected->fragmentSpirv &&
                   again->vertexSpirv == expected->vertexSpirv && again->fragmentEssl == expected->fragmentEssl &&
                   again->vertexEssl == expected->vertexEssl;
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_THAT(equal, ::testing::Each(true));
}

} // namespace
} // namespace filament_core::shader
