// SPDX-License-Identifier: Apache-2.0
// Texels in and out: uploads, read-backs, blits, mip chains.
#include "backend/gles/Repack.h"
#include "tests/backend/gles/GlesFixture.h"

#include <bit>
#include <cmath>

namespace filament_core::backend::gles {
namespace {

using Rgba = std::array<uint8_t, 4>;

DeviceTextureDesc copyable(Format format, uint32_t width, uint32_t height, uint8_t levels = 1) {
    DeviceTextureDesc desc;
    desc.format = format;
    desc.usage = TextureUsage::Sampled | TextureUsage::TransferTarget | TextureUsage::TransferSource;
    desc.width = width;
    desc.height = height;
    desc.levels = levels;
    return desc;
}

/// Bytes that are valid texels in every format: no NaN, no infinity.
std::vector<std::byte> pattern(size_t count) {
    std::vector<std::byte> bytes(count);
    for (size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::byte>((i * 37 + 11) & 0x3F);
    return bytes;
}

class FormatTest : public GlesTest, public testing::WithParamInterface<Format> {};

TEST_P(FormatTest, AnUploadReadsBackByteForByte) {
    constexpr uint32_t kWidth = 5, kHeight = 3; // rows that no alignment suits
    const TextureHandle image = texture(copyable(GetParam(), kWidth, kHeight));
    const std::vector<std::byte> bytes = pattern(imageBytes(GetParam(), kWidth, kHeight));
    commands.record(CmdUploadTexture{ .texture = image, .rect = { 0, 0, kWidth, kHeight }, .bytes = bytes });
    EXPECT_EQ(read<std::byte>(image, { 0, 0, kWidth, kHeight }), bytes);
}

INSTANTIATE_TEST_SUITE_P(Renderable, FormatTest,
                         testing::Values(Format::R8, Format::RG8, Format::RGBA8, Format::RGBA8Srgb, Format::R8UI,
                                         Format::R32UI, Format::RG32UI, Format::RGBA8UI, Format::RGB10A2, Format::R16F,
                                         Format::RG16F, Format::RGBA16F, Format::R32F, Format::RG32F, Format::RGBA32F,
                                         Format::R11G11B10F),
                         [](auto const& tested) { return std::string(formatInfo(tested.param).name); });

TEST_F(GlesTest, AnUploadReplacesItsRectangleOfItsLayersOnly) {
    DeviceTextureDesc desc = copyable(Format::R8, 4, 2);
    desc.type = TextureKind::Texture2DArray;
    desc.layers = 3;
    const TextureHandle image = texture(desc);
    const std::vector<uint8_t> zeros(24, 0), ones{ 1, 2, 3, 4 };
    commands.record(
            CmdUploadTexture{ .texture = image, .layerCount = 3, .rect = { 0, 0, 4, 2 }, .bytes = bytesOf(zeros) });
    commands.record(CmdUploadTexture{
            .texture = image, .layer = 1, .layerCount = 2, .rect = { 2, 1, 2, 1 }, .bytes = bytesOf(ones) });
    EXPECT_EQ(read<uint8_t>(image, { 0, 0, 4, 2 }, 0, 0), (std::vector<uint8_t>{ 0, 0, 0, 0, 0, 0, 0, 0 }));
    EXPECT_EQ(read<uint8_t>(image, { 0, 0, 4, 2 }, 0, 1), (std::vector<uint8_t>{ 0, 0, 0, 0, 0, 0, 1, 2 }));
    EXPECT_EQ(read<uint8_t>(image, { 2, 1, 2, 1 }, 0, 2), (std::vector<uint8_t>{ 3, 4 }));
}

class DepthReadTest : public GlesTest, public testing::WithParamInterface<Format> {};

TEST_P(DepthReadTest, DepthReadsAsFloatsWithAndWithoutTheExtension) {
    for (QuirkFilter filter : { QuirkFilter{}, QuirkFilter{ [](Quirks& quirks) { quirks.readDepth = false; } } }) {
        start(filter);
        DeviceTextureDesc desc = copyable(GetParam(), 2, 2);
        desc.type = TextureKind::Texture2DArray;
        desc.usage = TextureUsage::DepthAttachment | TextureUsage::TransferSource;
        desc.layers = 2;
        const TextureHandle depth = texture(desc);
        for (uint16_t layer = 0; layer < 2; ++layer) {
            PassDesc pass;
            pass.layout.depthFormat = GetParam();
            pass.depth.texture = depth;
            pass.depth.layer = layer;
            pass.depth.clear = { 0.25f };
            pass.area = { 0, 0, 2, 2 };
            commands.record(CmdBeginPass{ pass });
            commands.record(CmdEndPass{});
            pass.depth.clear = { layer == 1 ? 1.0f : 0.0f };
            pass.area = { 1, 0, 1, 1 };
            commands.record(CmdBeginPass{ pass });
            commands.record(CmdEndPass{});
        }
        // The nearest 16-bit value of 0.25 is 16384 / 65535.
        const float quarter = GetParam() == Format::D16 ? 16384.0f / 65535.0f : 0.25f;
        EXPECT_EQ(read<float>(depth, { 0, 0, 2, 2 }, 0, 0), (std::vector<float>{ quarter, 0, quarter, quarter }));
        EXPECT_EQ(read<float>(depth, { 0, 0, 2, 1 }, 0, 1), (std::vector<float>{ quarter, 1 }));
    }
}

INSTANTIATE_TEST_SUITE_P(Depth, DepthReadTest, testing::Values(Format::D16, Format::D32F, Format::D32FS8),
                         [](auto const& tested) { return std::string(formatInfo(tested.param).name); });

TEST_F(GlesTest, AMipLevelIsTheBoxAverageOfTheLevelAbove) {
    const TextureHandle image = texture(copyable(Format::RGBA8, 4, 2, 3));
    const auto grey = [](uint8_t v) { return Rgba{ v, v, v, 255 }; };
    const std::vector<Rgba> level0{ grey(0), grey(40), grey(100), grey(100), grey(80), grey(120), grey(200), grey(0) };
    commands.record(CmdUploadTexture{ .texture = image, .rect = { 0, 0, 4, 2 }, .bytes = bytesOf(level0) });
    commands.record(CmdGenerateMips{ image });
    EXPECT_EQ(read<Rgba>(image, { 0, 0, 2, 1 }, 1), (std::vector<Rgba>{ grey(60), grey(100) }));
    EXPECT_EQ(read<Rgba>(image, { 0, 0, 1, 1 }, 2), (std::vector<Rgba>{ grey(80) }));
}

TEST_F(GlesTest, NothingIsEncodedToSrgb) {
    const TextureHandle image = texture(copyable(Format::RGBA8Srgb, 2, 1, 2)),
                        plain = texture(copyable(Format::RGBA8, 2, 1));
    const std::vector<Rgba> level0{ { 255, 0, 0, 255 }, { 0, 9, 0, 255 } }, level1{ { 1, 2, 3, 4 } };
    commands.record(CmdUploadTexture{ .texture = image, .rect = { 0, 0, 2, 1 }, .bytes = bytesOf(level0) });
    commands.record(CmdUploadTexture{ .texture = image, .level = 1, .rect = { 0, 0, 1, 1 }, .bytes = bytesOf(level1) });
    commands.record(CmdUploadTexture{ .texture = plain, .rect = { 0, 0, 2, 1 }, .bytes = bytesOf(level0) });
    commands.record(CmdGenerateMips{ image });
    EXPECT_EQ(read<Rgba>(image, { 0, 0, 1, 1 }, 1), level1);
    expectError(DriverErrorKind::Other, "generating mips would let the driver encode RGBA8Srgb");
    commands.record(CmdBlit{ .source = plain,
                             .target = image,
                             .targetLevel = 1,
                             .sourceRect = { 0, 0, 2, 1 },
                             .targetRect = { 0, 0, 1, 1 } });
    EXPECT_EQ(read<Rgba>(image, { 0, 0, 1, 1 }, 1), level1);
    expectError(DriverErrorKind::Other, "a blit would let the driver encode RGBA8Srgb");
}

TEST_F(GlesTest, EveryLayerGetsItsOwnMipLevels) {
    DeviceTextureDesc desc = copyable(Format::R32F, 2, 2, 2);
    desc.type = TextureKind::Cube;
    desc.layers = 6;
    const TextureHandle cube = texture(desc);
    std::vector<float> faces;
    for (int face = 0; face < 6; ++face) {
        for (int i = 0; i < 4; ++i) faces.push_back(static_cast<float>(face * 10 + i));
    }
    commands.record(
            CmdUploadTexture{ .texture = cube, .layerCount = 6, .rect = { 0, 0, 2, 2 }, .bytes = bytesOf(faces) });
    commands.record(CmdGenerateMips{ cube });
    for (uint16_t face = 0; face < 6; ++face) {
        EXPECT_EQ(read<float>(cube, { 0, 0, 1, 1 }, 1, face).at(0), static_cast<float>(face) * 10 + 1.5f);
    }
}

TEST_F(GlesTest, ABlitScalesWithTheFilterThatItNames) {
    const TextureHandle source = texture(copyable(Format::R32F, 2, 1)), target = texture(copyable(Format::R32F, 4, 2));
    const std::vector<float> texels{ 0, 8 };
    commands.record(CmdUploadTexture{ .texture = source, .rect = { 0, 0, 2, 1 }, .bytes = bytesOf(texels) });
    CmdBlit blit{ .source = source, .target = target, .sourceRect = { 0, 0, 2, 1 }, .targetRect = { 0, 1, 4, 1 } };
    commands.record(blit);
    EXPECT_EQ(read<float>(target, { 0, 1, 4, 1 }), (std::vector<float>{ 0, 0, 8, 8 }));
    blit.filter = Filter::Linear; // sampled at 0.25, 0.75, 1.25, 1.75 of texels centred at 0.5 and 1.5
    commands.record(blit);
    EXPECT_EQ(read<float>(target, { 0, 1, 4, 1 }), (std::vector<float>{ 0, 2, 6, 8 }));
}

TEST_F(GlesTest, ACompressedTextureSamplesItsBlocks) {
    ASSERT_TRUE(driver->info().features.blockCompression);
    // BC1: both end points pure red (5:6:5), every index 0.
    const std::vector<uint8_t> block{ 0x00, 0xF8, 0x00, 0xF8, 0, 0, 0, 0 };
    DeviceTextureDesc desc;
    desc.format = Format::BC1;
    desc.usage = TextureUsage::Sampled | TextureUsage::TransferTarget;
    desc.width = desc.height = 4;
    const TextureHandle red = texture(desc), image = target(Format::RGBA8, 2, 2);
    commands.record(CmdUploadTexture{ .texture = red, .rect = { 0, 0, 4, 4 }, .bytes = bytesOf(block) });
    const SamplerHandle sampler = samplers.allocate();
    commands.record(CmdCreateSampler{ sampler, {} });
    ProgramLayout layout;
    layout[0].bindings[0] = { .binding = 0, .type = BindingType::SampledTexture };
    layout[0].count = 1;
    constexpr std::string_view kFragment = R"(#version 310 es
        precision highp float;
        layout(binding = 0) uniform sampler2D image;
        layout(location = 0) out vec4 color;
        void main() { color = texture(image, gl_FragCoord.xy / 2.0); })";
    const PassDesc pass = colorPass(image, Format::RGBA8, 2, 2);
    const PipelineHandle drawing = simplePipeline(program(kFullScreenVertex, kFragment, layout), pass.layout);
    BindGroupEntry entry;
    entry.texture = red;
    entry.sampler = sampler;
    const BindGroupHandle group = bindGroup(layout[0], { entry });
    commands.record(CmdBeginPass{ pass });
    commands.record(CmdBindPipeline{ drawing });
    commands.record(CmdBindGroup{ .group = group });
    commands.record(CmdDraw{ .vertexCount = 3 });
    commands.record(CmdEndPass{});
    EXPECT_EQ(read<Rgba>(image, { 0, 0, 2, 2 }), std::vector<Rgba>(4, Rgba{ 255, 0, 0, 255 }));
}

TEST_F(GlesTest, AFormatThatCannotBeReadIsReportedAndItsAnswerIsEmpty) {
    const TextureHandle image = texture(copyable(Format::RGB9E5, 1, 1));
    EXPECT_TRUE(read<uint32_t>(image, { 0, 0, 1, 1 }).empty());
    expectError(DriverErrorKind::Other, "RGB9E5");
}

TEST_F(GlesTest, ReadbacksOfMissingObjectsAreAnsweredInTheirTurn) {
    commands.record(CmdReadBuffer{ .buffer = BufferHandle::make(900, 1), .size = 16, .ticket = { 71 } });
    commands.record(CmdReadTexture{ .texture = TextureHandle::make(900, 1), .rect = { 0, 0, 1, 1 }, .ticket = { 72 } });
    run();
    driver->waitIdle();
    ASSERT_EQ(sink.readbacks.size(), 2u);
    EXPECT_TRUE(sink.readbacks[71].empty());
    EXPECT_TRUE(sink.readbacks[72].empty());
}

TEST_F(GlesTest, ADeviceWithoutBlockCompressionRefusesItByName) {
    start([](Quirks& quirks) { quirks.blockCompression = false; });
    EXPECT_FALSE(driver->info().features.blockCompression);
    texture(copyable(Format::BC7, 4, 4));
    run();
    expectError(DriverErrorKind::Other, "BC7");
}

TEST_F(GlesTest, ADeviceThatAlwaysEncodesHasNoSrgbAttachmentsAndSaysSo) {
    const DeviceTextureDesc sampled = copyable(Format::RGBA8Srgb, 2, 1);
    DeviceTextureDesc drawn = sampled;
    drawn.usage = drawn.usage | TextureUsage::ColorAttachment;
    drawn.debugName = "mirror";
    EXPECT_TRUE(driver->info().features.srgbAttachments);
    texture(drawn);
    run();
    EXPECT_TRUE(sink.errors.empty());
    start([](Quirks& quirks) { quirks.srgbWriteControl = false; });
    EXPECT_FALSE(driver->info().features.srgbAttachments);
    texture(drawn);
    run();
    expectError(DriverErrorKind::Other, "texture 'mirror': this device encodes what passes write to RGBA8Srgb");
    const std::vector<Rgba> codes{ { 1, 2, 3, 4 }, { 200, 100, 50, 25 } };
    const TextureHandle image = texture(sampled), light = texture(copyable(Format::RGBA32F, 2, 1));
    commands.record(CmdUploadTexture{ .texture = image, .rect = { 0, 0, 2, 1 }, .bytes = bytesOf(codes) });
    commands.record(
            CmdBlit{ .source = image, .target = light, .sourceRect = { 0, 0, 2, 1 }, .targetRect = { 0, 0, 2, 1 } });
    EXPECT_EQ(read<Rgba>(image, { 0, 0, 2, 1 }), codes);
    EXPECT_NEAR(read<float>(light, { 0, 0, 2, 1 }).at(4), 0.5776f, 2e-3f) << "still decoded by blits";
}

// ---------------------------------------------------------------------------------------------- repack

// IEEE 754 binary16, from its definition: (-1)^s 2^(e-15) (1 + m / 1024), denormal below e = 1.
float floatFromHalf(uint16_t bits) {
    const int exponent = (bits >> 10) & 31, mantissa = bits & 1023;
    const float sign = bits & 0x8000 ? -1.0f : 1.0f;
    if (exponent == 31) return mantissa ? std::numeric_limits<float>::quiet_NaN() : sign * INFINITY;
    if (exponent == 0) return sign * std::ldexp(static_cast<float>(mantissa), -24);
    return sign * std::ldexp(static_cast<float>(1024 + mantissa), exponent - 25);
}

TEST(RepackTest, EveryHalfSurvivesTheWayThroughAFloat) {
    for (uint32_t bits = 0; bits <= 0xFFFF; ++bits) {
        const float value = floatFromHalf(static_cast<uint16_t>(bits));
        const uint16_t back = exactHalfBits(value);
        if (std::isnan(value)) {
            ASSERT_TRUE(std::isnan(floatFromHalf(back))) << bits;
        } else {
            ASSERT_EQ(back, bits);
        }
    }
}

TEST(RepackTest, SmallFloatsArePackedFromTheLowBitUp) {
    // 1.0: exponent 15 and mantissa 0 in 11 bits (5 + 6) and in 10 bits (5 + 5). 1.5 sets the top mantissa bit.
    const std::vector<float> texel{ 1.0f, 1.5f, 1.0f, 1.0f };
    uint32_t packed = 0;
    repack(Format::R11G11B10F, std::as_bytes(std::span(texel)), std::as_writable_bytes(std::span(&packed, 1)));
    EXPECT_EQ(packed, (15u << 6) | ((15u << 6 | 32u) << 11) | ((15u << 5) << 22));
}

TEST(RepackTest, ComponentsThatTheFormatLacksAreDropped) {
    const std::vector<uint32_t> integers{ 1, 2, 3, 4, 5, 6, 7, 8 };
    std::vector<uint32_t> two(4);
    repack(Format::RG32UI, std::as_bytes(std::span(integers)), std::as_writable_bytes(std::span(two)));
    EXPECT_EQ(two, (std::vector<uint32_t>{ 1, 2, 5, 6 }));
    std::vector<uint8_t> bytes(8);
    repack(Format::RGBA8UI, std::as_bytes(std::span(integers)), std::as_writable_bytes(std::span(bytes)));
    EXPECT_EQ(bytes, (std::vector<uint8_t>{ 1, 2, 3, 4, 5, 6, 7, 8 }));
    const std::vector<uint8_t> colors{ 10, 20, 30, 40, 50, 60, 70, 80 };
    std::vector<uint8_t> red(2);
    repack(Format::R8, std::as_bytes(std::span(colors)), std::as_writable_bytes(std::span(red)));
    EXPECT_EQ(red, (std::vector<uint8_t>{ 10, 50 }));
}

} // namespace
} // namespace filament_core::backend::gles
