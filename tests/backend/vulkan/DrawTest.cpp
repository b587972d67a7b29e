// SPDX-License-Identifier: Apache-2.0
// The effect of pipelines, bindings and vertex data on pixels.
#include "tests/backend/vulkan/DriverFixture.h"

#include <bit>

namespace filament_core::backend::vulkan {
namespace {

constexpr Rgba8 kNothing{ 0, 0, 0, 0 };

const std::string kPositionVertex = R"(
layout(location = 0) in vec2 position;
void main() { gl_Position = vec4(position, 0.5, 1.0); })";

PipelineDesc positionPipeline(ProgramHandle program, PassLayout const& pass) {
    PipelineDesc desc{ .program = program, .pass = pass, .debugName = "positions" };
    desc.vertices.attributes[0] = { .location = 0, .buffer = 0, .format = VertexFormat::Float2 };
    desc.vertices.attributeCount = 1;
    desc.vertices.buffers[0].stride = 8;
    desc.vertices.bufferCount = 1;
    desc.raster.cull = CullMode::None;
    return desc;
}

class FrontFaceTest : public DriverTest {
protected:
    /// Whether a half-screen triangle with these corners is drawn if back faces are culled.
    bool isDrawn(std::vector<float> const& corners, FrontFace frontFace) {
        const ProgramHandle program = makeProgram(kPositionVertex, kRedFragment);
        PipelineDesc desc = positionPipeline(program, colorLayout());
        desc.raster.cull = CullMode::Back;
        desc.raster.frontFace = frontFace;
        const PipelineHandle pipeline = makePipeline(desc);
        const BufferHandle buffer = makeBuffer(BufferUsage::Vertex, corners);
        const TextureHandle target = makeTarget(4, 4);
        beginPass(target, 4, 4);
        commands.record(CmdBindPipeline{ pipeline });
        commands.record(CmdBindVertexBuffers{ .buffers = { buffer }, .count = 1 });
        commands.record(CmdDraw{ .vertexCount = 3 });
        endPass();
        return readPixels(target, 4, 4)[2 * 4 + 0] == kRed; // lower left
    }
};

TEST_F(FrontFaceTest, IsCounterClockwiseAsSeenInThePictureWithRowZeroOnTop) {
    // y = -1 is the top row: lower left, lower right, upper left runs counter-clockwise in the image.
    const std::vector<float> counterClockwise{ -1, 1, 1, 1, -1, -1 }, clockwise{ -1, 1, -1, -1, 1, 1 };
    EXPECT_TRUE(isDrawn(counterClockwise, FrontFace::CounterClockwise));
    EXPECT_FALSE(isDrawn(clockwise, FrontFace::CounterClockwise));
    EXPECT_TRUE(isDrawn(clockwise, FrontFace::Clockwise));
    EXPECT_FALSE(isDrawn(counterClockwise, FrontFace::Clockwise));
}

TEST_F(DriverTest, AttributesThatTheLayoutLacksReadZeroZeroZeroOne) {
    const ProgramHandle program = makeProgram(R"(
        layout(location = 0) in vec2 position;
        layout(location = 2) in vec4 missing;
        layout(location = 5) in uvec4 missingInteger;
        layout(location = 0) out vec4 value;
        void main() {
            value = missing + vec4(missingInteger) * 0.5; // (0, 0, 0, 1.5) if the w components are 1
            gl_Position = vec4(position, 0.5, 1.0);
        })",
                                              R"(
        layout(location = 0) in vec4 value;
        layout(location = 0) out vec4 color;
        void main() { color = value; })");
    const PipelineHandle pipeline = makePipeline(positionPipeline(program, colorLayout(Format::RGBA32F)));
    const BufferHandle corners = makeBuffer(BufferUsage::Vertex, std::vector<float>{ -1, -1, 3, -1, -1, 3 });
    const TextureHandle target = makeTarget(1, 1, Format::RGBA32F);
    beginPass(target, 1, 1, { 9, 9, 9, 9 }, Format::RGBA32F);
    commands.record(CmdBindPipeline{ pipeline });
    commands.record(CmdBindVertexBuffers{ .buffers = { corners }, .count = 1 });
    commands.record(CmdDraw{ .vertexCount = 3 });
    endPass();
    EXPECT_EQ(readFloats(target, 1, 1), (std::vector<float>{ 0, 0, 0, 1.5f }));
}

BindGroupLayout uniformLayout(BindingType type = BindingType::DynamicUniformBuffer) {
    BindGroupLayout layout;
    layout.bindings[0] = { .binding = 0, .type = type };
    layout.count = 1;
    return layout;
}

const std::string kUniformFragment = R"(
layout(set = 1, binding = 0) uniform Block { vec4 value; };
layout(location = 0) out vec4 color;
void main() { color = value; })";

TEST_F(DriverTest, EveryDrawSeesItsOwnDynamicOffset) {
    const ProgramLayout layout{ BindGroupLayout{}, uniformLayout() };
    const ProgramHandle program = makeProgram(kFullScreenVertex, kUniformFragment, layout);
    const PipelineHandle pipeline =
            makePipeline({ .program = program, .pass = colorLayout(), .raster = { .cull = CullMode::None } });
    const uint32_t stride = std::max(driver->info().limits.uniformOffsetAlignment, 16u);
    std::vector<float> values(stride / 4 * 4, 0.0f);
    for (uint32_t i = 0; i < 4; ++i) values[i * stride / 4] = static_cast<float>(i) / 255.0f * 10;
    const BufferHandle uniforms = makeBuffer(BufferUsage::Uniform, values);
    const BindGroupHandle group = makeGroup(layout[1], { { .binding = 0, .buffer = uniforms, .size = 16 } });
    const TextureHandle target = makeTarget(4, 1);
    beginPass(target, 4, 1);
    commands.record(CmdBindPipeline{ pipeline });
    for (uint32_t i = 0; i < 4; ++i) {
        commands.record(CmdSetScissor{ { static_cast<int32_t>(i), 0, 1, 1 } });
        commands.record(
                CmdBindGroup{ .group = group, .index = 1, .dynamicCount = 1, .dynamicOffsets = { i * stride } });
        commands.record(CmdDraw{ .vertexCount = 3 });
    }
    endPass();
    const std::vector<Rgba8> pixels = readPixels(target, 4, 1);
    for (uint8_t i = 0; i < 4; ++i) EXPECT_EQ(pixels[i][0], i * 10) << "draw " << int{ i };
}

TEST_F(DriverTest, GroupsBoundBeforeThePipelineStayBoundAcrossPipelinesOfTheSameLayout) {
    const ProgramLayout layout{ BindGroupLayout{}, uniformLayout(BindingType::UniformBuffer) };
    const ProgramHandle copy = makeProgram(kFullScreenVertex, kUniformFragment, layout);
    const ProgramHandle invert = makeProgram(kFullScreenVertex, R"(
        layout(set = 1, binding = 0) uniform Block { vec4 value; };
        layout(location = 0) out vec4 color;
        void main() { color = vec4(1.0) - value; })",
                                             layout);
    const RasterState raster{ .cull = CullMode::None };
    const PipelineHandle first = makePipeline({ .program = copy, .pass = colorLayout(), .raster = raster });
    const PipelineHandle second = makePipeline({ .program = invert, .pass = colorLayout(), .raster = raster });
    const BufferHandle uniforms = makeBuffer(BufferUsage::Uniform, std::vector<float>{ 1, 0, 0, 0 });
    const BindGroupHandle group = makeGroup(layout[1], { { .binding = 0, .buffer = uniforms, .size = 16 } });
    const TextureHandle target = makeTarget(2, 1);
    beginPass(target, 2, 1);
    commands.record(CmdBindGroup{ .group = group, .index = 1 });
    commands.record(CmdBindPipeline{ first });
    commands.record(CmdDraw{ .vertexCount = 3 });
    commands.record(CmdBindPipeline{ second });
    commands.record(CmdSetScissor{ { 1, 0, 1, 1 } });
    commands.record(CmdDraw{ .vertexCount = 3 });
    endPass();
    EXPECT_EQ(readPixels(target, 2, 1), (std::vector<Rgba8>{ { 255, 0, 0, 0 }, { 0, 255, 255, 255 } }));
}

TEST_F(DriverTest, NothingBoundInOnePassIsBoundInTheNext) {
    const ProgramHandle program = makeProgram(kFullScreenVertex, kRedFragment);
    const PipelineHandle pipeline =
            makePipeline({ .program = program, .pass = colorLayout(), .raster = { .cull = CullMode::None } });
    const TextureHandle first = makeTarget(1, 1), second = makeTarget(1, 1);
    beginPass(first, 1, 1);
    commands.record(CmdBindPipeline{ pipeline });
    commands.record(CmdDraw{ .vertexCount = 3 });
    endPass();
    beginPass(second, 1, 1);
    commands.record(CmdDraw{ .vertexCount = 3 });
    endPass();
    EXPECT_EQ(readPixels(first, 1, 1)[0], kRed);
    EXPECT_EQ(readPixels(second, 1, 1)[0], kNothing);
}

TEST_F(DriverTest, SpecializationConstantsOfAllTypesReachBothStages) {
    const std::array<ConstantValue, 3> constants{
        ConstantValue{ 0, 1, ConstantValue::Type::Bool }, ConstantValue{ 1, 51, ConstantValue::Type::Int },
        ConstantValue{ 2, std::bit_cast<uint32_t>(0.4f), ConstantValue::Type::Float }
    };
    const ProgramHandle program = makeProgram(R"(
        layout(constant_id = 1) const int kRed = 0;
        layout(location = 0) out float red;
        void main() {
            red = float(kRed) / 255.0;
            gl_Position = vec4(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0, 0.5, 1.0);
        })",
                                              R"(
        layout(constant_id = 0) const bool kBlue = false;
        layout(constant_id = 2) const float kGreen = 0.0;
        layout(location = 0) in float red;
        layout(location = 0) out vec4 color;
        void main() { color = vec4(red, kGreen, kBlue ? 1.0 : 0.0, 1.0); })",
                                              {}, constants);
    const PipelineHandle pipeline =
            makePipeline({ .program = program, .pass = colorLayout(), .raster = { .cull = CullMode::None } });
    const TextureHandle target = makeTarget(1, 1);
    beginPass(target, 1, 1);
    commands.record(CmdBindPipeline{ pipeline });
    commands.record(CmdDraw{ .vertexCount = 3 });
    endPass();
    EXPECT_EQ(readPixels(target, 1, 1)[0], (Rgba8{ 51, 102, 255, 255 }));
}

TEST_F(DriverTest, FirstInstanceOffsetsPerInstanceAttributesAndVertexOffsetTheIndices) {
    const ProgramHandle program = makeProgram(R"(
        layout(location = 0) in vec2 position;
        layout(location = 1) in vec4 tint;
        layout(location = 0) out vec4 value;
        void main() { value = tint; gl_Position = vec4(position, 0.5, 1.0); })",
                                              R"(
        layout(location = 0) in vec4 value;
        layout(location = 0) out vec4 color;
        void main() { color = value; })");
    PipelineDesc desc = positionPipeline(program, colorLayout());
    desc.vertices.attributes[1] = { .location = 1, .buffer = 1, .format = VertexFormat::UByte4N };
    desc.vertices.attributeCount = 2;
    desc.vertices.buffers[1] = { .stride = 4, .perInstance = true };
    desc.vertices.bufferCount = 2;
    const PipelineHandle pipeline = makePipeline(desc);
    // Two meaningless vertices come first; the vertex offset skips them.
    const BufferHandle corners =
            makeBuffer(BufferUsage::Vertex, std::vector<float>{ 0, 0, 0, 0, -1, -1, 3, -1, -1, 3 });
    const BufferHandle tints =
            makeBuffer(BufferUsage::Vertex, std::vector<uint8_t>{ 1, 1, 1, 1, 2, 2, 2, 2, 10, 20, 30, 40 });
    const BufferHandle indices = makeBuffer(BufferUsage::Index, std::vector<uint32_t>{ 99, 0, 1, 2 });
    const TextureHandle target = makeTarget(1, 1);
    beginPass(target, 1, 1);
    commands.record(CmdBindPipeline{ pipeline });
    commands.record(CmdBindVertexBuffers{ .buffers = { corners, tints }, .count = 2 });
    commands.record(CmdBindIndexBuffer{ .buffer = indices, .type = IndexFormat::UInt32 });
    commands.record(CmdDrawIndexed{ .indexCount = 3, .firstIndex = 1, .vertexOffset = 2, .firstInstance = 2 });
    endPass();
    EXPECT_EQ(readPixels(target, 1, 1)[0], (Rgba8{ 10, 20, 30, 40 }));
}

TEST_F(DriverTest, FlatVaryingsComeFromTheLastVertex) {
    if (!driver->device().physical().provokingVertexLast) GTEST_SKIP() << "no VK_EXT_provoking_vertex";
    const ProgramHandle program = makeProgram(R"(
        layout(location = 0) flat out uint corner;
        void main() {
            corner = uint(gl_VertexIndex);
            gl_Position = vec4(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0, 0.5, 1.0);
        })",
                                              R"(
        layout(location = 0) flat in uint corner;
        layout(location = 0) out uint color;
        void main() { color = corner + 40u; })");
    const PipelineHandle pipeline = makePipeline(
            { .program = program, .pass = colorLayout(Format::R8UI), .raster = { .cull = CullMode::None } });
    const TextureHandle target = makeTarget(1, 1, Format::R8UI);
    beginPass(target, 1, 1, { 7, 0, 0, 0 }, Format::R8UI);
    commands.record(CmdBindPipeline{ pipeline });
    commands.record(CmdDraw{ .vertexCount = 3 });
    endPass();
    EXPECT_EQ(read(target, 1, 1), (std::vector<std::byte>{ std::byte{ 42 } }));
}

TEST_F(DriverTest, AnAttachmentThatTheProgramDoesNotWriteKeepsItsValue) {
    const ProgramHandle program = makeProgram(kFullScreenVertex, kRedFragment); // location 0 only
    PassLayout layout = colorLayout();
    layout.colorFormats[1] = Format::RGBA8;
    layout.colorCount = 2;
    const PipelineHandle pipeline =
            makePipeline({ .program = program, .pass = layout, .raster = { .cull = CullMode::None } });
    const TextureHandle first = makeTarget(1, 1), second = makeTarget(1, 1);
    PassDesc pass{ .layout = layout, .area = { 0, 0, 1, 1 } };
    pass.colors[0].texture = first;
    pass.colors[1].texture = second;
    pass.colors[1].clear = { 0, 0, 1, 1 };
    commands.record(CmdBeginPass{ pass });
    commands.record(CmdBindPipeline{ pipeline });
    commands.record(CmdDraw{ .vertexCount = 3 });
    endPass();
    EXPECT_EQ(readPixels(first, 1, 1)[0], kRed);
    EXPECT_EQ(readPixels(second, 1, 1)[0], (Rgba8{ 0, 0, 255, 255 }));
}

TEST_F(DriverTest, ReversedDepthKeepsTheNearerSurfaceAndStencilCountsBoth) {
    const ProgramHandle program = makeProgram(R"(
        void main() {
            gl_Position = vec4(gl_VertexIndex == 1 ? 3.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0,
                    float(gl_InstanceIndex) * 0.25 + 0.25, 1.0);
        })",
                                              kRedFragment);
    PassLayout layout = colorLayout();
    layout.depthFormat = Format::D32FS8;
    PipelineDesc desc{ .program = program, .pass = layout, .raster = { .cull = CullMode::None } };
    desc.depthStencil = { .depthCompare = CompareOp::Greater, .depthWrite = true, .stencilTest = true };
    desc.depthStencil.front = { .depthFail = StencilOp::IncrementClamp, .pass = StencilOp::IncrementClamp };
    desc.depthStencil.back = desc.depthStencil.front;
    const PipelineHandle surface = makePipeline(desc);
    // Draws only where the stencil is the reference.
    desc.depthStencil = { .depthCompare = CompareOp::Always, .stencilTest = true };
    desc.depthStencil.front.compare = desc.depthStencil.back.compare = CompareOp::Equal;
    desc.blend[0].writeMask = 0b0100;
    const PipelineHandle whereTwo = makePipeline(desc);

    const TextureHandle color = makeTarget(1, 1), depth = makeTarget(1, 1, Format::D32FS8);
    PassDesc pass{ .layout = layout, .area = { 0, 0, 1, 1 } };
    pass.colors[0] = { .texture = color, .clear = { 0, 0, 1, 1 } };
    pass.depth = { .texture = depth, .clear = { 0, 0, 0, 0 } };
    commands.record(CmdBeginPass{ pass });
    commands.record(CmdBindPipeline{ surface });
    commands.record(CmdDraw{ .vertexCount = 3, .firstInstance = 2 }); // 0.75
    commands.record(CmdDraw{ .vertexCount = 3, .firstInstance = 0 }); // 0.25 is behind
    commands.record(CmdBindPipeline{ whereTwo });
    commands.record(CmdSetStencilReference{ 2, 2 });
    commands.record(CmdDraw{ .vertexCount = 3 }); // clears blue: the stencil is 2
    endPass();
    EXPECT_EQ(readFloats(depth, 1, 1), std::vector<float>{ 0.75f });
    EXPECT_EQ(readPixels(color, 1, 1)[0], kRed);
}

TEST_F(DriverTest, PremultipliedBlendingAddsWhatTheTargetStillShows) {
    const ProgramHandle program = makeProgram(kFullScreenVertex, R"(
        layout(location = 0) out vec4 color;
        void main() { color = vec4(0.25, 0.0, 0.0, 0.5); })");
    PipelineDesc desc{ .program = program, .pass = colorLayout(Format::RGBA32F), .raster = { .cull = CullMode::None } };
    desc.blend[0] = { .enabled = true,
                      .dstColor = BlendFactor::OneMinusSrcAlpha,
                      .dstAlpha = BlendFactor::OneMinusSrcAlpha };
    const PipelineHandle pipeline = makePipeline(desc);
    const TextureHandle target = makeTarget(1, 1, Format::RGBA32F);
    beginPass(target, 1, 1, { 1, 1, 0, 1 }, Format::RGBA32F);
    commands.record(CmdBindPipeline{ pipeline });
    commands.record(CmdDraw{ .vertexCount = 3 });
    endPass();
    EXPECT_EQ(readFloats(target, 1, 1), (std::vector<float>{ 0.75f, 0.5f, 0, 1 }));
}

TEST_F(DriverTest, AScissorThatBeginsLeftOfThePictureIsCutOff) {
    const ProgramHandle program = makeProgram(kFullScreenVertex, kRedFragment);
    const PipelineHandle pipeline =
            makePipeline({ .program = program, .pass = colorLayout(), .raster = { .cull = CullMode::None } });
    const TextureHandle target = makeTarget(3, 1);
    beginPass(target, 3, 1);
    commands.record(CmdBindPipeline{ pipeline });
    commands.record(CmdSetScissor{ { -4, -4, 5, 9 } });
    commands.record(CmdDraw{ .vertexCount = 3 });
    endPass();
    EXPECT_EQ(readPixels(target, 3, 1), (std::vector<Rgba8>{ kRed, kNothing, kNothing }));
}

} // namespace
} // namespace filament_core::backend::vulkan
