// SPDX-License-Identifier: Apache-2.0
// Passes: load and store, multisampling and resolve, merged passes, and which state they reset.
#include "tests/backend/create/Gpu.h"
#include "tests/backend/create/Texel.h"

#include <gmock/gmock.h>

#include <cmath>

namespace filament_core::backend {
namespace {

using testing::Each;

DRIVER_SUITE(Pass);

void drawFullScreen(Gpu& gpu, PassDesc const& pass, PipelineHandle pipeline) {
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ pipeline });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdEndPass{});
}

DRIVER_TEST(Pass, LoadContinuesWhatStoreKept) {
    const TextureHandle target = gpu.target(Format::RGBA16F, 4, 4);
    PassDesc pass = passOver({ { target, Format::RGBA16F } }, 4, 4);
    pass.colors[0].clear = { 0.25f, 0.5f, 0, 1 };
    PipelineDesc desc = pipelineFor(
            gpu.program(kFullScreenVertex, fragmentOf("", "result = vec4(0.5, 0.125, 1.0, 0.0);")), pass.layout);
    desc.blend[0] = { .enabled = true, .dstColor = BlendFactor::One, .dstAlpha = BlendFactor::One };
    const PipelineHandle add = gpu.pipeline(desc);
    drawFullScreen(gpu, pass, add);
    pass.colors[0].load = LoadOp::Load;
    for (int i = 0; i < 3; ++i) drawFullScreen(gpu, pass, add);
    const Bytes expected = encodeTexel(Format::RGBA16F, { 0.25f + 4 * 0.5f, 0.5f + 4 * 0.125f, 4, 1 });
    const Bytes seen = gpu.read(target, { 0, 0, 4, 4 });
    for (size_t i = 0; i < seen.size(); ++i) ASSERT_EQ(seen[i], expected[i % 8]);
}

DRIVER_TEST(Pass, DiscardedContentsMayBeDrawnOverCompletely) {
    const TextureHandle target = gpu.target(Format::RGBA8, 4, 4);
    PassDesc pass = passOver({ { target, Format::RGBA8 } }, 4, 4);
    const PipelineHandle pipeline = gpu.pipeline(pipelineFor(
            gpu.program(kFullScreenVertex, fragmentOf("", "result = vec4(1.0, 0.0, 1.0, 1.0);")), pass.layout));
    pass.colors[0].store = StoreOp::Discard;
    drawFullScreen(gpu, pass, pipeline);
    pass.colors[0] = { .texture = target, .load = LoadOp::Discard };
    drawFullScreen(gpu, pass, pipeline);
    EXPECT_THAT(gpu.readAs<Rgba8>(target, { 0, 0, 4, 4 }), Each(Rgba8{ 255, 0, 255, 255 }));
}

/// The left half of 4 x 4 pixels, without a colour attachment.
void drawDepthAlone(Gpu& gpu, TextureHandle depth) {
    PassDesc pass;
    pass.layout.depthFormat = Format::D32F;
    pass.depth = { .texture = depth };
    pass.area = { 0, 0, 4, 4 };
    PipelineDesc desc = pipelineFor(gpu.program(kFullScreenVertex, "#version 450\nvoid main() {}\n"), pass.layout);
    desc.depthStencil = { .depthCompare = CompareOp::Greater, .depthWrite = true };
    const PipelineHandle pipeline = gpu.pipeline(desc);
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ pipeline });
    gpu.record(CmdSetScissor{ { 0, 0, 2, 4 } });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdEndPass{});
}

DRIVER_TEST(Pass, DepthAloneIsAPassAndCarriesOverToTheNext) {
    const TextureHandle depth = gpu.target(Format::D32F, 4, 4), color = gpu.target(Format::RGBA32F, 4, 4);
    drawDepthAlone(gpu, depth);
    PassDesc second = passOver({ { color, Format::RGBA32F } }, 4, 4);
    second.layout.depthFormat = Format::D32F;
    second.depth = { .texture = depth, .load = LoadOp::Load };
    PipelineDesc desc = pipelineFor(
            gpu.program(kFullScreenVertex, fragmentOf("", "result = vec4(1.0, 0.0, 0.0, 1.0);")), second.layout);
    desc.depthStencil = { .depthCompare = CompareOp::Equal }; // equal vertex stages give equal depths: z pre-pass
    drawFullScreen(gpu, second, gpu.pipeline(desc));
    const std::vector<Rgba> texels = gpu.readAs<Rgba>(color, { 0, 0, 4, 4 });
    for (uint32_t i = 0; i < 16; ++i) EXPECT_EQ(texels[i], i % 4 < 2 ? kRed : Rgba{}) << i;
}

/// Both passes in one submission, as in a frame (vulkan::Quirks::clearsIndependentBlend).
DRIVER_TEST(Pass, AttachmentsKeepTheirOwnBlendingAfterDepthAlone) {
    const TextureHandle depth = gpu.target(Format::D32F, 4, 4);
    const TextureHandle added = gpu.target(Format::RGBA32F, 4, 4), masked = gpu.target(Format::RGBA32F, 4, 4);
    PassDesc pass = passOver({ { added, Format::RGBA32F }, { masked, Format::RGBA32F } }, 4, 4);
    pass.colors[0].clear = { 1, 2, 3, 4 };
    pass.colors[1].clear = { 1, 2, 3, 4 };
    PipelineDesc desc = pipelineFor(gpu.program(kFullScreenVertex, R"(#version 450
layout(location = 0) out vec4 first;
layout(location = 1) out vec4 second;
void main() { first = vec4(0.5); second = vec4(8.0); })"),
                                    pass.layout);
    desc.blend[0] = {
        .enabled = true, .dstColor = BlendFactor::One, .dstAlpha = BlendFactor::One, .writeMask = 0b0101
    };
    desc.blend[1] = { .writeMask = 0b1010 };
    const PipelineHandle pipeline = gpu.pipeline(desc);
    drawDepthAlone(gpu, depth);
    drawFullScreen(gpu, pass, pipeline);
    EXPECT_THAT(gpu.readAs<Rgba>(added, { 0, 0, 4, 4 }), Each(Rgba{ 1.5f, 2, 3.5f, 4 }));
    EXPECT_THAT(gpu.readAs<Rgba>(masked, { 0, 0, 4, 4 }), Each(Rgba{ 1, 8, 3, 8 }));
}

// ---------------------------------------------------------------------------------------------- multisampling

PassDesc multisamplePass(Format format, TextureHandle samples, TextureHandle resolved, uint32_t width,
                         uint32_t height) {
    PassDesc pass = passOver({ { samples, format } }, width, height);
    pass.layout.samples = 4;
    pass.layout.resolveMask = 1;
    pass.colors[0].resolve = resolved;
    pass.colors[0].store = StoreOp::Discard;
    return pass;
}

DRIVER_TEST(Pass, ResolveAveragesTheCoveredSamplesOfTheStandardPattern) {
    // Columns of the 4x pattern lie at 1/8, 3/8, 5/8 and 7/8: an edge at x covers those to its left.
    for (const Format format : { Format::RGBA8, Format::RGBA16F, Format::R11G11B10F }) {
        SCOPED_TRACE(formatInfo(format).name);
        for (const double edge : { 0.0, 0.25, 0.5, 0.75, 1.0 }) {
            const TextureHandle samples = gpu.target(format, 4, 1, 4), resolved = gpu.target(format, 4, 1);
            const PassDesc pass = multisamplePass(format, samples, resolved, 4, 1);
            PipelineDesc desc = pipelineFor(gpu.program(kColorVertex, kColorFragment), pass.layout);
            useColorVertices(desc);
            desc.raster.topology = PrimitiveType::TriangleStrip;
            const PipelineHandle pipeline = gpu.pipeline(desc);
            const auto right = static_cast<float>((1 + edge) / 4 * 2 - 1); // inside of pixel 1
            const Rgba white{ 1, 1, 1, 1 };
            const BufferHandle vertices =
                    gpu.buffer(BufferUsage::Vertex, std::vector<ColorVertex>{ { { -1, -1, 0, 1 }, white },
                                                                              { { right, -1, 0, 1 }, white },
                                                                              { { -1, 1, 0, 1 }, white },
                                                                              { { right, 1, 0, 1 }, white } });
            gpu.record(CmdBeginPass{ pass });
            gpu.record(CmdBindPipeline{ pipeline });
            gpu.record(CmdBindVertexBuffers{ .buffers = { vertices }, .count = 1 });
            gpu.record(CmdDraw{ .vertexCount = 4 });
            gpu.record(CmdEndPass{});
            const Bytes bytes = gpu.read(resolved, { 0, 0, 4, 1 });
            const auto red = [&](size_t i) {
                return decodeTexel(format, bytes.data() + i * formatInfo(format).bytesPerBlock)[0];
            };
            EXPECT_EQ(red(0), 1);
            EXPECT_NEAR(red(1), edge, 0.5 / 255 + 1e-6) << "edge at " << edge;
            EXPECT_EQ(red(2), 0);
        }
    }
}

/// A pass that fetches each sample: four targets, each of which shows one.
DRIVER_TEST(Pass, SamplesAreFetchedOneByOne) {
    using enum TextureUsage;
    const TextureHandle samples = gpu.texture({ .format = Format::RGBA16F,
                                                .usage = ColorAttachment | Sampled,
                                                .samples = 4,
                                                .width = 4,
                                                .height = 2,
                                                .debugName = "samples" });
    PassDesc pass = passOver({ { samples, Format::RGBA16F } }, 4, 2);
    pass.layout.samples = 4;
    PipelineDesc desc = pipelineFor(gpu.program(kColorVertex, kColorFragment), pass.layout);
    useColorVertices(desc);
    const PipelineHandle pipeline = gpu.pipeline(desc);
    // An edge from the lower left to the upper right: 1000 on one side, 0 on the other.
    const Rgba light{ 1000, 0.5f, -1, 1 };
    const BufferHandle vertices =
            gpu.buffer(BufferUsage::Vertex, std::vector<ColorVertex>{ { { -1, -1, 0, 1 }, light },
                                                                      { { 1, -1, 0, 1 }, light },
                                                                      { { -1, 1, 0, 1 }, light } });
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ pipeline });
    gpu.record(CmdBindVertexBuffers{ .buffers = { vertices }, .count = 1 });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdEndPass{});
    // The standard pattern (Vulkan 1.3, 25.8): sixteenths of a pixel.
    constexpr std::array<std::array<int, 2>, 4> kPattern{ { { 6, 2 }, { 14, 6 }, { 2, 10 }, { 10, 14 } } };
    for (int i = 0; i < 4; ++i) {
        const Program fetch = gpu.program(
                kFullScreenVertex,
                fragmentOf("layout(set = 1, binding = 0) uniform highp sampler2DMS samples;",
                           "result = texelFetch(samples, ivec2(gl_FragCoord.xy), " + std::to_string(i) + ");"));
        EXPECT_TRUE(fetch.layout[1].bindings[0].isMultisampled);
        const TextureHandle shown =
                gpu.paint(fetch, { .width = 4, .height = 2, .group = gpu.imageGroup(fetch, samples, gpu.sampler()) });
        const std::vector<Rgba> texels = gpu.readAs<Rgba>(shown, { 0, 0, 4, 2 });
        for (int at = 0; at < 8; ++at) {
            const int x = at % 4 * 16 + kPattern[size_t(i)][0], y = at / 4 * 16 + kPattern[size_t(i)][1];
            if (x + 2 * y == 64) continue; // on the edge
            EXPECT_EQ(texels[size_t(at)], x + 2 * y < 64 ? light : Rgba{}) << "sample " << i << " of texel " << at;
        }
    }
}

DRIVER_TEST(Pass, MultisampledDepthIsTestedPerSample) {
    const TextureHandle samples = gpu.target(Format::RGBA8, 4, 4, 4), resolved = gpu.target(Format::RGBA8, 4, 4);
    const TextureHandle depth = gpu.target(Format::D32F, 4, 4, 4);
    PassDesc pass = multisamplePass(Format::RGBA8, samples, resolved, 4, 4);
    pass.layout.depthFormat = Format::D32F;
    pass.depth = { .texture = depth, .store = StoreOp::Discard, .clear = { 0.5f, 0, 0, 0 } };
    PipelineDesc desc = pipelineFor(gpu.program(kColorVertex, kColorFragment), pass.layout);
    useColorVertices(desc);
    desc.depthStencil = { .depthCompare = CompareOp::Greater, .depthWrite = true };
    const PipelineHandle pipeline = gpu.pipeline(desc);
    // z crosses 0.5 in the middle of pixel column 1: two of its four samples pass.
    const auto z = [](double x) { return static_cast<float>(0.5 + (x - 1.5) * 0.1); };
    const Rgba white{ 1, 1, 1, 1 };
    const BufferHandle vertices =
            gpu.buffer(BufferUsage::Vertex, std::vector<ColorVertex>{ { { -1, -1, z(0), 1 }, white },
                                                                      { { 3, -1, z(8), 1 }, white },
                                                                      { { -1, 3, z(0), 1 }, white } });
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ pipeline });
    gpu.record(CmdBindVertexBuffers{ .buffers = { vertices }, .count = 1 });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdEndPass{});
    const std::vector<Rgba8> texels = gpu.readAs<Rgba8>(resolved, { 0, 0, 4, 4 });
    for (uint32_t i = 0; i < 16; ++i) {
        const double expected = i % 4 == 0 ? 0 : i % 4 == 1 ? 127.5 : 255;
        EXPECT_NEAR(texels[i][0], expected, 0.5) << i;
    }
}

struct DepthScene {
    TextureHandle resolved;
    PassDesc pass{};
    PipelineHandle pipeline;
};

DepthScene multisampledDepth(Gpu& gpu, Format format, uint32_t size) {
    DepthScene scene{ .resolved = gpu.target(format, size, size) };
    scene.pass.layout.depthFormat = format;
    scene.pass.layout.samples = 4;
    scene.pass.layout.resolvesDepth = true;
    scene.pass.depth = { .texture = gpu.target(format, size, size, 4),
                         .store = StoreOp::Discard,
                         .resolve = scene.resolved };
    scene.pass.area = { 0, 0, size, size };
    scene.pass.debugName = "depth";
    PipelineDesc desc =
            pipelineFor(gpu.program(kColorVertex, "#version 450\nlayout(location = 0) in vec4 vertexColor;\n"
                                                  "void main() {}\n"),
                        scene.pass.layout);
    useColorVertices(desc);
    desc.raster.topology = PrimitiveType::TriangleStrip;
    desc.depthStencil = { .depthCompare = CompareOp::Greater, .depthWrite = true };
    scene.pipeline = gpu.pipeline(desc);
    return scene;
}

/// Depth at a position of the image, in pixels; samples of one pixel differ by at least 0.015.
double slopingDepth(double x, double y) { return x / 16 + y / 256; }

/// From the left edge to `right`, all rows.
void drawSlope(Gpu& gpu, DepthScene const& scene, double right) {
    const double size = scene.pass.area.width;
    const auto corner = [&](double x, double y) {
        const auto clip = [size](double at) { return static_cast<float>(at / size * 2 - 1); };
        return ColorVertex{ { clip(x), clip(y), static_cast<float>(slopingDepth(x, y)), 1 }, {} };
    };
    const BufferHandle vertices =
            gpu.buffer(BufferUsage::Vertex, std::vector<ColorVertex>{ corner(0, 0), corner(right, 0), corner(0, size),
                                                                      corner(right, size) });
    gpu.record(CmdBeginPass{ scene.pass });
    gpu.record(CmdBindPipeline{ scene.pipeline });
    gpu.record(CmdBindVertexBuffers{ .buffers = { vertices }, .count = 1 });
    gpu.record(CmdDraw{ .vertexCount = 4 });
    gpu.record(CmdEndPass{});
}

DRIVER_TEST(Pass, ResolvedDepthIsThatOfTheFirstSampleOfTheStandardPattern) {
    constexpr uint32_t kSide = 8;
    constexpr double kSampleX = 0.375, kSampleY = 0.125; // of sample 0
    for (const Format format : { Format::D32F, Format::D16, Format::D32FS8 }) {
        SCOPED_TRACE(formatInfo(format).name);
        for (const double right : { 8.0, 4.25, 4.5 }) { // in pixel 4, sample 0 lies between the two edges
            const DepthScene scene = multisampledDepth(gpu, format, kSide);
            drawSlope(gpu, scene, right);
            const auto depths = gpu.readAs<float>(scene.resolved, { 0, 0, kSide, kSide });
            for (uint32_t i = 0; i < depths.size(); ++i) {
                const double x = i % kSide + kSampleX, y = i / kSide + kSampleY;
                EXPECT_NEAR(depths[i], x < right ? slopingDepth(x, y) : 0, format == Format::D16 ? 1e-5 : 1e-6)
                        << "edge at " << right << ", pixel " << i % kSide << ", " << i / kSide;
            }
        }
    }
}

DRIVER_TEST(Pass, ThePassAfterADepthResolveSamplesTheTarget) {
    constexpr uint32_t kSide = 8;
    const DepthScene scene = multisampledDepth(gpu, Format::D32F, kSide);
    drawSlope(gpu, scene, 8);
    const Program show =
            gpu.program(kFullScreenVertex, fragmentOf("layout(set = 1, binding = 0) uniform highp sampler2D depth;",
                                                      "result = texelFetch(depth, ivec2(gl_FragCoord.xy), 0);"));
    const TextureHandle shown = gpu.paint(
            show, { .width = kSide, .height = kSide, .group = gpu.imageGroup(show, scene.resolved, gpu.sampler()) });
    drawSlope(gpu, scene, 4); // the target may be written again after it was read
    const auto sampled = gpu.readAs<Rgba>(shown, { 0, 0, kSide, kSide });
    const auto again = gpu.readAs<float>(scene.resolved, { 0, 0, kSide, kSide });
    for (uint32_t i = 0; i < sampled.size(); ++i) {
        EXPECT_NEAR(sampled[i][0], slopingDepth(i % kSide + 0.375, i / kSide + 0.125), 1e-6) << i;
        EXPECT_EQ(again[i], i % kSide < 4 ? sampled[i][0] : 0) << i;
    }
}

DRIVER_TEST(Pass, DepthOfEveryFormatIsSampledAsItReadsBack) {
    for (const Format format : { Format::D16, Format::D32F, Format::D32FS8 }) {
        SCOPED_TRACE(formatInfo(format).name);
        const TextureHandle depth = gpu.target(format, 8, 8);
        PassDesc pass;
        pass.layout.depthFormat = format;
        pass.depth = { .texture = depth };
        pass.area = { 0, 0, 8, 8 };
        const Program ramp = gpu.program(
                kFullScreenVertex,
                "#version 450\nvoid main() { gl_FragDepth = (gl_FragCoord.x * 8.0 + gl_FragCoord.y) / 73.0; }");
        PipelineDesc desc = pipelineFor(ramp, pass.layout);
        desc.depthStencil = { .depthCompare = CompareOp::Always, .depthWrite = true };
        drawFullScreen(gpu, pass, gpu.pipeline(desc));
        const Program show =
                gpu.program(kFullScreenVertex, fragmentOf("layout(set = 1, binding = 0) uniform highp sampler2D depth;",
                                                          "result = texelFetch(depth, ivec2(gl_FragCoord.xy), 0);"));
        const TextureHandle shown =
                gpu.paint(show, { .width = 8, .height = 8, .group = gpu.imageGroup(show, depth, gpu.sampler()) });
        const auto sampled = gpu.readAs<Rgba>(shown, { 0, 0, 8, 8 });
        const auto stored = gpu.readAs<float>(depth, { 0, 0, 8, 8 });
        for (uint32_t i = 0; i < 64; ++i) {
            if (format == Format::D16)
                EXPECT_FLOAT_EQ(sampled[i][0], stored[i]) << i; // samplers multiply by a rounded 1 / 65535
            else
                EXPECT_EQ(sampled[i][0], stored[i]) << i;
            EXPECT_EQ(sampled[i][3], 1) << i;
        }
    }
}

DRIVER_TEST(Pass, SeveralAttachmentsResolveIntoTheirOwnTargets) {
    const TextureHandle a = gpu.target(Format::RGBA8, 2, 2, 4), b = gpu.target(Format::RGBA16F, 2, 2, 4);
    const TextureHandle resolvedA = gpu.target(Format::RGBA8, 2, 2), resolvedB = gpu.target(Format::RGBA16F, 2, 2);
    PassDesc pass = passOver({ { a, Format::RGBA8 }, { b, Format::RGBA16F } }, 2, 2);
    pass.layout.samples = 4;
    pass.layout.resolveMask = 3;
    pass.colors[0] = { .texture = a, .store = StoreOp::Discard, .clear = { 0, 1, 0, 1 }, .resolve = resolvedA };
    pass.colors[1] = { .texture = b, .store = StoreOp::Discard, .clear = { 4, 2, 1, 0.5f }, .resolve = resolvedB };
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdEndPass{});
    EXPECT_THAT(gpu.readAs<Rgba8>(resolvedA, { 0, 0, 2, 2 }), Each(Rgba8{ 0, 255, 0, 255 }));
    const Bytes expected = encodeTexel(Format::RGBA16F, { 4, 2, 1, 0.5f });
    const Bytes seen = gpu.read(resolvedB, { 0, 0, 2, 2 });
    for (size_t i = 0; i < seen.size(); ++i) ASSERT_EQ(seen[i], expected[i % 8]);
}

// ---------------------------------------------------------------------------------------------- merged passes

constexpr std::string_view kReadFirst = R"(#version 450
layout(input_attachment_index = 0, set = 1, binding = 0) uniform subpassInput hdr;
layout(location = 1) out vec4 result;
void main() { result = subpassLoad(hdr) * 2.0 + vec4(0.0, 0.0, 0.0, 1.0); })";

struct Merged {
    TextureHandle first{}, second{};
    PassDesc pass{};
    PipelineHandle draw{}, read{};
    BindGroupHandle group{};
};

Merged makeMerged(Gpu& gpu, Format format, bool transient) {
    using enum TextureUsage;
    Merged merged;
    const TextureUsage inner = ColorAttachment | InputAttachment;
    merged.first = gpu.texture({ .format = format,
                                 .usage = transient ? inner | Transient : inner | TransferSource,
                                 .width = 6,
                                 .height = 4 });
    merged.second = gpu.target(Format::RGBA32F, 6, 4);
    merged.pass = passOver({ { merged.first, format }, { merged.second, Format::RGBA32F } }, 6, 4);
    merged.pass.layout.subpassCount = 2;
    merged.pass.layout.subpasses[0] = { .colorMask = 1 };
    merged.pass.layout.subpasses[1] = { .colorMask = 2, .inputMask = 1, .usesDepth = false };
    if (transient) merged.pass.colors[0].store = StoreOp::Discard;
    const Program writer =
            gpu.program(kFullScreenVertex, fragmentOf("", "result = vec4(floor(gl_FragCoord.xy) * 0.25, 1.0, 0.5);"));
    const Program reader = gpu.program(kFullScreenVertex, kReadFirst);
    PipelineDesc desc = pipelineFor(writer, merged.pass.layout);
    merged.draw = gpu.pipeline(desc);
    desc.program = reader.handle;
    desc.subpass = 1;
    merged.read = gpu.pipeline(desc);
    merged.group = gpu.group(reader, 1, { { .binding = 0, .texture = merged.first } });
    return merged;
}

/// `scissor`: of another draw in the first subpass.
void recordMerged(Gpu& gpu, Merged const& merged, std::optional<Rect> scissor = {}) {
    gpu.record(CmdBeginPass{ merged.pass });
    gpu.record(CmdBindPipeline{ merged.draw });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    if (scissor) {
        gpu.record(CmdSetScissor{ *scissor });
        gpu.record(CmdDraw{ .vertexCount = 3 });
    }
    gpu.record(CmdNextSubpass{});
    gpu.record(CmdBindPipeline{ merged.read });
    gpu.record(CmdBindGroup{ .group = merged.group, .index = 1 });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdEndPass{});
}

DRIVER_TEST(Pass, ALaterSubpassReadsTheSamePixelOfAnEarlierOne) {
    if (!gpu.info().features.mergedPasses) GTEST_SKIP() << "this device cannot merge passes";
    for (const Format format : { Format::RGBA16F, Format::RGBA32F }) {
        for (const bool transient : { false, true }) {
            const Merged merged = makeMerged(gpu, format, transient);
            recordMerged(gpu, merged);
            const std::vector<Rgba> texels = gpu.readAs<Rgba>(merged.second, { 0, 0, 6, 4 });
            for (uint32_t i = 0; i < texels.size(); ++i) {
                const Rgba expected{ static_cast<float>(i % 6) * 0.5f, static_cast<float>(i / 6) * 0.5f, 2, 2 };
                ASSERT_EQ(texels[i], expected) << i;
            }
        }
    }
}

DRIVER_TEST(Pass, ALaterSubpassIsNotCutByTheScissorOfAnEarlierOne) {
    if (!gpu.info().features.mergedPasses) GTEST_SKIP() << "this device cannot merge passes";
    const Merged merged = makeMerged(gpu, Format::RGBA16F, true);
    recordMerged(gpu, merged, Rect{ 1, 1, 2, 2 });
    const std::vector<Rgba> texels = gpu.readAs<Rgba>(merged.second, { 0, 0, 6, 4 });
    for (uint32_t i = 0; i < texels.size(); ++i) {
        const Rgba expected{ static_cast<float>(i % 6) * 0.5f, static_cast<float>(i / 6) * 0.5f, 2, 2 };
        ASSERT_EQ(texels[i], expected) << i;
    }
}

/// A shadow map and a tone mapper that reads the colours of its own pass: what a first frame draws in one submission.
DRIVER_TEST(Pass, ALaterSubpassDrawsAfterDepthAlone) {
    if (!gpu.info().features.mergedPasses) GTEST_SKIP() << "this device cannot merge passes";
    const TextureHandle depth = gpu.target(Format::D32F, 4, 4);
    const Merged merged = makeMerged(gpu, Format::RGBA16F, true);
    drawDepthAlone(gpu, depth);
    recordMerged(gpu, merged);
    const std::vector<Rgba> texels = gpu.readAs<Rgba>(merged.second, { 0, 0, 6, 4 });
    for (uint32_t i = 0; i < texels.size(); ++i) {
        const Rgba expected{ static_cast<float>(i % 6) * 0.5f, static_cast<float>(i / 6) * 0.5f, 2, 2 };
        ASSERT_EQ(texels[i], expected) << i;
    }
}

DRIVER_TEST(Pass, AMergedPassKeepsWhatItStoresOfTheFirstSubpass) {
    if (!gpu.info().features.mergedPasses) GTEST_SKIP() << "this device cannot merge passes";
    const Merged merged = makeMerged(gpu, Format::RGBA32F, false);
    recordMerged(gpu, merged);
    const std::vector<Rgba> texels = gpu.readAs<Rgba>(merged.first, { 0, 0, 6, 4 });
    for (uint32_t i = 0; i < texels.size(); ++i) {
        ASSERT_EQ(texels[i], (Rgba{ static_cast<float>(i % 6) * 0.25f, static_cast<float>(i / 6) * 0.25f, 1, 0.5f }))
                << i;
    }
}

DRIVER_TEST(Pass, AMergedPassGivesTheSameBitsAsTwoPassesWithATexture) {
    if (!gpu.info().features.mergedPasses) GTEST_SKIP() << "this device cannot merge passes";
    const Merged merged = makeMerged(gpu, Format::RGBA16F, true);
    recordMerged(gpu, merged);
    const Bytes together = gpu.read(merged.second, { 0, 0, 6, 4 });
    const Program writer =
            gpu.program(kFullScreenVertex, fragmentOf("", "result = vec4(floor(gl_FragCoord.xy) * 0.25, 1.0, 0.5);"));
    const TextureHandle first = gpu.paint(writer, { .width = 6, .height = 4, .format = Format::RGBA16F });
    const Program reader = gpu.program(
            kFullScreenVertex,
            fragmentOf("layout(set = 1, binding = 0) uniform sampler2D hdr;",
                       "result = texelFetch(hdr, ivec2(gl_FragCoord.xy), 0) * 2.0 + vec4(0.0, 0.0, 0.0, 1.0);"));
    const TextureHandle second =
            gpu.paint(reader, { .width = 6, .height = 4, .group = gpu.imageGroup(reader, first, gpu.sampler()) });
    EXPECT_EQ(gpu.read(second, { 0, 0, 6, 4 }), together);
}

// ---------------------------------------------------------------------------------------------- state between passes

DRIVER_TEST(Pass, APassSamplesWhatTheOneBeforeItDrew) {
    Program program = gpu.program(kFullScreenVertex, fragmentOf("", "result = vec4(gl_FragCoord.x);"));
    TextureHandle texture = gpu.paint(program, { .width = 4, .height = 4 });
    program =
            gpu.program(kFullScreenVertex, fragmentOf("layout(set = 1, binding = 0) uniform sampler2D image;",
                                                      "result = texelFetch(image, ivec2(gl_FragCoord.xy), 0) * 2.0;"));
    const SamplerHandle sampler = gpu.sampler();
    for (int i = 0; i < 5; ++i)
        texture = gpu.paint(program, { .width = 4, .height = 4, .group = gpu.imageGroup(program, texture, sampler) });
    const std::vector<Rgba> texels = gpu.readAs<Rgba>(texture, { 0, 0, 4, 4 });
    for (uint32_t i = 0; i < 16; ++i) ASSERT_EQ(texels[i][0], (static_cast<float>(i % 4) + 0.5f) * 32) << i;
}

DRIVER_TEST(Pass, AChainOfHalvedTexturesEndsInTheAverageOfTheFirst) {
    using enum TextureUsage;
    // A chain of separate textures, as in down-sampling passes: each samples the previous one with a linear filter.
    const Program half =
            gpu.program(kFullScreenVertex,
                        fragmentOf("layout(set = 1, binding = 0) uniform sampler2D image;",
                                   "result = texture(image, gl_FragCoord.xy / vec2(textureSize(image, 0) / 2));"));
    std::vector<float> texels(64);
    for (size_t i = 0; i < 64; ++i) texels[i] = static_cast<float>(i % 8 + i / 8 * 16);
    const SamplerHandle linear = gpu.sampler({ .magFilter = Filter::Linear, .minFilter = Filter::Linear });
    TextureHandle texture = gpu.image(Format::R32F, 8, 8, bytesOf(texels));
    for (uint32_t size = 4; size >= 1; size /= 2) {
        texture = gpu.paint(half, { .width = size, .height = size, .group = gpu.imageGroup(half, texture, linear) });
    }
    EXPECT_NEAR(gpu.readAs<Rgba>(texture, { 0, 0, 1, 1 })[0][0], 3.5 + 3.5 * 16, 0.02);
}

} // namespace
} // namespace filament_core::backend
