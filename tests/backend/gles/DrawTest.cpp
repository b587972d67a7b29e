// SPDX-License-Identifier: Apache-2.0
// The inputs of a draw: uniforms, textures, constants, vertex attributes.
#include "tests/backend/gles/GlesFixture.h"

#include <bit>
#include <limits>

namespace filament_core::backend::gles {
namespace {

using Float4 = std::array<float, 4>;

BindGroupLayout uniformLayout(BindingType type, uint8_t count = 1) {
    BindGroupLayout layout;
    for (uint8_t i = 0; i < count; ++i) layout.bindings[i] = { .binding = i, .type = type };
    layout.count = count;
    return layout;
}

BindGroupEntry uniformEntry(uint8_t binding, BufferHandle buffer, uint64_t offset = 0) {
    BindGroupEntry entry;
    entry.binding = binding;
    entry.buffer = buffer;
    entry.offset = offset;
    entry.size = sizeof(Float4);
    return entry;
}

class DrawTest : public GlesTest {
protected:
    void SetUp() override {
        GlesTest::SetUp();
        image = target(Format::RGBA32F, 1, 1);
        pass = colorPass(image, Format::RGBA32F, 1, 1);
    }
    Float4 pixel() { return read<Float4>(image, { 0, 0, 1, 1 }).at(0); }

    TextureHandle image;
    PassDesc pass;
};

constexpr std::string_view kUniformFragment = R"(#version 310 es
precision highp float;
layout(std140, binding = 0) uniform Block { vec4 value; };
layout(location = 0) out vec4 color;
void main() { color = value; }
)";

TEST_F(DrawTest, ADynamicOffsetMovesTheUniformBlock) {
    const uint32_t step = driver->info().limits.uniformOffsetAlignment;
    std::vector<float> values(step / 4 * 2);
    values[0] = 1;
    values[step / 4] = 2;
    const BufferHandle block = buffer(values, BufferUsage::Uniform);
    ProgramLayout layout;
    layout[0] = uniformLayout(BindingType::DynamicUniformBuffer);
    const PipelineHandle drawing = simplePipeline(program(kFullScreenVertex, kUniformFragment, layout), pass.layout);
    const BindGroupHandle group = bindGroup(layout[0], { uniformEntry(0, block) });
    for (uint32_t i = 0; i < 2; ++i) {
        commands.record(CmdBeginPass{ pass });
        commands.record(CmdBindPipeline{ drawing });
        commands.record(CmdBindGroup{ .group = group, .dynamicCount = 1, .dynamicOffsets = { i * step } });
        commands.record(CmdDraw{ .vertexCount = 3 });
        commands.record(CmdEndPass{});
        EXPECT_EQ(pixel()[0], static_cast<float>(i + 1));
    }
}

TEST_F(DrawTest, AGroupFollowsTheNumbersOfTheProgramItIsUsedWith) {
    // Group 1 has block number 0 in one program and number 2 in the other; both run in one pass, and it is bound once.
    constexpr std::string_view kThird = R"(#version 310 es
        precision highp float;
        layout(std140, binding = 0) uniform A { vec4 a; };
        layout(std140, binding = 1) uniform B { vec4 b; };
        layout(std140, binding = 2) uniform C { vec4 c; };
        layout(location = 0) out vec4 color;
        void main() { color = a + b + c; })";
    const BufferHandle one = buffer<float>({ 1, 0, 0, 0 }, BufferUsage::Uniform);
    const BufferHandle ten = buffer<float>({ 10, 0, 0, 0 }, BufferUsage::Uniform);
    const BufferHandle hundred = buffer<float>({ 100, 0, 0, 0 }, BufferUsage::Uniform);
    ProgramLayout narrow, wide;
    narrow[1] = wide[1] = uniformLayout(BindingType::UniformBuffer);
    wide[0] = uniformLayout(BindingType::UniformBuffer, 2);
    PipelineDesc desc;
    desc.pass = pass.layout;
    desc.raster.cull = CullMode::None;
    desc.blend[0] = { .enabled = true, .dstColor = BlendFactor::One }; // sums up
    desc.program = program(kFullScreenVertex, kUniformFragment, narrow);
    const PipelineHandle first = pipeline(desc);
    desc.program = program(kFullScreenVertex, kThird, wide);
    const PipelineHandle second = pipeline(desc);
    const BindGroupHandle pair = bindGroup(wide[0], { uniformEntry(0, ten), uniformEntry(1, hundred) });
    const BindGroupHandle single = bindGroup(wide[1], { uniformEntry(0, one) });
    commands.record(CmdBeginPass{ pass });
    commands.record(CmdBindGroup{ .group = single, .index = 1 });
    commands.record(CmdBindGroup{ .group = pair, .index = 0 });
    for (PipelineHandle with : { first, second, first }) {
        commands.record(CmdBindPipeline{ with });
        commands.record(CmdDraw{ .vertexCount = 3 });
    }
    commands.record(CmdEndPass{});
    EXPECT_EQ(pixel()[0], 1 + 111 + 1);
}

TEST_F(DrawTest, ADrawWithoutABindGroupThatItNeedsIsSkipped) {
    ProgramLayout layout;
    layout[0] = uniformLayout(BindingType::UniformBuffer);
    drawFullScreen(pass, simplePipeline(program(kFullScreenVertex, kUniformFragment, layout), pass.layout));
    run();
    EXPECT_EQ(driver->statistics().draws, 0u);
}

TEST_F(DrawTest, ConstantsReplaceTheDefaultsBitForBit) {
    constexpr std::string_view kFragment = R"(#version 310 es
        #ifndef SPIRV_CROSS_CONSTANT_ID_3
        #define SPIRV_CROSS_CONSTANT_ID_3 0.5
        #endif
        #ifndef SPIRV_CROSS_CONSTANT_ID_4
        #define SPIRV_CROSS_CONSTANT_ID_4 7
        #endif
        #ifndef SPIRV_CROSS_CONSTANT_ID_5
        #define SPIRV_CROSS_CONSTANT_ID_5 false
        #endif
        precision highp float;
        precision highp int;
        const float third = SPIRV_CROSS_CONSTANT_ID_3;
        const int lowest = SPIRV_CROSS_CONSTANT_ID_4;
        const bool flag = SPIRV_CROSS_CONSTANT_ID_5;
        layout(location = 0) out vec4 color;
        void main() { color = vec4(third, lowest == (-2147483647 - 1) ? 1.0 : 0.0, flag ? 1.0 : 0.0, 1.0); })";
    const float third = 1.0f / 3.0f;
    const ConstantValue constants[] = { { 3, std::bit_cast<uint32_t>(third), ConstantValue::Type::Float },
                                        { 4, 0x80000000u, ConstantValue::Type::Int },
                                        { 5, 1, ConstantValue::Type::Bool } };
    drawFullScreen(pass, simplePipeline(program(kFullScreenVertex, kFragment, {}, constants), pass.layout));
    EXPECT_EQ(pixel(), (Float4{ third, 1, 1, 1 }));
}

TEST_F(DrawTest, ACompileErrorNamesTheLineOfTheTextThatCameIn) {
    const ConstantValue constants[] = { { 0, 1, ConstantValue::Type::Int }, { 1, 1, ConstantValue::Type::Int } };
    program(kFullScreenVertex, "#version 310 es\n\n\nvoid main() { nonsense; }\n", {}, constants);
    run();
    expectError(DriverErrorKind::ShaderCompile, ":4(");
}

TEST_F(DrawTest, AttributesWithoutAnArrayReadAsZeroZeroZeroOneInEveryType) {
    constexpr std::string_view kVertex = R"(#version 310 es
        layout(location = 3) in vec4 lacking;
        layout(location = 4) in uvec4 lackingUnsigned;
        layout(location = 5) in ivec4 lackingSigned;
        layout(location = 0) flat out highp vec4 sum;
        void main() {
            sum = lacking + 10.0 * vec4(lackingUnsigned) + 100.0 * vec4(lackingSigned);
            gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.5, 1.0);
        })";
    constexpr std::string_view kFragment = R"(#version 310 es
        precision highp float;
        layout(location = 0) flat in highp vec4 sum;
        layout(location = 0) out vec4 color;
        void main() { color = sum; })";
    drawFullScreen(pass, simplePipeline(program(kVertex, kFragment), pass.layout));
    EXPECT_EQ(pixel(), (Float4{ 0, 0, 0, 111 }));
}

// Instance i of 4 draws pixel i; its value comes from a per-instance attribute.
class InstanceTest : public GlesTest {
protected:
    std::vector<float> drawRow(uint32_t firstInstance, bool indexed, int32_t vertexOffset) {
        constexpr std::string_view kVertex = R"(#version 310 es
            layout(location = 0) in vec2 corner;
            layout(location = 1) in vec2 positionAndValue;
            layout(location = 0) flat out highp float value;
            void main() {
                value = positionAndValue.y;
                gl_Position = vec4(positionAndValue.x + corner * vec2(0.5, 2.0) - vec2(0.0, 1.0), 0.5, 1.0);
                gl_Position.y = corner.y * 2.0 - 1.0;
            })";
        constexpr std::string_view kFragment = R"(#version 310 es
            precision highp float;
            layout(location = 0) flat in highp float value;
            layout(location = 0) out float color;
            void main() { color = value; })";
        const TextureHandle row = target(Format::R32F, 4, 1);
        const PassDesc pass = colorPass(row, Format::R32F, 4, 1);
        PipelineDesc desc;
        desc.program = program(kVertex, kFragment);
        desc.pass = pass.layout;
        desc.raster = { .topology = PrimitiveType::TriangleStrip, .cull = CullMode::None };
        desc.vertices.attributes[0] = { 0, 0, VertexFormat::Float2, 0 };
        desc.vertices.attributes[1] = { 1, 1, VertexFormat::Float2, 0 };
        desc.vertices.attributeCount = 2;
        desc.vertices.buffers = { { { 8, false }, { 8, true } } };
        desc.vertices.bufferCount = 2;
        const PipelineHandle drawing = pipeline(desc);
        // Two unused vertices in front for vertexOffset.
        const BufferHandle corners = buffer<float>({ 9, 9, 9, 9, 0, 0, 1, 0, 0, 1, 1, 1 }, BufferUsage::Vertex);
        const BufferHandle instances = buffer<float>({ -1, 1, -0.5f, 2, 0, 3, 0.5f, 4 }, BufferUsage::Vertex);
        const BufferHandle indices = buffer<uint16_t>({ 77, 77, 0, 1, 2, 3 }, BufferUsage::Index);
        commands.record(CmdBeginPass{ pass });
        commands.record(CmdBindPipeline{ drawing });
        commands.record(CmdBindVertexBuffers{ .buffers = { corners, instances }, .count = 2 });
        commands.record(CmdBindIndexBuffer{ indices, 2 });
        if (indexed) {
            commands.record(CmdDrawIndexed{ .indexCount = 4,
                                            .instanceCount = 2,
                                            .firstIndex = 1,
                                            .vertexOffset = vertexOffset,
                                            .firstInstance = firstInstance });
        } else {
            commands.record(
                    CmdDraw{ .vertexCount = 4, .instanceCount = 2, .firstVertex = 2, .firstInstance = firstInstance });
        }
        commands.record(CmdEndPass{});
        return read<float>(row, { 0, 0, 4, 1 });
    }
};

TEST_F(InstanceTest, TheFirstInstanceOffsetsPerInstanceAttributesWithAndWithoutTheExtension) {
    for (QuirkFilter filter :
         { QuirkFilter{}, QuirkFilter{ [](Quirks& quirks) { quirks.baseInstance = false; } },
           QuirkFilter{ [](Quirks& quirks) { quirks.baseInstance = quirks.baseVertex = false; } } }) {
        start(filter);
        EXPECT_EQ(drawRow(0, false, 0), (std::vector<float>{ 1, 2, 0, 0 }));
        EXPECT_EQ(drawRow(2, false, 0), (std::vector<float>{ 0, 0, 3, 4 }));
        EXPECT_EQ(drawRow(0, true, 2), (std::vector<float>{ 1, 2, 0, 0 }));
        EXPECT_EQ(drawRow(1, true, 2), (std::vector<float>{ 0, 2, 3, 0 }));
    }
}

TEST_F(InstanceTest, AVertexBufferMadeUnderAReusedNameIsNotMistakenForTheOldOne) {
    const auto drawn = [this] { return drawRow(0, false, 0); };
    EXPECT_EQ(drawn(), (std::vector<float>{ 1, 2, 0, 0 }));
    commands.record(CmdDestroyBuffer{ BufferHandle::make(0, 1) }); // the corners of the first row
    commands.record(CmdDestroyBuffer{ BufferHandle::make(1, 1) });
    commands.record(CmdDestroyBuffer{ BufferHandle::make(2, 1) });
    EXPECT_EQ(drawn(), (std::vector<float>{ 1, 2, 0, 0 })) << "GL gives the three names out again";
}

TEST_F(DrawTest, StencilReferencesDecidePerFace) {
    PassDesc stencil = pass;
    stencil.layout.depthFormat = Format::D32FS8;
    stencil.depth.texture = target(Format::D32FS8, 1, 1);
    stencil.depth.clear = { 0, 5 };
    constexpr std::string_view kWhite = R"(#version 310 es
        layout(location = 0) out highp vec4 color;
        void main() { color = vec4(1.0); })";
    PipelineDesc desc;
    desc.program = program(kFullScreenVertex, kWhite);
    desc.pass = stencil.layout;
    desc.raster.cull = CullMode::None;
    desc.depthStencil.stencilTest = true;
    desc.depthStencil.front.compare = desc.depthStencil.back.compare = CompareOp::Equal;
    const PipelineHandle equal = pipeline(desc);
    for (uint8_t reference : { uint8_t{ 4 }, uint8_t{ 5 } }) {
        commands.record(CmdBeginPass{ stencil });
        commands.record(CmdSetStencilReference{ reference, reference });
        commands.record(CmdBindPipeline{ equal });
        commands.record(CmdDraw{ .vertexCount = 3 });
        commands.record(CmdEndPass{});
        EXPECT_EQ(pixel()[0], reference == 5 ? 1.0f : 0.0f);
    }
}

TEST_F(DrawTest, APipelineOutlivesItsProgramHandle) {
    constexpr std::string_view kWhite = R"(#version 310 es
        layout(location = 0) out highp vec4 color;
        void main() { color = vec4(1.0); })";
    const ProgramHandle shader = program(kFullScreenVertex, kWhite);
    const PipelineHandle drawing = simplePipeline(shader, pass.layout);
    commands.record(CmdDestroyProgram{ shader });
    drawFullScreen(pass, drawing);
    EXPECT_EQ(pixel()[0], 1.0f);
}

TEST(ConstantDefinitionsTest, TheyAreDefinesFollowedByTheNumberOfTheNextLine) {
    const ConstantValue constants[] = { { 0, 1, ConstantValue::Type::Bool },
                                        { 7, 0xFFFFFFFFu, ConstantValue::Type::Int } };
    EXPECT_EQ(constantDefinitions(constants),
              "#define SPIRV_CROSS_CONSTANT_ID_0 (1 == 1)\n#define SPIRV_CROSS_CONSTANT_ID_7 (-1)\n#line 2\n");
    EXPECT_EQ(constantDefinitions({}), "");
}

} // namespace
} // namespace filament_core::backend::gles
