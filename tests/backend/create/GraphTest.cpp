// SPDX-License-Identifier: Apache-2.0
// Frame graphs on both APIs: a chain of levels, a history, resolved depth and a dispatch, with the same bits.
#include "framegraph/CompiledGraph.h"
#include "tests/backend/create/Gpu.h"

#include <algorithm>

namespace filament_core::backend {

DRIVER_SUITE(Graph);

namespace {

using framegraph::BufferId;
using framegraph::BufferUse;
using framegraph::CompiledGraph;
using framegraph::FrameGraph;
using framegraph::PassBuilder;
using framegraph::PassContext;
using framegraph::Previous;
using framegraph::TextureId;

constexpr uint32_t kSize = 32;

/// Runs graphs one after the other on the stream of `gpu`.
class Frames {
public:
    explicit Frames(Gpu& gpu) : mGpu(gpu), mPool(gpu.stream()) {}
    ~Frames() { mPool.destroyAll(mGpu.commands()); }

    FrameGraph& graph() { return mGraph; }
    void run(std::vector<framegraph::PassTimer>* timers = nullptr) {
        const CompiledGraph plan = compile(mGraph, mPool);
        record(mGpu.commands(), plan, timers);
        mGpu.submit();
        mGraph.reset();
        mArena.reset();
    }

private:
    Gpu& mGpu;
    Arena mArena;
    FrameGraph mGraph{ mArena };
    framegraph::TransientPool mPool;
};

/// A full-screen draw of `program` that samples `from` (none: nothing) as binding 0 of group 1. Takes references,
/// because the test owns program and sampler.
struct Effect {
    Gpu& gpu;
    Program program;
    SamplerHandle sampler;

    auto prepare(TextureId from, TextureRange range = {}) const {
        return [this, from, range](PassContext& context) {
            struct Prepared {
                PipelineHandle pipeline;
                BindGroupHandle group;
            } prepared;
            PipelineDesc desc = pipelineFor(program, context.passLayout());
            desc.subpass = context.subpass();
            prepared.pipeline = gpu.pipeline(desc);
            if (!from) return prepared;
            const BindGroupEntry entry{ .texture = context.texture(from), .sampler = sampler, .range = range };
            prepared.group = context.bindGroup(program.layout[1], { &entry, 1 }, "input");
            return prepared;
        };
    }
    static auto draw() {
        return [](PassContext& context, auto prepared) {
            context.commands().record(CmdBindPipeline{ prepared.pipeline });
            if (prepared.group) context.commands().record(CmdBindGroup{ .group = prepared.group, .index = 1 });
            context.commands().record(CmdDraw{ .vertexCount = 3 });
        };
    }
};

Effect effect(Gpu& gpu, std::string_view declarations, std::string_view body) {
    return { gpu, gpu.program(kFullScreenVertex, fragmentOf(declarations, body)), gpu.sampler() };
}

constexpr std::string_view kInput = "layout(set = 1, binding = 0) uniform highp sampler2D from;";

framegraph::GraphTextureDesc pictureOf(std::string_view name, uint8_t levels = 1) {
    return { .width = kSize, .height = kSize, .format = Format::R32F, .levels = levels, .name = name };
}

} // namespace

DRIVER_TEST(Graph, AChainOfLevelsGoesDownAndUpInOneTransientTexture) {
    Frames frames(gpu);
    const Effect paint =
            effect(gpu, "", "result = vec4(float((int(gl_FragCoord.x) * 7 + int(gl_FragCoord.y) * 3) % 16));");
    const Effect down =
            effect(gpu, kInput,
                   "ivec2 at = 2 * ivec2(gl_FragCoord.xy);\n"
                   "result = 0.25 * (texelFetch(from, at, 0) + texelFetch(from, at + ivec2(1, 0), 0) +\n"
                   "                 texelFetch(from, at + ivec2(0, 1), 0) + texelFetch(from, at + ivec2(1, 1), 0));");
    const Effect show = effect(gpu, kInput, "result = texelFetch(from, ivec2(0), 0);");
    const TextureHandle target = gpu.target(Format::R32F, kSize, kSize);
    constexpr uint8_t kLevels = 6;
    FrameGraph& graph = frames.graph();
    const TextureId chain = graph.createTexture(pictureOf("chain", kLevels));
    const TextureId out = graph.importTexture(target, pictureOf("target"), framegraph::InitialContents::Undefined);
    graph.addPass(
            "paint", [&](PassBuilder& b) { b.writeColor(0, chain, { .overwrites = true }); }, paint.prepare({}),
            Effect::draw());
    for (uint8_t level = 1; level < kLevels; ++level) {
        const TextureRange above = oneLevel(static_cast<uint8_t>(level - 1));
        graph.addPass(
                "down",
                [&](PassBuilder& b) {
                    b.readSampled(chain, above);
                    b.writeColor(0, chain, { .overwrites = true, .level = level });
                },
                down.prepare(chain, above), Effect::draw());
    }
    graph.addPass(
            "show",
            [&](PassBuilder& b) {
                b.readSampled(chain, oneLevel(kLevels - 1));
                b.writeColor(0, out, { .overwrites = true });
            },
            show.prepare(chain, oneLevel(kLevels - 1)), Effect::draw());
    frames.run();
    float average = 0;
    for (uint32_t i = 0; i < kSize * kSize; ++i) average += static_cast<float>((i % kSize * 7 + i / kSize * 3) % 16);
    average /= kSize * kSize;
    for (const float value : gpu.readAs<float>(target, { 0, 0, kSize, kSize })) EXPECT_EQ(value, average);
}

DRIVER_TEST(Graph, AHistoryAccumulatesFromTheClearValueFrameByFrame) {
    Frames frames(gpu);
    const Effect accumulate =
            effect(gpu, kInput, "result = texelFetch(from, ivec2(gl_FragCoord.xy), 0) * 2.0 + gl_FragCoord.x;");
    const Effect show = effect(gpu, kInput, "result = texelFetch(from, ivec2(gl_FragCoord.xy), 0);");
    std::vector<uint32_t> ages;
    for (uint32_t frame = 0; frame < 4; ++frame) {
        const TextureHandle target = gpu.target(Format::R32F, kSize, kSize);
        FrameGraph& graph = frames.graph();
        const framegraph::History history = graph.history(pictureOf("sum"), { 3, 0, 0, 0 });
        const TextureId out = graph.importTexture(target, pictureOf("target"), framegraph::InitialContents::Undefined);
        graph.addPass(
                "accumulate",
                [&](PassBuilder& b) {
                    b.readSampled(history.previous);
                    b.writeColor(0, history.current, { .overwrites = true });
                },
                accumulate.prepare(history.previous),
                [&ages, history](PassContext& context, auto prepared) {
                    ages.push_back(context.historyAge(history.previous));
                    Effect::draw()(context, prepared);
                });
        graph.addPass(
                "show",
                [&](PassBuilder& b) {
                    b.readSampled(history.current);
                    b.writeColor(0, out, { .overwrites = true });
                },
                show.prepare(history.current), Effect::draw());
        frames.run();
        const auto texels = gpu.readAs<float>(target, { 0, 0, kSize, kSize });
        for (uint32_t i = 0; i < texels.size(); ++i) {
            const float x = static_cast<float>(i % kSize) + 0.5f;
            float expected = 3;
            for (uint32_t past = 0; past <= frame; ++past) expected = expected * 2 + x;
            EXPECT_EQ(texels[i], expected) << "frame " << frame << ", texel " << i;
        }
    }
    EXPECT_EQ(ages, (std::vector<uint32_t>{ 0, 1, 1, 1 }));
}

// Four samples of depth become one texture; a dispatch counts its values; a draw shows the counts.
DRIVER_TEST(Graph, ADispatchCountsResolvedDepthForADraw) {
    Frames frames(gpu);
    const Program ramp = gpu.program(
            kFullScreenVertex, "#version 450\nvoid main() { gl_FragDepth = float(int(gl_FragCoord.x) / 8) / 4.0; }");
    const Program count = gpu.computeProgram("#version 450\nlayout(local_size_x = 8, local_size_y = 8) in;\n"
                                             "layout(set = 0, binding = 0) uniform highp sampler2D depth;\n"
                                             "layout(set = 0, binding = 1, std430) buffer Bins { uint bins[]; };\n"
                                             "void main() {\n"
                                             "    float z = texelFetch(depth, ivec2(gl_GlobalInvocationID.xy), 0).x;\n"
                                             "    atomicAdd(bins[uint(z * 4.0)], 1u);\n"
                                             "}\n");
    const Program show = gpu.program(
            kFullScreenVertex, fragmentOf("layout(set = 1, binding = 0, std430) readonly buffer Bins { uint bins[]; };",
                                          "result = vec4(float(bins[int(gl_FragCoord.x) % 4]));"));
    const TextureHandle target = gpu.target(Format::R32F, kSize, kSize);
    const PipelineHandle counting = gpu.computePipeline(count);
    const SamplerHandle sampler = gpu.sampler();
    FrameGraph& graph = frames.graph();
    framegraph::GraphTextureDesc depthDesc = pictureOf("depth");
    depthDesc.format = Format::D32F;
    const TextureId depth = graph.createTexture(depthDesc);
    depthDesc.samples = 4;
    depthDesc.name = "depth of 4 samples";
    const TextureId samples = graph.createTexture(depthDesc);
    const BufferId bins = graph.createBuffer("bins", 16);
    const TextureId out = graph.importTexture(target, pictureOf("target"), framegraph::InitialContents::Undefined);
    graph.addPass(
            "depth", [&](PassBuilder& b) { b.writeDepth(samples, { .clear = 1.0f, .resolve = depth }); },
            [&](PassContext& context) {
                PipelineDesc desc = pipelineFor(ramp, context.passLayout());
                desc.depthStencil = { .depthCompare = CompareOp::Always, .depthWrite = true };
                return gpu.pipeline(desc);
            },
            [](PassContext& context, PipelineHandle pipeline) {
                context.commands().record(CmdBindPipeline{ pipeline });
                context.commands().record(CmdDraw{ .vertexCount = 3 });
            });
    graph.addPass(
            "clear bins", [&](PassBuilder& b) { b.writeBuffer(bins, BufferUse::Transfer, Previous::Overwrite); },
            [=](PassContext& context) {
                const std::array<std::byte, 16> zeros{};
                context.commands().record(CmdUpdateBuffer{ context.buffer(bins), 0, zeros });
            });
    graph.addPass(
            "count",
            [&](PassBuilder& b) {
                b.readSampled(depth);
                b.readBuffer(bins, BufferUse::Storage);
                b.writeBuffer(bins, BufferUse::Storage);
            },
            [&](PassContext& context) {
                const std::array entries{ BindGroupEntry{ .texture = context.texture(depth), .sampler = sampler },
                                          BindGroupEntry{ .binding = 1, .buffer = context.buffer(bins), .size = 16 } };
                const BindGroupHandle group = context.bindGroup(count.layout[0], entries, "count");
                context.commands().record(CmdBindPipeline{ counting });
                context.commands().record(CmdBindGroup{ .group = group });
                context.commands().record(CmdDispatch{ kSize / 8, kSize / 8, 1 });
            });
    graph.addPass(
            "show",
            [&](PassBuilder& b) {
                b.readBuffer(bins, BufferUse::Storage);
                b.writeColor(0, out, { .overwrites = true });
            },
            [&](PassContext& context) {
                const BindGroupEntry entry{ .buffer = context.buffer(bins), .size = 16 };
                return std::pair(gpu.pipeline(pipelineFor(show, context.passLayout())),
                                 context.bindGroup(show.layout[1], { &entry, 1 }, "show"));
            },
            [](PassContext& context, auto prepared) {
                context.commands().record(CmdBindPipeline{ prepared.first });
                context.commands().record(CmdBindGroup{ .group = prepared.second, .index = 1 });
                context.commands().record(CmdDraw{ .vertexCount = 3 });
            });
    frames.run();
    for (const float value : gpu.readAs<float>(target, { 0, 0, kSize, kSize })) EXPECT_EQ(value, kSize * kSize / 4);
}

DRIVER_TEST(Graph, FortyPassesHaveFortyTimes) {
    Frames frames(gpu);
    const Effect add = effect(gpu, kInput, "result = texelFetch(from, ivec2(gl_FragCoord.xy), 0) + 1.0;");
    const TextureHandle target = gpu.target(Format::R32F, kSize, kSize);
    FrameGraph& graph = frames.graph();
    TextureId from = graph.createTexture(pictureOf("start"));
    graph.addPass(
            "start", [&](PassBuilder& b) { b.writeColor(0, from, { .clear = std::array<float, 4>{} }); },
            [](PassContext&) {});
    for (int i = 1; i < 40; ++i) {
        const TextureId to =
                i == 39 ? graph.importTexture(target, pictureOf("target"), framegraph::InitialContents::Undefined)
                        : graph.createTexture(pictureOf("next"));
        graph.addPass(
                "add",
                [&](PassBuilder& b) {
                    b.readSampled(from);
                    b.writeColor(0, to, { .overwrites = true });
                },
                add.prepare(from), Effect::draw());
        from = to;
    }
    std::vector<framegraph::PassTimer> timers;
    frames.run(&timers);
    for (const float value : gpu.readAs<float>(target, { 0, 0, kSize, kSize })) EXPECT_EQ(value, 39);
    ASSERT_EQ(timers.size(), 40u);
    uint64_t sum = 0;
    for (framegraph::PassTimer const& timer : timers) sum += gpu.timerOf(timer.ticket);
    EXPECT_GT(sum, 0u);
}

} // namespace filament_core::backend
