// SPDX-License-Identifier: Apache-2.0
#include "tests/backend/gles/GlesFixture.h"

namespace filament_core::backend::gles {
namespace {

using Rgba = std::array<uint8_t, 4>;
constexpr Rgba kRed{ 255, 0, 0, 255 }, kBlack{ 0, 0, 0, 0 };

constexpr std::string_view kRedFragment = R"(#version 310 es
precision highp float;
layout(location = 0) out vec4 color;
void main() { color = vec4(1.0, 0.0, 0.0, 1.0); }
)";

constexpr std::string_view kPositionVertex = R"(#version 310 es
layout(location = 0) in vec2 position;
void main() { gl_Position = vec4(position, 0.5, 1.0); }
)";

VertexLayout positions2() {
    VertexLayout layout;
    layout.attributes[0] = { 0, 0, VertexFormat::Float2, 0 };
    layout.attributeCount = 1;
    layout.buffers[0].stride = 8;
    layout.bufferCount = 1;
    return layout;
}

TEST_F(GlesTest, AClearFillsTheTargetWithItsColour) {
    const TextureHandle image = target(Format::RGBA8, 4, 3);
    commands.record(CmdBeginPass{ colorPass(image, Format::RGBA8, 4, 3, { 1, 0, 0, 1 }) });
    commands.record(CmdEndPass{});
    EXPECT_EQ(read<Rgba>(image, { 0, 0, 4, 3 }), std::vector<Rgba>(12, kRed));
}

TEST_F(GlesTest, AClearOfAnAreaKeepsTheTexelsOutsideIt) {
    const TextureHandle image = target(Format::RGBA8, 4, 4);
    commands.record(CmdBeginPass{ colorPass(image, Format::RGBA8, 4, 4) });
    commands.record(CmdEndPass{});
    PassDesc corner = colorPass(image, Format::RGBA8, 4, 4, { 1, 0, 0, 1 });
    corner.area = { 1, 0, 2, 1 };
    commands.record(CmdBeginPass{ corner });
    commands.record(CmdEndPass{});
    std::vector<Rgba> expected(16, kBlack);
    expected[1] = expected[2] = kRed;
    EXPECT_EQ(read<Rgba>(image, { 0, 0, 4, 4 }), expected);
}

TEST_F(GlesTest, RowZeroIsWhereClipYIsMinusOne) {
    const TextureHandle image = target(Format::RGBA8, 2, 2);
    const PassDesc pass = colorPass(image, Format::RGBA8, 2, 2);
    PipelineDesc desc;
    desc.program = program(kPositionVertex, kRedFragment);
    desc.pass = pass.layout;
    desc.vertices = positions2();
    desc.raster = { .topology = PrimitiveType::TriangleStrip, .cull = CullMode::None };
    const PipelineHandle strip = pipeline(desc);
    const BufferHandle corners = buffer<float>({ -1, -1, 1, -1, -1, 0, 1, 0 }, BufferUsage::Vertex);
    commands.record(CmdBeginPass{ pass });
    commands.record(CmdBindPipeline{ strip });
    commands.record(CmdBindVertexBuffers{ .buffers = { corners }, .count = 1 });
    commands.record(CmdDraw{ .vertexCount = 4 });
    commands.record(CmdEndPass{});
    EXPECT_EQ(read<Rgba>(image, { 0, 0, 2, 2 }), (std::vector<Rgba>{ kRed, kRed, kBlack, kBlack }));
}

TEST_F(GlesTest, ATriangleThatTurnsCounterClockwiseInThePictureFacesTheViewer) {
    const TextureHandle image = target(Format::RGBA8, 1, 1);
    const PassDesc pass = colorPass(image, Format::RGBA8, 1, 1);
    PipelineDesc desc;
    desc.program = program(kPositionVertex, kRedFragment);
    desc.pass = pass.layout;
    desc.vertices = positions2();
    desc.raster = { .cull = CullMode::Back, .frontFace = FrontFace::CounterClockwise };
    const PipelineHandle culling = pipeline(desc);
    // With row 0 (y = -1) on top: top left, bottom left, far right. Down, then right, then back up: counter-clockwise.
    const BufferHandle triangles =
            buffer<float>({ -1, -1, -1, 3, 3, -1, /* the other way: */ -1, -1, 3, -1, -1, 3 }, BufferUsage::Vertex);
    for (uint32_t first : { 0u, 3u }) {
        commands.record(CmdBeginPass{ pass });
        commands.record(CmdBindPipeline{ culling });
        commands.record(CmdBindVertexBuffers{ .buffers = { triangles }, .count = 1 });
        commands.record(CmdDraw{ .vertexCount = 3, .firstVertex = first });
        commands.record(CmdEndPass{});
        EXPECT_EQ(read<Rgba>(image, { 0, 0, 1, 1 }).at(0), first == 0 ? kRed : kBlack);
    }
}

TEST_F(GlesTest, DepthIsInZeroToOneAndGreaterWins) {
    const TextureHandle image = target(Format::RGBA8, 1, 1), depth = target(Format::D32F, 1, 1);
    PassDesc pass = colorPass(image, Format::RGBA8, 1, 1);
    pass.layout.depthFormat = Format::D32F;
    pass.depth.texture = depth;
    constexpr std::string_view kVertex = R"(#version 310 es
        void main() {
            float z = gl_InstanceID == 0 ? 0.75 : 0.25; // the second one lies behind, reversed depth
            gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, z, 1.0);
        })";
    PipelineDesc desc;
    desc.program = program(kVertex, kRedFragment);
    desc.pass = pass.layout;
    desc.raster.cull = CullMode::None;
    desc.depthStencil = { .depthCompare = CompareOp::Greater, .depthWrite = true };
    const PipelineHandle tested = pipeline(desc);
    commands.record(CmdBeginPass{ pass });
    commands.record(CmdBindPipeline{ tested });
    commands.record(CmdDraw{ .vertexCount = 3, .instanceCount = 2 });
    commands.record(CmdEndPass{});
    EXPECT_EQ(read<float>(depth, { 0, 0, 1, 1 }), std::vector<float>{ 0.75f });
}

TEST_F(GlesTest, AProgramThatDoesNotCompileIsNamedAndItsDrawsAreSkipped) {
    const TextureHandle image = target(Format::RGBA8, 1, 1);
    const PassDesc pass = colorPass(image, Format::RGBA8, 1, 1);
    const PipelineHandle broken =
            simplePipeline(program(kFullScreenVertex, "#version 310 es\nvoid main() { nonsense; }\n"), pass.layout);
    drawFullScreen(pass, broken);
    EXPECT_EQ(read<Rgba>(image, { 0, 0, 1, 1 }).at(0), kBlack);
    expectError(DriverErrorKind::ShaderCompile, "test program");
    EXPECT_EQ(driver->statistics().draws, 0u);
}

TEST_F(GlesTest, ATextureThatDoesNotFitIsReportedAndItsPassesAreSkipped) {
    DeviceTextureDesc desc;
    desc.type = TextureKind::Texture2DArray;
    desc.format = Format::RGBA32F;
    desc.usage = TextureUsage::ColorAttachment;
    desc.width = desc.height = 16384;
    desc.layers = 2048; // 8 TiB
    desc.debugName = "far too large";
    const TextureHandle image = texture(desc);
    commands.record(CmdBeginPass{ colorPass(image, desc.format, 16384, 16384) });
    commands.record(CmdEndPass{});
    run();
    expectError(DriverErrorKind::OutOfMemory, "far too large");
    EXPECT_EQ(driver->statistics().deviceBytes, 0u);
}

} // namespace
} // namespace filament_core::backend::gles
