// SPDX-License-Identifier: Apache-2.0
// How fragment outputs reach colour attachments: blending, write masks, several targets, integers, alpha to coverage.
#include "tests/backend/create/Gpu.h"
#include "tests/backend/create/Texel.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

namespace filament_core::backend {
namespace {

using testing::Each;

DRIVER_SUITE(Blend);

// Multiples of 1/8: they, their products and their sums are exact in half floats.
constexpr Rgba kSource{ 0.5f, 0.25f, 1.0f, 0.75f };
constexpr Rgba kTarget{ 0.25f, 0.5f, 0.125f, 0.5f };

float factor(BlendFactor which, Rgba const& s, Rgba const& d, size_t c) {
    switch (which) {
    case BlendFactor::Zero:
        return 0;
    case BlendFactor::One:
        return 1;
    case BlendFactor::SrcColor:
        return s[c];
    case BlendFactor::OneMinusSrcColor:
        return 1 - s[c];
    case BlendFactor::DstColor:
        return d[c];
    case BlendFactor::OneMinusDstColor:
        return 1 - d[c];
    case BlendFactor::SrcAlpha:
        return s[3];
    case BlendFactor::OneMinusSrcAlpha:
        return 1 - s[3];
    case BlendFactor::DstAlpha:
        return d[3];
    case BlendFactor::OneMinusDstAlpha:
        return 1 - d[3];
    case BlendFactor::SrcAlphaSaturate:
        return c == 3 ? 1 : std::min(s[3], 1 - d[3]);
    }
    return 0;
}

float combine(BlendOp op, float s, float d, float source, float target) {
    switch (op) {
    case BlendOp::Add:
        return s + d;
    case BlendOp::Subtract:
        return s - d;
    case BlendOp::ReverseSubtract:
        return d - s;
    case BlendOp::Min:
        return std::min(source, target); // min and max ignore factors
    case BlendOp::Max:
        return std::max(source, target);
    }
    return 0;
}

Rgba blended(BlendState const& state, Rgba const& s, Rgba const& d) {
    Rgba result = s;
    for (size_t c = 0; c < 4; ++c) {
        const BlendFactor source = c < 3 ? state.srcColor : state.srcAlpha,
                          target = c < 3 ? state.dstColor : state.dstAlpha;
        if (state.enabled) {
            result[c] = combine(c < 3 ? state.colorOp : state.alphaOp, s[c] * factor(source, s, d, c),
                                d[c] * factor(target, s, d, c), s[c], d[c]);
        }
        if ((state.writeMask >> c & 1) == 0) result[c] = d[c];
    }
    return result;
}

std::string outputsOf(uint32_t count, Rgba const& value) {
    std::string text = "#version 450\n";
    std::string body;
    for (uint32_t i = 0; i < count; ++i) {
        text += fmt::format("layout(location = {}) out vec4 result{};\n", i, i);
        body += fmt::format("    result{} = vec4({:f}, {:f}, {:f}, {:f});\n", i, value[0], value[1], value[2],
                            value[3]);
    }
    return text + "void main() {\n" + body + "}\n";
}

/// Draws kSource over kTarget with a different state in each of up to 8 attachments and checks them all.
void checkStates(Gpu& gpu, std::vector<BlendState> const& states, Format format, double tolerance) {
    const auto count = static_cast<uint32_t>(std::min<size_t>(states.size(), gpu.info().limits.maxColorAttachments));
    PassDesc pass = passOver({}, 2, 2);
    pass.layout.colorCount = static_cast<uint8_t>(count);
    for (uint32_t i = 0; i < count; ++i) {
        pass.layout.colorFormats[i] = format;
        pass.colors[i] = { .texture = gpu.target(format, 2, 2), .clear = kTarget };
    }
    PipelineDesc desc = pipelineFor(gpu.program(kFullScreenVertex, outputsOf(count, kSource)), pass.layout);
    std::copy_n(states.begin(), count, desc.blend.begin());
    const PipelineHandle pipeline = gpu.pipeline(desc);
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ pipeline });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdEndPass{});
    for (uint32_t i = 0; i < count; ++i) {
        const Rgba expected = blended(states[i], kSource, kTarget);
        const Bytes bytes = gpu.read(pass.colors[i].texture, { 0, 0, 2, 2 });
        const Rgba seen = decodeTexel(format, bytes.data());
        for (size_t c = 0; c < 4; ++c) {
            EXPECT_NEAR(seen[c], expected[c], tolerance) << "attachment " << i << " component " << c
                                                         << ", source factor " << static_cast<int>(states[i].srcColor)
                                                         << ", target factor " << static_cast<int>(states[i].dstColor);
        }
    }
    if (count < states.size()) checkStates(gpu, { states.begin() + count, states.end() }, format, tolerance);
}

constexpr int kFactors = static_cast<int>(BlendFactor::SrcAlphaSaturate) + 1;

std::vector<BlendState> allFactors() {
    std::vector<BlendState> states;
    for (int i = 0; i < kFactors; ++i) {
        const auto which = static_cast<BlendFactor>(i);
        states.push_back({ .enabled = true,
                           .srcColor = which,
                           .dstColor = BlendFactor::Zero,
                           .srcAlpha = which,
                           .dstAlpha = BlendFactor::Zero });
        if (which == BlendFactor::SrcAlphaSaturate) continue; // allowed only as a source factor
        states.push_back({ .enabled = true,
                           .srcColor = BlendFactor::Zero,
                           .dstColor = which,
                           .srcAlpha = BlendFactor::Zero,
                           .dstAlpha = which });
    }
    return states;
}

DRIVER_TEST(Blend, EveryFactorMultipliesWhatItsNameSays) { checkStates(gpu, allFactors(), Format::RGBA16F, 0); }

DRIVER_TEST(Blend, EveryFactorWorksOnNormalizedTargetsWithinAStep) {
    checkStates(gpu, allFactors(), Format::RGBA8, 1.0 / 255);
}

DRIVER_TEST(Blend, EveryOperationCombinesSourceAndTarget) {
    std::vector<BlendState> states;
    for (const BlendOp op : { BlendOp::Add, BlendOp::Subtract, BlendOp::ReverseSubtract, BlendOp::Min, BlendOp::Max }) {
        states.push_back({ .enabled = true,
                           .dstColor = BlendFactor::One,
                           .dstAlpha = BlendFactor::One,
                           .colorOp = op,
                           .alphaOp = op });
    }
    states.push_back({ .enabled = true,
                       .dstColor = BlendFactor::One,
                       .dstAlpha = BlendFactor::One,
                       .colorOp = BlendOp::Subtract,
                       .alphaOp = BlendOp::Max });
    checkStates(gpu, states, Format::RGBA16F, 0);
}

DRIVER_TEST(Blend, PremultipliedColorsCoverAsAlphaSays) {
    checkStates(gpu,
                { { .enabled = true,
                    .dstColor = BlendFactor::OneMinusSrcAlpha,
                    .dstAlpha = BlendFactor::OneMinusSrcAlpha } },
                Format::RGBA16F, 0);
}

DRIVER_TEST(Blend, EveryWriteMaskKeepsTheOtherComponents) {
    std::vector<BlendState> states;
    for (uint8_t mask = 0; mask < 16; ++mask) states.push_back({ .writeMask = mask });
    checkStates(gpu, states, Format::RGBA16F, 0);
}

DRIVER_TEST(Blend, AWriteMaskOfOnePipelineDoesNotMaskTheClearOfTheNextPass) {
    const TextureHandle target = gpu.target(Format::RGBA8, 2, 2);
    PassDesc pass = passOver({ { target, Format::RGBA8 } }, 2, 2);
    PipelineDesc desc = pipelineFor(gpu.program(kFullScreenVertex, outputsOf(1, kSource)), pass.layout);
    desc.blend[0].writeMask = 0;
    const PipelineHandle pipeline = gpu.pipeline(desc);
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ pipeline });
    gpu.record(CmdSetScissor{ { 0, 0, 1, 1 } });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdEndPass{});
    pass.colors[0].clear = { 1, 1, 1, 1 };
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdEndPass{});
    EXPECT_THAT(gpu.readAs<Rgba8>(target, { 0, 0, 2, 2 }), Each(Rgba8{ 255, 255, 255, 255 }));
}

DRIVER_TEST(Blend, SeveralTargetsOfDifferentKindsGetTheirOwnOutputs) {
    const TextureHandle a = gpu.target(Format::RGBA8, 3, 3), b = gpu.target(Format::RG32UI, 3, 3),
                        c = gpu.target(Format::R16F, 3, 3), d = gpu.target(Format::RGB10A2, 3, 3);
    PassDesc pass = passOver(
            { { a, Format::RGBA8 }, { b, Format::RG32UI }, { c, Format::R16F }, { d, Format::RGB10A2 } }, 3, 3);
    constexpr std::string_view kOutputs = R"(#version 450
layout(location = 0) out vec4 a;
layout(location = 1) out uvec2 b;
layout(location = 2) out float c;
layout(location = 3) out vec4 d;
void main() {
    a = vec4(0.0, 1.0, 0.0, 1.0);
    b = uvec2(gl_FragCoord.xy) * 1000000000u;
    c = -gl_FragCoord.x;
    d = vec4(1.0, 0.0, 1.0, 0.0);
})";
    const PipelineHandle pipeline = gpu.pipeline(pipelineFor(gpu.program(kFullScreenVertex, kOutputs), pass.layout));
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ pipeline });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdEndPass{});
    EXPECT_THAT(gpu.readAs<Rgba8>(a, { 0, 0, 3, 3 }), Each(Rgba8{ 0, 255, 0, 255 }));
    const auto integers = gpu.readAs<std::array<uint32_t, 2>>(b, { 0, 0, 3, 3 });
    const Bytes halves = gpu.read(c, { 0, 0, 3, 3 });
    for (uint32_t i = 0; i < 9; ++i) {
        EXPECT_EQ(integers[i], (std::array<uint32_t, 2>{ i % 3 * 1000000000u, i / 3 * 1000000000u }));
        EXPECT_EQ(decodeTexel(Format::R16F, halves.data() + size_t{ 2 } * i)[0], -static_cast<float>(i % 3) - 0.5f);
    }
    EXPECT_THAT(gpu.readAs<uint32_t>(d, { 0, 0, 3, 3 }), Each(1023u | 1023u << 20));
}

DRIVER_TEST(Blend, AnOutputThatTheProgramLacksLeavesItsAttachmentAlone) {
    const TextureHandle a = gpu.target(Format::RGBA8, 2, 2), b = gpu.target(Format::RGBA8, 2, 2);
    PassDesc pass = passOver({ { a, Format::RGBA8 }, { b, Format::RGBA8 } }, 2, 2);
    pass.colors[1].clear = { 0, 0, 1, 1 };
    const PipelineHandle pipeline =
            gpu.pipeline(pipelineFor(gpu.program(kFullScreenVertex, outputsOf(1, { 1, 1, 1, 1 })), pass.layout));
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ pipeline });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdEndPass{});
    EXPECT_THAT(gpu.readAs<Rgba8>(a, { 0, 0, 2, 2 }), Each(Rgba8{ 255, 255, 255, 255 }));
    EXPECT_THAT(gpu.readAs<Rgba8>(b, { 0, 0, 2, 2 }), Each(Rgba8{ 0, 0, 255, 255 }));
}

DRIVER_TEST(Blend, StoredColorsClampAndRoundToTheirFormat) {
    struct Case {
        Format format;
        Rgba written;
    };
    // The values are exact in half floats, because devices may round a conversion either way (Mesa's llvmpipe
    // truncates).
    for (Case const& one :
         { Case{ Format::RGBA8, { -1, 2, 0.25f, 0.625f } }, Case{ Format::RGB10A2, { 0.25f, 0.625f, 7, 0.3f } },
           Case{ Format::RGBA16F, { 0.125f, 1000.5f, -7, 60000 } },
           Case{ Format::R11G11B10F, { 0.5f, 96, 3.5f, 1 } } }) {
        SCOPED_TRACE(formatInfo(one.format).name);
        const Program program = gpu.program(kFullScreenVertex, outputsOf(1, one.written));
        Rgba clamped = one.written;
        if (!formatInfo(one.format).isFloat)
            std::ranges::for_each(clamped, [](float& v) { v = std::clamp(v, 0.0f, 1.0f); });
        EXPECT_EQ(gpu.read(gpu.paint(program, { .width = 1, .height = 1, .format = one.format }), { 0, 0, 1, 1 }),
                  encodeTexel(one.format, clamped));
    }
}

DRIVER_TEST(Blend, AlphaToCoverageTurnsAlphaIntoSamples) {
    const TextureHandle samples = gpu.target(Format::RGBA16F, 3, 1, 4), resolved = gpu.target(Format::RGBA16F, 3, 1);
    PassDesc pass = passOver({ { samples, Format::RGBA16F } }, 3, 1);
    pass.layout.samples = 4;
    pass.layout.resolveMask = 1;
    pass.colors[0].resolve = resolved;
    pass.colors[0].store = StoreOp::Discard;
    PipelineDesc desc =
            pipelineFor(gpu.program(kFullScreenVertex,
                                    fragmentOf("", "result = vec4(1.0, 1.0, 1.0, floor(gl_FragCoord.x) * 0.5);")),
                        pass.layout);
    desc.raster.alphaToCoverage = true;
    const PipelineHandle pipeline = gpu.pipeline(desc);
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ pipeline });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdEndPass{});
    const Bytes bytes = gpu.read(resolved, { 0, 0, 3, 1 });
    const auto red = [&](size_t i) { return decodeTexel(Format::RGBA16F, bytes.data() + 8 * i)[0]; };
    EXPECT_EQ(red(0), 0);
    EXPECT_EQ(red(2), 1);
    EXPECT_TRUE(red(1) == 0.25f || red(1) == 0.5f || red(1) == 0.75f) << red(1) << ": some of the four samples";
}

} // namespace
} // namespace filament_core::backend
