// SPDX-License-Identifier: Apache-2.0
// Uploads, mips, blits, read-backs, and the order of transfers and draws.
#include "tests/backend/vulkan/DriverFixture.h"

#include <algorithm>

namespace filament_core::backend::vulkan {
namespace {

constexpr TextureUsage kTransferBoth = TextureUsage::TransferSource | TextureUsage::TransferTarget;

std::vector<Rgba8> gradient(uint32_t count, uint8_t start = 0) {
    std::vector<Rgba8> pixels(count);
    for (uint32_t i = 0; i < count; ++i) pixels[i] = { static_cast<uint8_t>(start + i), 1, 2, 3 };
    return pixels;
}

template <class T>
std::span<const std::byte> bytesOf(std::vector<T> const& values) {
    return std::as_bytes(std::span(values));
}

TEST_F(DriverTest, AnUploadReplacesExactlyItsRectangleOfItsLevelAndLayers) {
    const TextureHandle texture = makeTexture({ .type = TextureKind::Texture2DArray,
                                                .usage = TextureUsage::Sampled | kTransferBoth,
                                                .levels = 2,
                                                .layers = 3,
                                                .width = 8,
                                                .height = 4 });
    const std::vector<Rgba8> whole(4 * 2 * 3, Rgba8{ 9, 9, 9, 9 });
    commands.record(CmdUploadTexture{ texture, 1, 0, 3, { 0, 0, 4, 2 }, bytesOf(whole) });
    const std::vector<Rgba8> part = gradient(2 * 1 * 2);
    commands.record(CmdUploadTexture{ texture, 1, 1, 2, { 1, 1, 2, 1 }, bytesOf(part) });
    const Rgba8 nine{ 9, 9, 9, 9 };
    EXPECT_EQ(readPixels(texture, 4, 2, 1, 0), std::vector<Rgba8>(8, nine));
    EXPECT_EQ(readPixels(texture, 4, 2, 1, 1),
              (std::vector<Rgba8>{ nine, nine, nine, nine, nine, part[0], part[1], nine }));
    EXPECT_EQ(readPixels(texture, 4, 2, 1, 2),
              (std::vector<Rgba8>{ nine, nine, nine, nine, nine, part[2], part[3], nine }));
}

TEST_F(DriverTest, UploadsLargerThanTheStagingRingArriveWhole) {
    constexpr uint32_t kSide = 4096; // 64 MiB, twice the largest ring
    const TextureHandle texture = makeTexture({ .usage = kTransferBoth, .width = kSide, .height = kSide });
    std::vector<uint32_t> texels(size_t{ kSide } * kSide);
    for (size_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<uint32_t>(i * 2654435761u);
    commands.record(CmdUploadTexture{ texture, 0, 0, 1, { 0, 0, kSide, kSide }, bytesOf(texels) });
    const std::vector<std::byte> bytes = read(texture, kSide, kSide);
    ASSERT_EQ(bytes.size(), texels.size() * 4);
    EXPECT_EQ(std::memcmp(bytes.data(), texels.data(), bytes.size()), 0);
}

TEST_F(DriverTest, ManyUploadsInOneStreamOutgrowTheRingWithoutMixingUp) {
    constexpr uint32_t kCount = 40,
                       kSide = 512; // 1 MiB each: the ring grows from 4 to 32 MiB, then buffers of their own
    std::vector<TextureHandle> textures;
    for (uint32_t i = 0; i < kCount; ++i) {
        textures.push_back(makeTexture({ .usage = kTransferBoth, .width = kSide, .height = kSide }));
        const std::vector<uint32_t> texels(size_t{ kSide } * kSide, i);
        commands.record(CmdUploadTexture{ textures[i], 0, 0, 1, { 0, 0, kSide, kSide }, bytesOf(texels) });
    }
    for (uint32_t i = 0; i < kCount; ++i) {
        EXPECT_EQ(readPixels(textures[i], 1, 1)[0], (Rgba8{ static_cast<uint8_t>(i), 0, 0, 0 }));
    }
}

TEST_F(DriverTest, MipsAreTwoByTwoAveragesInEveryLayer) {
    const TextureHandle texture = makeTexture({ .type = TextureKind::Cube,
                                                .usage = TextureUsage::Sampled | kTransferBoth,
                                                .levels = 3,
                                                .layers = 6,
                                                .width = 4,
                                                .height = 4 });
    std::vector<Rgba8> texels(4 * 4 * 6);
    for (uint32_t i = 0; i < texels.size(); ++i) {
        const uint32_t x = i % 4, y = i / 4 % 4, face = i / 16;
        texels[i] = { static_cast<uint8_t>(x * 40), static_cast<uint8_t>(y * 40), static_cast<uint8_t>(face * 40),
                      255 };
    }
    commands.record(CmdUploadTexture{ texture, 0, 0, 6, { 0, 0, 4, 4 }, bytesOf(texels) });
    commands.record(CmdGenerateMips{ texture });
    for (uint16_t face = 0; face < 6; ++face) {
        const auto blue = static_cast<uint8_t>(face * 40);
        EXPECT_EQ(readPixels(texture, 2, 2, 1, face), (std::vector<Rgba8>{ { 20, 20, blue, 255 },
                                                                           { 100, 20, blue, 255 },
                                                                           { 20, 100, blue, 255 },
                                                                           { 100, 100, blue, 255 } }));
        EXPECT_EQ(readPixels(texture, 1, 1, 2, face), (std::vector<Rgba8>{ { 60, 60, blue, 255 } }));
    }
}

TEST_F(DriverTest, ABlitScalesIntoItsRectangleAndLeavesTheRest) {
    const TextureHandle source = makeTexture({ .usage = kTransferBoth, .width = 2, .height = 1 });
    const TextureHandle target = makeTexture({ .usage = kTransferBoth, .width = 6, .height = 1 });
    const std::vector<Rgba8> two = gradient(2, 50), six = gradient(6);
    commands.record(CmdUploadTexture{ source, 0, 0, 1, { 0, 0, 2, 1 }, bytesOf(two) });
    commands.record(CmdUploadTexture{ target, 0, 0, 1, { 0, 0, 6, 1 }, bytesOf(six) });
    commands.record(
            CmdBlit{ .source = source, .target = target, .sourceRect = { 0, 0, 2, 1 }, .targetRect = { 1, 0, 4, 1 } });
    EXPECT_EQ(readPixels(target, 6, 1), (std::vector<Rgba8>{ six[0], two[0], two[0], two[1], two[1], six[5] }));
}

TEST_F(DriverTest, NothingIsEncodedToSrgb) {
    const TextureHandle image =
            makeTexture({ .format = Format::RGBA8Srgb, .usage = kTransferBoth, .levels = 2, .width = 2, .height = 1 });
    const TextureHandle plain = makeTexture({ .usage = kTransferBoth, .width = 2, .height = 1 });
    const std::vector<Rgba8> level0 = gradient(2, 50), level1{ { 1, 2, 3, 4 } };
    commands.record(CmdUploadTexture{ image, 0, 0, 1, { 0, 0, 2, 1 }, bytesOf(level0) });
    commands.record(CmdUploadTexture{ image, 1, 0, 1, { 0, 0, 1, 1 }, bytesOf(level1) });
    commands.record(CmdUploadTexture{ plain, 0, 0, 1, { 0, 0, 2, 1 }, bytesOf(level0) });
    commands.record(CmdGenerateMips{ image });
    commands.record(CmdBlit{ .source = plain,
                             .target = image,
                             .targetLevel = 1,
                             .sourceRect = { 0, 0, 2, 1 },
                             .targetRect = { 0, 0, 1, 1 } });
    EXPECT_EQ(readPixels(image, 1, 1, 1), level1);
    ASSERT_EQ(sink.errors.size(), 2u);
    EXPECT_NE(sink.errors[0].message.find("mips of texture"), std::string::npos) << sink.errors[0].message;
    EXPECT_NE(sink.errors[1].message.find("blit of texture"), std::string::npos) << sink.errors[1].message;
    for (auto const& error : sink.errors)
        EXPECT_NE(error.message.find("would let the driver encode RGBA8Srgb"), std::string::npos) << error.message;
}

class UpdateTest : public DriverTest {
protected:
    /// Draws the uniform buffer's first value into pixel `x` of `target`.
    void drawValue(int32_t x) {
        PassDesc pass{ .layout = colorLayout(Format::R32F), .area = { x, 0, 1, 1 } };
        pass.colors[0] = { .texture = target, .load = x == 0 ? LoadOp::Clear : LoadOp::Load };
        commands.record(CmdBeginPass{ pass });
        commands.record(CmdBindPipeline{ pipeline });
        commands.record(CmdBindGroup{ .group = group, .index = 0 });
        commands.record(CmdDraw{ .vertexCount = 3 });
        endPass();
    }
    void update(float value, uint64_t offset = 0) {
        commands.record(CmdUpdateBuffer{ uniforms, offset, std::as_bytes(std::span(&value, 1)) });
    }
    void prepare() {
        ProgramLayout layout;
        layout[0].bindings[0] = { .binding = 0, .type = BindingType::UniformBuffer };
        layout[0].count = 1;
        const ProgramHandle program = makeProgram(kFullScreenVertex, R"(
            layout(set = 0, binding = 0) uniform Block { vec4 value; };
            layout(location = 0) out float color;
            void main() { color = value.x + value.y; })",
                                                  layout);
        pipeline = makePipeline(
                { .program = program, .pass = colorLayout(Format::R32F), .raster = { .cull = CullMode::None } });
        uniforms = makeBuffer(BufferUsage::Uniform, std::vector<float>{ 1, 0, 0, 0 });
        group = makeGroup(layout[0], { { .binding = 0, .buffer = uniforms, .size = 16 } });
        target = makeTarget(4, 1, Format::R32F);
    }

    PipelineHandle pipeline;
    BufferHandle uniforms;
    BindGroupHandle group;
    TextureHandle target;
};

TEST_F(UpdateTest, EachDrawSeesTheUpdatesRecordedBeforeItAndNoLaterOne) {
    prepare();
    drawValue(0);
    update(2);
    drawValue(1);
    update(3);
    update(4); // overlaps the one before: the later one wins
    drawValue(2);
    update(5);
    update(0.5f, 4); // beside it
    drawValue(3);
    EXPECT_EQ(readFloats(target, 4, 1), (std::vector<float>{ 1, 2, 4, 5.5f }));
}

TEST_F(UpdateTest, UpdatesInLaterStreamsDoNotReachEarlierDraws) {
    prepare();
    for (int32_t x = 0; x < 4; ++x) {
        update(static_cast<float>(10 + x));
        drawValue(x);
        replay(); // submitted, not waited for
    }
    EXPECT_EQ(readFloats(target, 4, 1), (std::vector<float>{ 10, 11, 12, 13 }));
}

class DepthReadTest : public DriverTest, public ::testing::WithParamInterface<Format> {};

TEST_P(DepthReadTest, DepthIsReadBackAsFloats) {
    PassDesc pass{ .area = { 0, 0, 2, 2 } };
    pass.layout.depthFormat = GetParam();
    pass.depth = { .texture = makeTarget(2, 2, GetParam()), .clear = { 0.25f, 0, 0, 0 } };
    commands.record(CmdBeginPass{ pass });
    endPass();
    const std::vector<float> depths = readFloats(pass.depth.texture, 2, 2);
    ASSERT_EQ(depths.size(), 4u);
    const float tolerance = GetParam() == Format::D16 ? 0.5f / 65535.0f : 0.0f;
    for (float depth : depths) EXPECT_NEAR(depth, 0.25f, tolerance);
}

INSTANTIATE_TEST_SUITE_P(AllDepthFormats, DepthReadTest, ::testing::Values(Format::D16, Format::D32F, Format::D32FS8),
                         [](auto const& format) { return formatInfo(format.param).name; });

TEST_F(DriverTest, ADepthTextureIsSampledThroughACompareSampler) {
    ProgramLayout layout;
    layout[0].bindings[0] = { .binding = 3, .type = BindingType::SampledTexture, .stages = ShaderStage::Fragment };
    layout[0].count = 1;
    const ProgramHandle program = makeProgram(kFullScreenVertex, R"(
        layout(set = 0, binding = 3) uniform sampler2DShadow shadow;
        layout(location = 0) out vec4 color;
        void main() { color = vec4(texture(shadow, vec3(0.5, 0.5, 0.3)), texture(shadow, vec3(0.5, 0.5, 0.7)), 0.0, 1.0); })",
                                              layout);
    const PipelineHandle pipeline =
            makePipeline({ .program = program, .pass = colorLayout(), .raster = { .cull = CullMode::None } });
    const auto sampler = handle<SamplerHandle>();
    commands.record(CmdCreateSampler{ sampler, { .magFilter = Filter::Linear, .compare = CompareOp::GreaterEqual } });
    const TextureHandle depth = makeTarget(2, 2, Format::D32F), target = makeTarget(1, 1);
    const BindGroupHandle group = makeGroup(layout[0], { { .binding = 3, .texture = depth, .sampler = sampler } });
    PassDesc pass{ .area = { 0, 0, 2, 2 } };
    pass.layout.depthFormat = Format::D32F;
    pass.depth = { .texture = depth, .clear = { 0.5f, 0, 0, 0 } };
    commands.record(CmdBeginPass{ pass });
    endPass();
    beginPass(target, 1, 1);
    commands.record(CmdBindPipeline{ pipeline });
    commands.record(CmdBindGroup{ .group = group, .index = 0 });
    commands.record(CmdDraw{ .vertexCount = 3 });
    endPass();
    EXPECT_EQ(readPixels(target, 1, 1)[0], (Rgba8{ 0, 255, 0, 255 })); // 0.3 >= 0.5 no, 0.7 >= 0.5 yes
}

TEST_F(DriverTest, AnEmptyRectangleIsReadBackAsNoBytes) {
    const TextureHandle texture = makeTarget(1, 1);
    EXPECT_TRUE(read(texture, 0, 0).empty());
}

} // namespace
} // namespace filament_core::backend::vulkan
