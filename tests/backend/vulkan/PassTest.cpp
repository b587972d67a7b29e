// SPDX-License-Identifier: Apache-2.0
// Load and store operations, merged passes, resolves, and textures that alternate between attachment and sampled.
#include "tests/backend/vulkan/DriverFixture.h"

namespace filament_core::backend::vulkan {
namespace {

TEST_F(DriverTest, LoadKeepsWhatIsOutsideTheAreaAndInside) {
    const TextureHandle target = makeTarget(3, 1);
    beginPass(target, 3, 1, { 1, 0, 0, 1 });
    endPass();
    PassDesc pass{ .layout = colorLayout(), .area = { 1, 0, 1, 1 } };
    pass.colors[0] = { .texture = target, .load = LoadOp::Load };
    commands.record(CmdBeginPass{ pass });
    endPass();
    EXPECT_EQ(readPixels(target, 3, 1), std::vector<Rgba8>(3, kRed));
}

class MergedPassTest : public DriverTest {
protected:
    /// Subpass 0 writes (0.25, 0.5, 0, 1) as half floats; subpass 1 reads it at its pixel and writes twice as much.
    std::vector<Rgba8> drawMerged(TextureUsage hdrUsage, StoreOp hdrStore) {
        PassLayout layout;
        layout.colorFormats = { Format::RGBA16F, Format::RGBA8 };
        layout.colorCount = 2;
        layout.depthFormat = Format::D32F;
        layout.subpassCount = 2;
        layout.subpasses[0] = { .colorMask = 0b01 };
        layout.subpasses[1] = { .colorMask = 0b10, .inputMask = 0b01, .usesDepth = false };
        ProgramLayout groups;
        groups[0].bindings[0] = { .binding = 0, .type = BindingType::InputAttachment, .inputAttachment = 0 };
        groups[0].count = 1;
        const ProgramHandle first = makeProgram(kFullScreenVertex, R"(
            layout(location = 0) out vec4 color;
            void main() { color = vec4(gl_FragCoord.x * 0.5, 0.5, 0.0, 1.0); })"); // 0.25, 0.75
        const ProgramHandle second = makeProgram(kFullScreenVertex, R"(
            layout(input_attachment_index = 0, set = 0, binding = 0) uniform subpassInput hdr;
            layout(location = 1) out vec4 color;
            void main() { color = subpassLoad(hdr) * vec4(0.8, 2.0, 1.0, 1.0); })",
                                                 groups);
        const PipelineHandle write = makePipeline({ .program = first, .pass = layout, .raster = kNoCulling });
        const PipelineHandle tonemap =
                makePipeline({ .program = second, .pass = layout, .subpass = 1, .raster = kNoCulling });

        hdr = makeTexture(
                { .format = Format::RGBA16F, .usage = hdrUsage, .width = 2, .height = 1, .debugName = "hdr" });
        const TextureHandle ldr = makeTarget(2, 1), depth = makeTarget(2, 1, Format::D32F);
        const BindGroupHandle input = makeGroup(groups[0], { { .binding = 0, .texture = hdr } });
        PassDesc pass{ .layout = layout, .area = { 0, 0, 2, 1 }, .debugName = "merged" };
        pass.colors[0] = { .texture = hdr, .store = hdrStore };
        pass.colors[1] = { .texture = ldr };
        pass.depth = { .texture = depth, .store = StoreOp::Discard };
        commands.record(CmdBeginPass{ pass });
        commands.record(CmdBindPipeline{ write });
        commands.record(CmdDraw{ .vertexCount = 3 });
        commands.record(CmdNextSubpass{});
        commands.record(CmdBindPipeline{ tonemap });
        commands.record(CmdBindGroup{ .group = input, .index = 0 });
        commands.record(CmdDraw{ .vertexCount = 3 });
        endPass();
        return readPixels(ldr, 2, 1);
    }

    TextureHandle hdr;
    const std::vector<Rgba8> kExpected{ { 51, 255, 0, 255 }, { 153, 255, 0, 255 } }; // 255 * 0.8 * (0.25, 0.75)
};

TEST_F(MergedPassTest, ALaterSubpassReadsThePixelThatAnEarlierOneWrote) {
    const TextureUsage transient =
            TextureUsage::ColorAttachment | TextureUsage::InputAttachment | TextureUsage::Transient;
    EXPECT_EQ(drawMerged(transient, StoreOp::Discard), kExpected);
}

TEST_F(MergedPassTest, WhatASubpassReadCanBeReadBackAfterwards) {
    const TextureUsage kept = TextureUsage::ColorAttachment | TextureUsage::InputAttachment | TextureUsage::Sampled |
                              TextureUsage::TransferSource;
    EXPECT_EQ(drawMerged(kept, StoreOp::Store), kExpected);
    const std::vector<std::byte> bytes = read(hdr, 1, 1);
    const std::array<uint16_t, 4> quarterHalfZeroOne{ 0x3400, 0x3800, 0, 0x3C00 };
    ASSERT_EQ(bytes.size(), sizeof quarterHalfZeroOne);
    EXPECT_EQ(std::memcmp(bytes.data(), quarterHalfZeroOne.data(), bytes.size()), 0);
}

TEST_F(DriverTest, AResolveAveragesTheSamplesOfAnEdge) {
    const ProgramHandle program = makeProgram(R"(
        void main() { // covers the left half of the only pixel
            vec2 corner = vec2(gl_VertexIndex == 1 ? 0.0 : -1.0, gl_VertexIndex == 2 ? 3.0 : -1.0);
            gl_Position = vec4(gl_VertexIndex == 1 ? 0.0 : (gl_VertexIndex == 2 ? 0.0 : -9.0), gl_VertexIndex == 1 ? -9.0 :
                    (gl_VertexIndex == 2 ? 9.0 : 0.0), 0.5, 1.0);
        })",
                                              kRedFragment);
    PassLayout layout = colorLayout();
    layout.samples = 4;
    layout.resolveMask = 1;
    const PipelineHandle pipeline = makePipeline({ .program = program, .pass = layout, .raster = kNoCulling });
    const TextureHandle multi = makeTexture(
            { .usage = TextureUsage::ColorAttachment | TextureUsage::Transient, .samples = 4, .debugName = "4x" });
    const TextureHandle resolved = makeTarget(1, 1);
    PassDesc pass{ .layout = layout, .area = { 0, 0, 1, 1 } };
    pass.colors[0] = { .texture = multi, .store = StoreOp::Discard, .resolve = resolved };
    commands.record(CmdBeginPass{ pass });
    commands.record(CmdBindPipeline{ pipeline });
    commands.record(CmdDraw{ .vertexCount = 3 });
    endPass();
    EXPECT_EQ(readPixels(resolved, 1, 1)[0], (Rgba8{ 128, 0, 0, 128 })); // two of four samples
}

class FeedbackTest : public DriverTest {
protected:
    void SetUp() override {
        DriverTest::SetUp();
        if (IsSkipped()) return;
        ProgramLayout layout;
        layout[0].bindings[0] = { .binding = 0, .type = BindingType::SampledTexture };
        layout[0].count = 1;
        groupLayout = layout[0];
        const ProgramHandle program = makeProgram(kFullScreenVertex, R"(
            layout(set = 0, binding = 0) uniform sampler2D source;
            layout(location = 0) out vec4 color;
            void main() { color = textureLod(source, vec2(0.5), 0.0) + vec4(1.0 / 255.0); })",
                                                  layout);
        pipeline = makePipeline({ .program = program, .pass = colorLayout(), .raster = kNoCulling });
        sampler = handle<SamplerHandle>();
        commands.record(CmdCreateSampler{ sampler, {} });
    }

    /// target = source + 1.
    void addOne(BindGroupHandle source, TextureHandle target) {
        beginPass(target, 1, 1);
        commands.record(CmdBindPipeline{ pipeline });
        commands.record(CmdBindGroup{ .group = source, .index = 0 });
        commands.record(CmdDraw{ .vertexCount = 3 });
        endPass();
    }

    BindGroupLayout groupLayout;
    PipelineHandle pipeline;
    SamplerHandle sampler;
};

TEST_F(FeedbackTest, TwoTexturesTakeTurnsAsSourceAndTarget) {
    const std::array textures{ makeTarget(1, 1), makeTarget(1, 1) };
    std::array<BindGroupHandle, 2> groups;
    for (size_t i = 0; i < 2; ++i) {
        groups[i] = makeGroup(groupLayout, { { .binding = 0, .texture = textures[i], .sampler = sampler } });
    }
    beginPass(textures[0], 1, 1);
    endPass();
    for (size_t round = 0; round < 20; ++round) addOne(groups[round % 2], textures[(round + 1) % 2]);
    EXPECT_EQ(readPixels(textures[0], 1, 1)[0], (Rgba8{ 20, 20, 20, 20 }));
}

TEST_F(FeedbackTest, ATextureThatNothingHasWrittenMayBeSampled) {
    const TextureHandle empty = makeTarget(1, 1), target = makeTarget(1, 1);
    const BindGroupHandle group = makeGroup(groupLayout, { { .binding = 0, .texture = empty, .sampler = sampler } });
    addOne(group, target);
    EXPECT_EQ(readPixels(target, 1, 1).size(), 1u); // any value; validation must stay silent
}

TEST_F(FeedbackTest, LevelsRenderedOneByOneAreSampledTogetherLater) {
    const TextureHandle chain = makeTexture({ .usage = TextureUsage::Sampled | TextureUsage::ColorAttachment,
                                              .levels = 3,
                                              .width = 4,
                                              .height = 4,
                                              .debugName = "chain" });
    for (uint8_t level = 0; level < 3; ++level) {
        PassDesc pass{ .layout = colorLayout(), .area = { 0, 0, 4u >> level, 4u >> level } };
        pass.colors[0] = { .texture = chain, .level = level, .clear = { 0.2f, 0, 0, 0 } };
        commands.record(CmdBeginPass{ pass });
        endPass();
    }
    const TextureHandle target = makeTarget(1, 1);
    addOne(makeGroup(groupLayout, { { .binding = 0, .texture = chain, .sampler = sampler } }), target);
    EXPECT_EQ(readPixels(target, 1, 1)[0], (Rgba8{ 52, 1, 1, 1 }));
}

} // namespace
} // namespace filament_core::backend::vulkan
