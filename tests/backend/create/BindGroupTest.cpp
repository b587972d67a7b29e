// SPDX-License-Identifier: Apache-2.0
// Four bind groups, and what a group's entry shows to the shader.
#include "tests/backend/create/Gpu.h"

namespace filament_core::backend {

DRIVER_SUITE(BindGroups);

namespace {

constexpr uint32_t kGroups = kMaxBindGroups;

std::string declarations() {
    std::string text;
    for (uint32_t i = 0; i < kGroups; ++i) {
        text += fmt::format("layout(set = {0}, binding = 0, std140) uniform Block{0} {{ vec4 value{0}; }};\n"
                            "layout(set = {0}, binding = 1) uniform highp sampler2D image{0};\n",
                            i);
    }
    return text;
}

/// Component i of the result is the uniform plus the texel of group i.
std::string sumOfEachGroup() {
    std::string body;
    for (uint32_t i = 0; i < kGroups; ++i) {
        body += fmt::format("result[{0}] = value{0}.x + texelFetch(image{0}, ivec2(0), 0).x;\n", i);
    }
    return fragmentOf(declarations(), body);
}

/// A uniform of `value` and a texel of `texel`.
BindGroupHandle groupOf(Gpu& gpu, Program const& program, uint32_t index, float value, float texel) {
    const BufferHandle buffer = gpu.buffer(BufferUsage::Uniform, std::vector<float>{ value, 0, 0, 0 });
    const TextureHandle image = gpu.image(Format::R32F, 1, 1, bytesOf(std::vector<float>{ texel }));
    return gpu.group(program, index,
                     { { .binding = 0, .buffer = buffer, .size = 16 },
                       { .binding = 1, .texture = image, .sampler = gpu.sampler() } });
}

void bind(Gpu& gpu, BindGroupHandle group, uint32_t index, uint32_t offset = 0) {
    CmdBindGroup command{ .group = group, .index = static_cast<uint8_t>(index) };
    if (index == 0) command.dynamicCount = 1;
    command.dynamicOffsets[0] = offset;
    gpu.record(command);
}

} // namespace

DRIVER_TEST(BindGroups, FourGroupsAreReadByOneProgramAndReplacedOneByOne) {
    const Program program = gpu.program(kFullScreenVertex, sumOfEachGroup(), {}, { { 0, 0 } });
    const TextureHandle target = gpu.target(Format::RGBA32F, kGroups + 1, 1);
    PassDesc pass = passOver({ { target, Format::RGBA32F } }, kGroups + 1, 1);
    const PipelineHandle pipeline = gpu.pipeline(pipelineFor(program, pass.layout));
    std::array<BindGroupHandle, kGroups> first{}, second{};
    for (uint32_t i = 0; i < kGroups; ++i) {
        const auto number = static_cast<float>(i + 1);
        first[i] = groupOf(gpu, program, i, number, 16 * number);
        second[i] = groupOf(gpu, program, i, -number, 256 * number);
    }
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ pipeline });
    for (uint32_t i = 0; i < kGroups; ++i) bind(gpu, first[i], i);
    for (uint32_t step = 0; step <= kGroups; ++step) {
        gpu.record(CmdSetScissor{ { static_cast<int32_t>(step), 0, 1, 1 } });
        gpu.record(CmdDraw{ .vertexCount = 3 });
        if (step < kGroups) bind(gpu, second[step], step);
    }
    gpu.record(CmdEndPass{});
    const auto pixels = gpu.readAs<Rgba>(target, { 0, 0, kGroups + 1, 1 });
    for (uint32_t step = 0; step <= kGroups; ++step) {
        for (uint32_t i = 0; i < kGroups; ++i) {
            const auto number = static_cast<float>(i + 1);
            EXPECT_EQ(pixels[step][i], i < step ? 255 * number : 17 * number) << "group " << i << " of draw " << step;
        }
    }
}

DRIVER_TEST(BindGroups, GroupsBeforeTheFirstDifferenceOfTwoLayoutsStayBound) {
    const std::string onlyTheLast =
            fragmentOf("layout(set = 0, binding = 0, std140) uniform Block0 { vec4 value0; };\n"
                       "layout(set = 0, binding = 1) uniform highp sampler2D image0;\n"
                       "layout(set = 1, binding = 0, std140) uniform Block1 { vec4 value1; };\n"
                       "layout(set = 1, binding = 1) uniform highp sampler2D image1;\n"
                       "layout(set = 2, binding = 0, std140) uniform Block2 { vec4 value2; };\n"
                       "layout(set = 2, binding = 1) uniform highp sampler2D image2;\n"
                       "layout(set = 3, binding = 5, std140) uniform Block3 { vec4 value3; };",
                       "result = vec4(value0.x + texelFetch(image0, ivec2(0), 0).x, value1.x + texelFetch(image1, "
                       "ivec2(0), 0).x,\n"
                       "              value2.x + texelFetch(image2, ivec2(0), 0).x, value3.x);");
    const Program all = gpu.program(kFullScreenVertex, sumOfEachGroup(), {}, { { 0, 0 } });
    const Program other = gpu.program(kFullScreenVertex, onlyTheLast, {}, { { 0, 0 } });
    const TextureHandle target = gpu.target(Format::RGBA32F, 2, 1);
    PassDesc pass = passOver({ { target, Format::RGBA32F } }, 2, 1);
    const PipelineHandle one = gpu.pipeline(pipelineFor(all, pass.layout));
    const PipelineHandle two = gpu.pipeline(pipelineFor(other, pass.layout));
    std::array<BindGroupHandle, kGroups> groups{};
    for (uint32_t i = 0; i < kGroups; ++i) groups[i] = groupOf(gpu, all, i, static_cast<float>(i + 1), 16);
    const BufferHandle last = gpu.buffer(BufferUsage::Uniform, std::vector<float>{ 99, 0, 0, 0 });
    const BindGroupHandle lastGroup = gpu.group(other, 3, { { .binding = 5, .buffer = last, .size = 16 } });

    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ one });
    for (uint32_t i = 0; i < kGroups; ++i) bind(gpu, groups[i], i);
    gpu.record(CmdSetScissor{ { 0, 0, 1, 1 } });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdBindPipeline{ two });
    bind(gpu, lastGroup, 3);
    gpu.record(CmdSetScissor{ { 1, 0, 1, 1 } });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdEndPass{});
    const auto pixels = gpu.readAs<Rgba>(target, { 0, 0, 2, 1 });
    EXPECT_EQ(pixels[0], (Rgba{ 17, 18, 19, 20 }));
    EXPECT_EQ(pixels[1], (Rgba{ 17, 18, 19, 99 }));
}

} // namespace filament_core::backend
