// SPDX-License-Identifier: Apache-2.0
// Passes with more than one attachment, sample or subpass.
#include "tests/backend/gles/GlesFixture.h"

namespace filament_core::backend::gles {
namespace {

using Rgba = std::array<uint8_t, 4>;

constexpr std::string_view kHalfFragment = R"(#version 310 es
precision highp float;
layout(location = 0) out vec4 color;
void main() { color = vec4(0.5, 0.25, 0.125, 1.0); }
)";

TEST_F(GlesTest, AMergedPassReadsWhatTheSubpassBeforeWrote) {
    const TextureHandle light = target(Format::RGBA16F, 2, 2), display = target(Format::RGBA32F, 2, 2);
    PassDesc pass = colorPass(light, Format::RGBA16F, 2, 2);
    pass.layout.colorCount = 2;
    pass.layout.colorFormats[1] = Format::RGBA32F;
    pass.colors[1].texture = display;
    pass.layout.subpassCount = 2;
    pass.layout.subpasses[0] = { .colorMask = 1 };
    pass.layout.subpasses[1] = { .colorMask = 2, .inputMask = 1 };
    constexpr std::string_view kDouble = R"(#version 310 es
        #extension GL_EXT_shader_framebuffer_fetch : require
        precision highp float;
        layout(location = 0) inout vec4 light;
        layout(location = 1) out vec4 display;
        void main() { display = light * 2.0; light = vec4(9.0); })";
    PipelineDesc desc;
    desc.pass = pass.layout;
    desc.raster.cull = CullMode::None;
    desc.program = program(kFullScreenVertex, kHalfFragment);
    const PipelineHandle first = pipeline(desc);
    desc.program = program(kFullScreenVertex, kDouble);
    desc.subpass = 1;
    const PipelineHandle second = pipeline(desc);
    commands.record(CmdBeginPass{ pass });
    commands.record(CmdBindPipeline{ first });
    commands.record(CmdDraw{ .vertexCount = 3 });
    commands.record(CmdNextSubpass{});
    commands.record(CmdBindPipeline{ second });
    commands.record(CmdDraw{ .vertexCount = 3 });
    commands.record(CmdEndPass{});
    using Texel = std::array<float, 4>;
    EXPECT_EQ(read<Texel>(display, { 0, 0, 2, 2 }), std::vector<Texel>(4, Texel{ 1, 0.5f, 0.25f, 2 }));
    // The mask of the second subpass protected the first attachment: half 0x3800 is 0.5.
    EXPECT_EQ(read<uint16_t>(light, { 0, 0, 1, 1 }), (std::vector<uint16_t>{ 0x3800, 0x3400, 0x3000, 0x3C00 }));
}

TEST_F(GlesTest, AResolvedPixelIsTheMeanOfItsSamples) {
    DeviceTextureDesc desc;
    desc.format = Format::RGBA8;
    desc.usage = TextureUsage::ColorAttachment | TextureUsage::Transient;
    desc.samples = 4;
    desc.width = desc.height = 8;
    const TextureHandle samples = texture(desc), resolved = target(Format::RGBA8, 8, 8);
    PassDesc pass = colorPass(samples, Format::RGBA8, 8, 8);
    pass.layout.samples = 4;
    pass.layout.resolveMask = 1;
    pass.colors[0].resolve = resolved;
    pass.colors[0].store = StoreOp::Discard;
    // Covers everything below the diagonal: pixels are 255 or 0, except on the diagonal, which has some of four
    // samples.
    constexpr std::string_view kVertex = R"(#version 310 es
        void main() {
            vec2 corner = vec2(gl_VertexID == 1 ? 1.0 : -1.0, gl_VertexID == 2 ? 1.0 : -1.0);
            gl_Position = vec4(corner, 0.5, 1.0);
        })";
    constexpr std::string_view kWhite = R"(#version 310 es
        layout(location = 0) out highp vec4 color;
        void main() { color = vec4(1.0); })";
    PipelineDesc drawing;
    drawing.program = program(kVertex, kWhite);
    drawing.pass = pass.layout;
    drawing.raster.cull = CullMode::None;
    drawFullScreen(pass, pipeline(drawing));
    const std::vector<Rgba> pixels = read<Rgba>(resolved, { 0, 0, 8, 8 });
    for (uint32_t y = 0; y < 8; ++y) {
        for (uint32_t x = 0; x < 8; ++x) {
            const uint8_t value = pixels[y * 8 + x][0];
            if (x + y == 7) {
                EXPECT_TRUE(value == 64 || value == 128 || value == 191) << int{ value };
            } else {
                EXPECT_EQ(value, x + y < 7 ? 255 : 0) << x << ',' << y;
            }
        }
    }
}

TEST_F(GlesTest, AttachmentsOfOnePassBlendAndMaskEachOnItsOwn) {
    const TextureHandle added = target(Format::RGBA32F, 1, 1), masked = target(Format::RGBA32F, 1, 1);
    PassDesc pass = colorPass(added, Format::RGBA32F, 1, 1, { 1, 1, 1, 1 });
    pass.layout.colorCount = 2;
    pass.layout.colorFormats[1] = Format::RGBA32F;
    pass.colors[1].texture = masked;
    pass.colors[1].clear = { 8, 8, 8, 8 };
    constexpr std::string_view kTwo = R"(#version 310 es
        precision highp float;
        layout(location = 0) out vec4 a;
        layout(location = 1) out vec4 b;
        void main() { a = vec4(2.0); b = vec4(3.0); })";
    PipelineDesc desc;
    desc.program = program(kFullScreenVertex, kTwo);
    desc.pass = pass.layout;
    desc.raster.cull = CullMode::None;
    desc.blend[0] = { .enabled = true, .dstColor = BlendFactor::One, .dstAlpha = BlendFactor::One };
    desc.blend[1].writeMask = 0b0101;
    drawFullScreen(pass, pipeline(desc));
    drawFullScreen(pass, pipeline(desc)); // the clear must not inherit the mask
    EXPECT_EQ(read<float>(added, { 0, 0, 1, 1 }), (std::vector<float>{ 3, 3, 3, 3 }));
    EXPECT_EQ(read<float>(masked, { 0, 0, 1, 1 }), (std::vector<float>{ 3, 8, 3, 8 }));
}

TEST_F(GlesTest, LayersAndLevelsAreSeparateAttachments) {
    DeviceTextureDesc desc;
    desc.type = TextureKind::Cube;
    desc.usage = TextureUsage::ColorAttachment | TextureUsage::TransferSource;
    desc.layers = 6;
    desc.levels = 2;
    desc.width = desc.height = 2;
    const TextureHandle cube = texture(desc);
    const auto value = [](uint16_t layer, uint8_t level) { return static_cast<float>(layer * 2 + level) / 255.0f; };
    for (uint16_t layer = 0; layer < 6; ++layer) {
        for (uint8_t level = 0; level < 2; ++level) {
            PassDesc pass = colorPass(cube, Format::RGBA8, 2u >> level, 2u >> level, { value(layer, level), 0, 0, 0 });
            pass.colors[0].level = level;
            pass.colors[0].layer = layer;
            commands.record(CmdBeginPass{ pass });
            commands.record(CmdEndPass{});
        }
    }
    for (uint16_t layer = 0; layer < 6; ++layer) {
        EXPECT_EQ(read<Rgba>(cube, { 0, 0, 2, 2 }, 0, layer).at(3)[0], layer * 2);
        EXPECT_EQ(read<Rgba>(cube, { 0, 0, 1, 1 }, 1, layer).at(0)[0], layer * 2 + 1);
    }
}

TEST_F(GlesTest, ASetOfAttachmentsThatTheDriverRefusesIsSkippedAndNamed) {
    DeviceTextureDesc desc;
    desc.usage = TextureUsage::ColorAttachment;
    desc.samples = 4;
    PassDesc pass = colorPass(texture(desc), Format::RGBA8, 1, 1);
    pass.layout.colorCount = 2;
    pass.layout.colorFormats[1] = Format::RGBA8;
    pass.colors[1].texture = target(Format::RGBA8, 1, 1); // another sample count
    commands.record(CmdBeginPass{ pass });
    commands.record(CmdEndPass{});
    run();
    expectError(DriverErrorKind::Other, "test pass");
}

} // namespace
} // namespace filament_core::backend::gles
