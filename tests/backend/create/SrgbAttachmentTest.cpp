// SPDX-License-Identifier: Apache-2.0
// Textures of sRGB formats that passes draw to: their bytes are those of RGBA8, samplers decode them, nothing encodes.
#include "tests/backend/create/Gpu.h"
#include "tests/backend/create/Texel.h"

namespace filament_core::backend {
namespace {

DRIVER_SUITE(SrgbAttachment);

constexpr uint32_t kCodes = 256;
constexpr Rect kRow{ 0, 0, kCodes, 1 };
constexpr Format kBothFormats[] = { Format::RGBA8, Format::RGBA8Srgb };

// Column i: three functions of the code i that together show every code in every colour.
constexpr std::string_view kEveryCode = "float i = floor(gl_FragCoord.x);\n"
                                        "result = vec4(i, 255.0 - i, mod(i * 7.0 + 13.0, 256.0), i) / 255.0;";

Rgba8 codesOf(uint32_t i) {
    return { static_cast<uint8_t>(i), static_cast<uint8_t>(255 - i), static_cast<uint8_t>(i * 7 + 13),
             static_cast<uint8_t>(i) };
}

std::vector<Rgba8> everyCode() {
    std::vector<Rgba8> codes;
    for (uint32_t i = 0; i < kCodes; ++i) codes.push_back(codesOf(i));
    return codes;
}

TextureHandle drawEveryCode(Gpu& gpu, Format format) {
    return gpu.paint(gpu.program(kFullScreenVertex, fragmentOf("", kEveryCode)),
                     { .width = kCodes, .height = 1, .format = format });
}

void expectDecoded(std::vector<Rgba> const& seen) {
    for (uint32_t i = 0; i < kCodes; ++i) {
        const Rgba8 codes = codesOf(i);
        const Rgba expected = decodeTexel(Format::RGBA8Srgb, reinterpret_cast<const std::byte*>(codes.data()));
        for (size_t c = 0; c < 4; ++c) ASSERT_NEAR(seen[i][c], expected[c], 2e-3) << "code " << i << ", " << c;
    }
}

DRIVER_TEST(SrgbAttachment, StoresEveryCodeAsItIsWritten) {
    EXPECT_EQ(gpu.readAs<Rgba8>(drawEveryCode(gpu, Format::RGBA8Srgb), kRow), everyCode());
}

DRIVER_TEST(SrgbAttachment, IsDecodedOnceByASampler) {
    const TextureHandle drawn = drawEveryCode(gpu, Format::RGBA8Srgb);
    const Program show =
            gpu.program(kFullScreenVertex, fragmentOf("layout(set = 1, binding = 0) uniform sampler2D image;",
                                                      "result = texelFetch(image, ivec2(gl_FragCoord.xy), 0);"));
    const auto shown = [&](Format format) {
        return gpu.paint(show, { .width = kCodes,
                                 .height = 1,
                                 .format = format,
                                 .group = gpu.imageGroup(show, drawn, gpu.sampler()) });
    };
    expectDecoded(gpu.readAs<Rgba>(shown(Format::RGBA32F), kRow));
    // Drawn to another one, the light is stored as it is.
    const std::vector<Rgba8> light = gpu.readAs<Rgba8>(shown(Format::RGBA8Srgb), kRow);
    for (uint32_t i = 0; i < kCodes; ++i) ASSERT_NEAR(light[i][0], 255 * linearFromSrgb(i / 255.0), 1) << i;
}

// Blits decode what passes store: each must leave the other's conversion as it was.
DRIVER_TEST(SrgbAttachment, IsDecodedByABlitBetweenTwoPasses) {
    using enum TextureUsage;
    const TextureHandle target = gpu.target(Format::RGBA8Srgb, kCodes, 1);
    PassDesc pass = passOver({ { target, Format::RGBA8Srgb } }, kCodes, 1);
    const PipelineHandle codes =
            gpu.pipeline(pipelineFor(gpu.program(kFullScreenVertex, fragmentOf("", kEveryCode)), pass.layout));
    const auto draw = [&] {
        gpu.record(CmdBeginPass{ pass });
        gpu.record(CmdBindPipeline{ codes });
        gpu.record(CmdDraw{ .vertexCount = 3 });
        gpu.record(CmdEndPass{});
    };
    for (int time = 0; time < 2; ++time) {
        draw();
        const TextureHandle copy = gpu.texture(
                { .format = Format::RGBA32F, .usage = TransferTarget | TransferSource, .width = kCodes, .height = 1 });
        gpu.record(CmdBlit{ .source = target, .target = copy, .sourceRect = kRow, .targetRect = kRow });
        EXPECT_EQ(gpu.readAs<Rgba8>(target, kRow), everyCode()) << time;
        expectDecoded(gpu.readAs<Rgba>(copy, kRow));
    }
}

DRIVER_TEST(SrgbAttachment, BlendsItsBytesAsRgba8Does) {
    std::vector<Bytes> seen;
    for (const Format format : kBothFormats) {
        const TextureHandle target = gpu.target(format, kCodes, 1);
        PassDesc pass = passOver({ { target, format } }, kCodes, 1);
        pass.colors[0].clear = { 0.75f, 0.25f, 0.5f, 0.5f };
        PipelineDesc desc = pipelineFor(gpu.program(kFullScreenVertex, fragmentOf("", kEveryCode)), pass.layout);
        desc.blend[0] = { .enabled = true,
                          .srcColor = BlendFactor::SrcAlpha,
                          .dstColor = BlendFactor::OneMinusSrcAlpha,
                          .dstAlpha = BlendFactor::OneMinusSrcAlpha };
        const PipelineHandle blending = gpu.pipeline(desc);
        gpu.record(CmdBeginPass{ pass });
        gpu.record(CmdBindPipeline{ blending });
        gpu.record(CmdDraw{ .vertexCount = 3 });
        gpu.record(CmdEndPass{});
        seen.push_back(gpu.read(target, kRow));
    }
    EXPECT_EQ(seen[0], seen[1]);
    const auto texel = [&](uint32_t i) { return std::to_integer<int>(seen[1][4 * size_t{ i }]); };
    EXPECT_NEAR(texel(0), 0.75 * 255, 1) << "nothing over it";
    EXPECT_NEAR(texel(128), 0.5 * 128 + 0.5 * 0.75 * 255, 1) << "half over it: the mean of the codes";
}

DRIVER_TEST(SrgbAttachment, ResolvesToTheAverageOfItsBytes) {
    for (const Format format : kBothFormats) {
        SCOPED_TRACE(formatInfo(format).name);
        const TextureHandle samples = gpu.target(format, 4, 1, 4), resolved = gpu.target(format, 4, 1);
        PassDesc pass = passOver({ { samples, format } }, 4, 1);
        pass.layout.samples = 4, pass.layout.resolveMask = 1;
        pass.colors[0].resolve = resolved, pass.colors[0].store = StoreOp::Discard;
        PipelineDesc desc = pipelineFor(gpu.program(kColorVertex, kColorFragment), pass.layout);
        useColorVertices(desc);
        const PipelineHandle pipeline = gpu.pipeline(desc);
        const Rgba white{ 1, 1, 1, 1 }; // from the left edge to the middle of pixel 1, half of its samples
        const BufferHandle vertices =
                gpu.buffer(BufferUsage::Vertex, std::vector<ColorVertex>{ { { -0.25f, -9, 0, 1 }, white },
                                                                          { { -0.25f, 9, 0, 1 }, white },
                                                                          { { -9, 0, 0, 1 }, white } });
        gpu.record(CmdBeginPass{ pass });
        gpu.record(CmdBindPipeline{ pipeline });
        gpu.record(CmdBindVertexBuffers{ .buffers = { vertices }, .count = 1 });
        gpu.record(CmdDraw{ .vertexCount = 3 });
        gpu.record(CmdEndPass{});
        const std::vector<Rgba8> texels = gpu.readAs<Rgba8>(resolved, { 0, 0, 4, 1 });
        EXPECT_EQ(texels[0], (Rgba8{ 255, 255, 255, 255 }));
        EXPECT_NEAR(texels[1][0], 127.5, 0.5) << "not 188, the code of half the light";
        EXPECT_EQ(texels[3], (Rgba8{ 0, 0, 0, 0 }));
    }
}

DRIVER_TEST(SrgbAttachment, IsReadByALaterSubpassAsItIsStored) {
    if (!gpu.info().features.mergedPasses) GTEST_SKIP() << "this device cannot merge passes";
    using enum TextureUsage;
    const TextureHandle codes = gpu.texture({ .format = Format::RGBA8Srgb,
                                              .usage = ColorAttachment | InputAttachment | TransferSource,
                                              .width = kCodes,
                                              .height = 1 }),
                        seen = gpu.target(Format::RGBA32F, kCodes, 1);
    PassDesc pass = passOver({ { codes, Format::RGBA8Srgb }, { seen, Format::RGBA32F } }, kCodes, 1);
    pass.layout.subpassCount = 2;
    pass.layout.subpasses[0] = { .colorMask = 1 };
    pass.layout.subpasses[1] = { .colorMask = 2, .inputMask = 1 };
    PipelineDesc desc = pipelineFor(gpu.program(kFullScreenVertex, fragmentOf("", kEveryCode)), pass.layout);
    const PipelineHandle draw = gpu.pipeline(desc);
    const Program reader = gpu.program(kFullScreenVertex, R"(#version 450
layout(input_attachment_index = 0, set = 1, binding = 0) uniform subpassInput codes;
layout(location = 1) out vec4 result;
void main() { result = subpassLoad(codes); })");
    desc.program = reader.handle, desc.subpass = 1;
    const PipelineHandle read = gpu.pipeline(desc);
    const BindGroupHandle group = gpu.group(reader, 1, { { .binding = 0, .texture = codes } });
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ draw });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdNextSubpass{});
    gpu.record(CmdBindPipeline{ read });
    gpu.record(CmdBindGroup{ .group = group, .index = 1 });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdEndPass{});
    const std::vector<Rgba> values = gpu.readAs<Rgba>(seen, kRow);
    for (uint32_t i = 0; i < kCodes; ++i) {
        for (size_t c = 0; c < 4; ++c) ASSERT_NEAR(values[i][c], codesOf(i)[c] / 255.0, 1e-6) << i << ", " << c;
    }
    EXPECT_EQ(gpu.readAs<Rgba8>(codes, kRow), everyCode());
}

DRIVER_TEST(SrgbAttachment, OneLevelIsDrawnAndTheOthersKeepWhatWasUploaded) {
    using enum TextureUsage;
    const TextureHandle texture = gpu.texture({ .format = Format::RGBA8Srgb,
                                                .usage = Sampled | ColorAttachment | TransferTarget | TransferSource,
                                                .levels = 2,
                                                .width = 2,
                                                .height = 1 });
    const std::vector<Rgba8> uploaded{ { 1, 2, 3, 4 }, { 200, 100, 50, 25 } };
    gpu.upload(texture, { 0, 0, 2, 1 }, bytesOf(uploaded));
    PassDesc pass = passOver({ { texture, Format::RGBA8Srgb } }, 1, 1);
    pass.colors[0].level = 1;
    pass.colors[0].clear = { 0.5f, 0.25f, 0.125f, 1 };
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdEndPass{});
    EXPECT_EQ(gpu.readAs<Rgba8>(texture, { 0, 0, 2, 1 }), uploaded);
    EXPECT_EQ(gpu.readAs<Rgba8>(texture, { 0, 0, 1, 1 }, 1), (std::vector<Rgba8>{ { 128, 64, 32, 255 } }));
}

} // namespace
} // namespace filament_core::backend
