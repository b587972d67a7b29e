// SPDX-License-Identifier: Apache-2.0
// Bytes in and out: buffers that change between passes, dynamic offsets, blits, mip chains, partial read-backs.
#include "tests/backend/create/Gpu.h"
#include "tests/backend/create/Texel.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace filament_core::backend {
namespace {

using testing::Each;

DRIVER_SUITE(Transfer);

// ---------------------------------------------------------------------------------------------- buffers

constexpr std::string_view kShowUniform = "layout(set = 1, binding = 0, std140) uniform Params { vec4 value; };";

DRIVER_TEST(Transfer, EachPassSeesTheBufferAsItWasUpdatedBeforeIt) {
    const Program program = gpu.program(kFullScreenVertex, fragmentOf(kShowUniform, "result = value;"));
    const BufferHandle buffer = gpu.buffer(BufferUsage::Uniform, std::vector<Rgba>{ { 1, 2, 3, 4 } });
    const BindGroupHandle group = gpu.group(program, 1, { { .binding = 0, .buffer = buffer, .size = 16 } });
    std::vector<TextureHandle> targets;
    for (int i = 0; i < 6; ++i) {
        if (i > 0) gpu.update(buffer, std::vector<float>{ static_cast<float>(i) }, 4 * (static_cast<uint64_t>(i) % 4));
        targets.push_back(gpu.paint(program, { .width = 2, .height = 2, .group = group }));
    }
    Rgba expected{ 1, 2, 3, 4 };
    for (int i = 0; i < 6; ++i) {
        if (i > 0) expected[static_cast<size_t>(i) % 4] = static_cast<float>(i);
        EXPECT_THAT(gpu.readAs<Rgba>(targets[static_cast<size_t>(i)], { 0, 0, 2, 2 }), Each(expected)) << "pass " << i;
    }
}

DRIVER_TEST(Transfer, DynamicOffsetsSelectTheBlockOfEachDraw) {
    const uint32_t step = std::max(gpu.info().limits.uniformOffsetAlignment, 16u);
    constexpr std::string_view kTwoBlocks = R"(layout(set = 1, binding = 0, std140) uniform First { vec4 a; };
layout(set = 1, binding = 3, std140) uniform Second { vec4 b; };)";
    const Program program =
            gpu.program(kFullScreenVertex, fragmentOf(kTwoBlocks, "result = a + b;"), {}, { { 1, 0 }, { 1, 3 } });
    ASSERT_EQ(program.layout[1].dynamicCount(), 2u);
    std::vector<float> contents(step / 4 * 8);
    for (uint32_t i = 0; i < 8; ++i) contents[i * step / 4] = static_cast<float>(1u << i); // .x of block i
    const BufferHandle buffer = gpu.buffer(BufferUsage::Uniform, contents);
    const BindGroupHandle group = gpu.group(program, 1,
                                            { { .binding = 0, .buffer = buffer, .offset = 0, .size = 16 },
                                              { .binding = 3, .buffer = buffer, .offset = step, .size = 16 } });
    const TextureHandle target = gpu.target(Format::RGBA32F, 7, 1);
    const PassDesc pass = passOver({ { target, Format::RGBA32F } }, 7, 1);
    const PipelineHandle pipeline = gpu.pipeline(pipelineFor(program, pass.layout));
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ pipeline });
    for (uint32_t i = 0; i < 7; ++i) {
        gpu.record(CmdSetScissor{ { static_cast<int32_t>(i), 0, 1, 1 } });
        gpu.record(CmdBindGroup{
                .group = group, .index = 1, .dynamicCount = 2, .dynamicOffsets = { i * step, (6 - i) * step } });
        gpu.record(CmdDraw{ .vertexCount = 3 });
    }
    gpu.record(CmdEndPass{});
    const std::vector<Rgba> seen = gpu.readAs<Rgba>(target, { 0, 0, 7, 1 });
    for (uint32_t i = 0; i < 7; ++i)
        EXPECT_EQ(seen[i][0], static_cast<float>((1u << i) + (1u << (7 - i)))) << i; // b is one block on
}

DRIVER_TEST(Transfer, VertexAndIndexBuffersMayChangeBetweenPasses) {
    const Program program = gpu.program(kColorVertex, kColorFragment);
    const TextureHandle first = gpu.target(Format::RGBA32F, 2, 2), second = gpu.target(Format::RGBA32F, 2, 2);
    PassDesc pass = passOver({ { first, Format::RGBA32F } }, 2, 2);
    PipelineDesc desc = pipelineFor(program, pass.layout);
    useColorVertices(desc);
    const PipelineHandle pipeline = gpu.pipeline(desc);
    const auto triangle = [](Rgba const& color) {
        return std::vector<ColorVertex>{ { { -1, -1, 0, 1 }, color },
                                         { { 3, -1, 0, 1 }, color },
                                         { { -1, 3, 0, 1 }, color },
                                         { { 5, 5, 0, 1 }, color } };
    };
    const BufferHandle vertices = gpu.buffer(BufferUsage::Vertex, triangle({ 1, 0, 0, 1 }));
    const BufferHandle indices = gpu.buffer(BufferUsage::Index, std::vector<uint16_t>{ 0, 1, 2 });
    const auto draw = [&](TextureHandle target) {
        pass.colors[0].texture = target;
        gpu.record(CmdBeginPass{ pass });
        gpu.record(CmdBindPipeline{ pipeline });
        gpu.record(CmdBindVertexBuffers{ .buffers = { vertices }, .count = 1 });
        gpu.record(CmdBindIndexBuffer{ .buffer = indices });
        gpu.record(CmdDrawIndexed{ .indexCount = 3 });
        gpu.record(CmdEndPass{});
    };
    draw(first);
    gpu.update(vertices, triangle({ 0, 1, 0, 1 }));
    draw(second);
    gpu.update(indices, std::vector<uint16_t>{ 3, 3, 3 });
    const TextureHandle third = gpu.target(Format::RGBA32F, 2, 2);
    draw(third);
    EXPECT_THAT(gpu.readAs<Rgba>(first, { 0, 0, 2, 2 }), Each(Rgba{ 1, 0, 0, 1 }));
    EXPECT_THAT(gpu.readAs<Rgba>(second, { 0, 0, 2, 2 }), Each(Rgba{ 0, 1, 0, 1 }));
    EXPECT_THAT(gpu.readAs<Rgba>(third, { 0, 0, 2, 2 }), Each(Rgba{}));
}

DRIVER_TEST(Transfer, ManyUpdatesLargerThanAnyStagingRingAllArrive) {
    constexpr size_t kFloats = 1024 * 1024; // 4 MiB each, 40 MiB in one submission
    const TextureHandle texture = gpu.texture({ .format = Format::R32F,
                                                .usage = TextureUsage::TransferTarget | TextureUsage::TransferSource,
                                                .width = 1024,
                                                .height = 1024 });
    std::vector<float> texels(kFloats);
    for (int i = 1; i <= 10; ++i) {
        std::fill(texels.begin(), texels.end(), static_cast<float>(i));
        const auto row = static_cast<int32_t>(i * 100 - 100);
        gpu.upload(texture, { 0, row, 1024, 1024u - static_cast<uint32_t>(row) },
                   bytesOf(std::vector<float>(texels.begin(), texels.end() - row * 1024)));
    }
    const std::vector<float> seen = gpu.readAs<float>(texture, { 512, 0, 1, 1024 });
    for (size_t y = 0; y < 1024; ++y) ASSERT_EQ(seen[y], static_cast<float>(std::min<size_t>(y / 100 + 1, 10))) << y;
}

// ---------------------------------------------------------------------------------------------- read-backs

TextureHandle numbered(Gpu& gpu, uint32_t width, uint32_t height, std::vector<uint32_t>& texels) {
    texels.resize(size_t{ width } * height);
    for (uint32_t i = 0; i < texels.size(); ++i) texels[i] = 1000 + i;
    const TextureHandle texture = gpu.texture({ .format = Format::R32UI,
                                                .usage = TextureUsage::TransferTarget | TextureUsage::TransferSource,
                                                .width = width,
                                                .height = height });
    gpu.upload(texture, { 0, 0, width, height }, bytesOf(texels));
    return texture;
}

DRIVER_TEST(Transfer, AReadbackOfARectangleIsTightlyPackedTopRowFirst) {
    std::vector<uint32_t> texels;
    const TextureHandle texture = numbered(gpu, 13, 7, texels);
    for (Rect const& rect : { Rect{ 0, 0, 13, 7 }, Rect{ 12, 6, 1, 1 }, Rect{ 3, 2, 5, 4 }, Rect{ 0, 6, 13, 1 } }) {
        const std::vector<uint32_t> seen = gpu.readAs<uint32_t>(texture, rect);
        for (uint32_t i = 0; i < seen.size(); ++i) {
            const uint32_t x = static_cast<uint32_t>(rect.x) + i % rect.width,
                           y = static_cast<uint32_t>(rect.y) + i / rect.width;
            ASSERT_EQ(seen[i], texels[y * 13 + x]) << x << ", " << y;
        }
    }
}

DRIVER_TEST(Transfer, ReadbacksReachEveryLevelAndLayer) {
    using enum TextureUsage;
    for (const TextureKind type : { TextureKind::Texture2DArray, TextureKind::Cube }) {
        const TextureHandle texture = gpu.texture({ .type = type,
                                                    .format = Format::RGBA8,
                                                    .usage = TransferTarget | TransferSource,
                                                    .levels = 3,
                                                    .layers = 6,
                                                    .width = 4,
                                                    .height = 4 });
        for (uint8_t level = 0; level < 3; ++level) {
            for (uint16_t layer = 0; layer < 6; ++layer) {
                const uint32_t side = 4u >> level, value = 0x01010101u * (level * 16u + layer);
                gpu.upload(texture, { 0, 0, side, side }, bytesOf(std::vector<uint32_t>(size_t{ side } * side, value)),
                           level, layer);
            }
        }
        for (uint8_t level = 0; level < 3; ++level) {
            for (uint16_t layer = 0; layer < 6; ++layer) {
                EXPECT_THAT(gpu.readAs<uint32_t>(texture, { 0, 0, 4u >> level, 4u >> level }, level, layer),
                            Each(0x01010101u * (level * 16u + layer)));
            }
        }
    }
}

DRIVER_TEST(Transfer, AReadbackSeesTheTextureAsItWasWhenItWasRecorded) {
    const TextureHandle texture = gpu.texture(
            { .format = Format::R32F, .usage = TextureUsage::TransferTarget | TextureUsage::TransferSource });
    gpu.upload(texture, { 0, 0, 1, 1 }, bytesOf(std::vector<float>{ 1 }));
    EXPECT_EQ(gpu.readAs<float>(texture, { 0, 0, 1, 1 })[0], 1);
    gpu.upload(texture, { 0, 0, 1, 1 }, bytesOf(std::vector<float>{ 2 }));
    EXPECT_EQ(gpu.readAs<float>(texture, { 0, 0, 1, 1 })[0], 2);
}

// ---------------------------------------------------------------------------------------------- blits

DRIVER_TEST(Transfer, NearestBlitsRepeatTexelsWhenTheyEnlarge) {
    std::vector<uint32_t> texels;
    const TextureHandle source = numbered(gpu, 6, 4, texels);
    const TextureHandle target = gpu.texture({ .format = Format::R32UI,
                                               .usage = TextureUsage::TransferTarget | TextureUsage::TransferSource,
                                               .width = 10,
                                               .height = 10 });
    gpu.upload(target, { 0, 0, 10, 10 }, bytesOf(std::vector<uint32_t>(100, 7)));
    gpu.record(
            CmdBlit{ .source = source, .target = target, .sourceRect = { 1, 1, 3, 2 }, .targetRect = { 2, 3, 6, 4 } });
    const std::vector<uint32_t> seen = gpu.readAs<uint32_t>(target, { 0, 0, 10, 10 });
    for (uint32_t y = 0; y < 10; ++y) {
        for (uint32_t x = 0; x < 10; ++x) {
            const bool inside = x >= 2 && x < 8 && y >= 3 && y < 7;
            const uint32_t expected = inside ? texels[(1 + (y - 3) / 2) * 6 + 1 + (x - 2) / 2] : 7;
            ASSERT_EQ(seen[y * 10 + x], expected) << x << ", " << y;
        }
    }
}

DRIVER_TEST(Transfer, LinearBlitsAverageWhenTheyHalve) {
    const std::vector<float> texels{ 0, 2, 4, 8, 2, 4, 8, 16, 1, 1, 1, 1, 3, 3, 3, 3 };
    const TextureHandle source = gpu.texture({ .format = Format::R32F,
                                               .usage = TextureUsage::TransferTarget | TextureUsage::TransferSource,
                                               .width = 4,
                                               .height = 4 });
    gpu.upload(source, { 0, 0, 4, 4 }, bytesOf(texels));
    const TextureHandle target = gpu.texture({ .format = Format::R32F,
                                               .usage = TextureUsage::TransferTarget | TextureUsage::TransferSource,
                                               .width = 2,
                                               .height = 2 });
    gpu.record(CmdBlit{ .source = source,
                        .target = target,
                        .sourceRect = { 0, 0, 4, 4 },
                        .targetRect = { 0, 0, 2, 2 },
                        .filter = Filter::Linear });
    EXPECT_THAT(gpu.readAs<float>(target, { 0, 0, 2, 2 }), testing::ElementsAre(2, 9, 2, 2));
}

DRIVER_TEST(Transfer, BlitsConvertFormatsAndReachLevelsAndLayers) {
    using enum TextureUsage;
    const TextureHandle source = gpu.texture({ .format = Format::RGBA16F,
                                               .usage = TransferTarget | TransferSource,
                                               .levels = 2,
                                               .width = 4,
                                               .height = 4 });
    const Bytes texel = encodeTexel(Format::RGBA16F, { 0.25f, 0.625f, 0.75f, 1 });
    Bytes level1;
    for (int i = 0; i < 4; ++i) level1.insert(level1.end(), texel.begin(), texel.end());
    gpu.upload(source, { 0, 0, 2, 2 }, level1, 1);
    const TextureHandle target = gpu.texture({ .type = TextureKind::Texture2DArray,
                                               .format = Format::RGBA8,
                                               .usage = TransferTarget | TransferSource,
                                               .layers = 3,
                                               .width = 2,
                                               .height = 2 });
    gpu.upload(target, { 0, 0, 2, 2 }, Bytes(48), 0, 0, 3);
    gpu.record(CmdBlit{ .source = source,
                        .target = target,
                        .sourceLevel = 1,
                        .targetLayer = 2,
                        .sourceRect = { 0, 0, 2, 2 },
                        .targetRect = { 0, 0, 2, 2 } });
    EXPECT_THAT(gpu.readAs<Rgba8>(target, { 0, 0, 2, 2 }, 0, 2), Each(Rgba8{ 64, 159, 191, 255 }));
    EXPECT_THAT(gpu.readAs<Rgba8>(target, { 0, 0, 2, 2 }, 0, 1), Each(Rgba8{ 0, 0, 0, 0 }));
}

DRIVER_TEST(Transfer, ABlitBetweenLevelsOfOneTextureReadsTheOneAndWritesTheOther) {
    using enum TextureUsage;
    const TextureHandle texture = gpu.texture(
            { .format = Format::R32F, .usage = TransferTarget | TransferSource, .levels = 2, .width = 2, .height = 2 });
    gpu.upload(texture, { 0, 0, 2, 2 }, bytesOf(std::vector<float>{ 1, 2, 3, 4 }));
    gpu.record(CmdBlit{ .source = texture,
                        .target = texture,
                        .targetLevel = 1,
                        .sourceRect = { 1, 1, 1, 1 },
                        .targetRect = { 0, 0, 1, 1 } });
    EXPECT_EQ(gpu.readAs<float>(texture, { 0, 0, 1, 1 }, 1)[0], 4);
}

DRIVER_TEST(Transfer, ABlitFromSrgbDecodesEveryCode) {
    std::vector<Rgba8> codes(256);
    for (size_t i = 0; i < 256; ++i) {
        const auto code = static_cast<uint8_t>(i);
        codes[i] = { code, static_cast<uint8_t>(255 - code), static_cast<uint8_t>(code ^ 0x55), code };
    }
    using enum TextureUsage;
    const TextureHandle source = gpu.texture(
            { .format = Format::RGBA8Srgb, .usage = TransferTarget | TransferSource, .width = 256, .height = 1 });
    gpu.upload(source, { 0, 0, 256, 1 }, bytesOf(codes));
    const TextureHandle target = gpu.texture(
            { .format = Format::RGBA32F, .usage = TransferTarget | TransferSource, .width = 256, .height = 1 });
    gpu.record(CmdBlit{
            .source = source, .target = target, .sourceRect = { 0, 0, 256, 1 }, .targetRect = { 0, 0, 256, 1 } });
    const std::vector<Rgba> seen = gpu.readAs<Rgba>(target, { 0, 0, 256, 1 });
    for (size_t i = 0; i < 256; ++i) {
        const Rgba expected = decodeTexel(Format::RGBA8Srgb, reinterpret_cast<const std::byte*>(codes[i].data()));
        for (size_t c = 0; c < 4; ++c) ASSERT_NEAR(seen[i][c], expected[c], 2e-3) << "code " << i << ", " << c;
    }
}

// ---------------------------------------------------------------------------------------------- mip chains

struct MipCase {
    Format format;
    TextureKind type;
    uint32_t width, height;
    double tolerance; ///< one step of the format: filters of 8 bits may round twice (Mesa's llvmpipe does)
};

// Compares each level with the 2x2 box of the level above as read back, so that errors do not accumulate.
void checkMips(Gpu& gpu, MipCase const& one) {
    using enum TextureUsage;
    FormatInfo const& info = formatInfo(one.format);
    const auto levels = static_cast<uint8_t>(fullMipCount(one.width, one.height));
    const auto layers = static_cast<uint16_t>(one.type == TextureKind::Cube             ? 6
                                              : one.type == TextureKind::Texture2DArray ? 3
                                                                                        : 1);
    const TextureHandle texture = gpu.texture({ .type = one.type,
                                                .format = one.format,
                                                .usage = TransferTarget | TransferSource,
                                                .levels = levels,
                                                .layers = layers,
                                                .width = one.width,
                                                .height = one.height });
    std::mt19937 random(3);
    std::uniform_real_distribution<float> value(0, 1);
    Bytes base;
    for (uint32_t i = 0; i < one.width * one.height * layers; ++i) {
        const Bytes texel = encodeTexel(one.format, { value(random), value(random), value(random), value(random) });
        base.insert(base.end(), texel.begin(), texel.end());
    }
    gpu.upload(texture, { 0, 0, one.width, one.height }, base, 0, 0, layers);
    gpu.record(CmdGenerateMips{ texture });
    for (uint16_t layer = 0; layer < layers; ++layer) {
        Bytes above = gpu.read(texture, { 0, 0, one.width, one.height });
        uint32_t widthAbove = one.width, heightAbove = one.height;
        if (layer > 0) above = gpu.read(texture, { 0, 0, one.width, one.height }, 0, layer);
        for (uint8_t level = 1; level < levels; ++level) {
            const uint32_t width = std::max(1u, one.width >> level), height = std::max(1u, one.height >> level);
            const Bytes seen = gpu.read(texture, { 0, 0, width, height }, level, layer);
            const auto texelAbove = [&](uint32_t x, uint32_t y) {
                x = std::min(x, widthAbove - 1), y = std::min(y, heightAbove - 1);
                return decodeTexel(one.format, above.data() + (size_t{ y } * widthAbove + x) * info.bytesPerBlock);
            };
            for (uint32_t i = 0; i < width * height; ++i) {
                const uint32_t x = i % width * 2, y = i / width * 2;
                const Rgba a = texelAbove(x, y), b = texelAbove(x + 1, y), c = texelAbove(x, y + 1),
                           d = texelAbove(x + 1, y + 1);
                const Rgba got = decodeTexel(one.format, seen.data() + size_t{ i } * info.bytesPerBlock);
                for (uint32_t k = 0; k < info.components; ++k) {
                    ASSERT_NEAR(got[k], (a[k] + b[k] + c[k] + d[k]) / 4, one.tolerance)
                            << "layer " << layer << " level " << int{ level } << " texel " << i << " component " << k;
                }
            }
            above = seen, widthAbove = width, heightAbove = height;
        }
    }
}

DRIVER_TEST(Transfer, GeneratedLevelsAreTheBoxAverageOfTheLevelAbove) {
    for (MipCase const& one : { MipCase{ Format::RGBA8, TextureKind::Texture2D, 16, 16, 1.1 / 255 },
                                MipCase{ Format::R8, TextureKind::Texture2D, 16, 4, 1.1 / 255 },
                                MipCase{ Format::RGBA16F, TextureKind::Texture2D, 8, 8, 1.1 / 1024 },
                                MipCase{ Format::R32F, TextureKind::Texture2D, 8, 2, 1e-6 },
                                MipCase{ Format::RGBA8, TextureKind::Texture2DArray, 4, 4, 1.1 / 255 },
                                MipCase{ Format::RGBA16F, TextureKind::Cube, 8, 8, 1.1 / 1024 } }) {
        SCOPED_TRACE(std::string(formatInfo(one.format).name) + " type " + std::to_string(static_cast<int>(one.type)));
        checkMips(gpu, one);
    }
}

DRIVER_TEST(Transfer, GeneratedLevelsOfOddSizesKeepAConstantAndTheirSize) {
    using enum TextureUsage;
    const TextureHandle texture = gpu.texture({ .format = Format::RGBA8,
                                                .usage = TransferTarget | TransferSource,
                                                .levels = 4,
                                                .width = 13,
                                                .height = 5 });
    gpu.upload(texture, { 0, 0, 13, 5 }, bytesOf(std::vector<uint32_t>(65, 0x80402010)));
    gpu.record(CmdGenerateMips{ texture });
    EXPECT_THAT(gpu.readAs<uint32_t>(texture, { 0, 0, 6, 2 }, 1), Each(0x80402010u));
    EXPECT_THAT(gpu.readAs<uint32_t>(texture, { 0, 0, 3, 1 }, 2), Each(0x80402010u));
    EXPECT_THAT(gpu.readAs<uint32_t>(texture, { 0, 0, 1, 1 }, 3), Each(0x80402010u));
}

} // namespace
} // namespace filament_core::backend
