// SPDX-License-Identifier: Apache-2.0
// Clearing, loading, storing; targets of awkward sizes.
#include "tests/backend/create/Gpu.h"
#include "tests/backend/create/Texel.h"

#include <gmock/gmock.h>

namespace filament_core::backend {
namespace {

using testing::Each;

DRIVER_SUITE(Clear);

void clearOnly(Gpu& gpu, PassDesc const& pass) {
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdEndPass{});
}

DRIVER_TEST(Clear, EveryRenderableColorFormatStoresTheClearValueAsItsDefinitionSays) {
    for (uint32_t i = 1; i < static_cast<uint32_t>(Format::Count); ++i) {
        const auto format = static_cast<Format>(i);
        FormatInfo const& info = formatInfo(format);
        if (!info.isRenderable || hasDepth(format)) continue;
        SCOPED_TRACE(info.name);
        const bool integer = info.kind == FormatKind::UnsignedInteger;
        const Rgba value = integer ? Rgba{ 1, 20, 150, 255 } : Rgba{ 0.25f, 0.625f, 0.75f, 1.0f };
        const TextureHandle target = gpu.target(format, 3, 2);
        PassDesc pass = passOver({ { target, format } }, 3, 2);
        pass.colors[0].clear = value;
        clearOnly(gpu, pass);
        const Bytes bytes = gpu.read(target, { 0, 0, 3, 2 });
        const Bytes texel = encodeTexel(attachmentFormat(format), value); // sRGB: as it is, nobody encodes it
        ASSERT_EQ(bytes.size(), 6 * texel.size());
        for (size_t at = 0; at < bytes.size(); ++at) ASSERT_EQ(bytes[at], texel[at % texel.size()]) << "byte " << at;
    }
}

DRIVER_TEST(Clear, DepthReadsBackAsFloatsOfItsOwnPrecision) {
    for (const Format format : { Format::D32F, Format::D16, Format::D32FS8 }) {
        SCOPED_TRACE(formatInfo(format).name);
        const TextureHandle depth = gpu.target(format, 5, 3);
        PassDesc pass;
        pass.layout.depthFormat = format;
        pass.depth = { .texture = depth, .clear = { 0.3f, 0, 0, 0 } };
        pass.area = { 0, 0, 5, 3 };
        clearOnly(gpu, pass);
        const float expected = format == Format::D16 ? 19661.0f / 65535.0f : 0.3f; // round(0.3 * 65535) = 19661
        EXPECT_THAT(gpu.readAs<float>(depth, { 0, 0, 5, 3 }), Each(testing::FloatEq(expected)));
    }
}

DRIVER_TEST(Clear, TargetsOfOneTexelOneRowAndTheWidestRowAreClearedToTheLastTexel) {
    for (const auto& [width, height] :
         { std::pair(1u, 1u), std::pair(3u, 1u), std::pair(1u, 3u), std::pair(8192u, 1u) }) {
        SCOPED_TRACE(width);
        const TextureHandle target = gpu.target(Format::RGBA8, width, height);
        PassDesc pass = passOver({ { target, Format::RGBA8 } }, width, height);
        pass.colors[0].clear = { 1, 0, 1, 0 };
        clearOnly(gpu, pass);
        EXPECT_THAT(gpu.readAs<Rgba8>(target, { 0, 0, width, height }), Each(Rgba8{ 255, 0, 255, 0 }));
    }
}

DRIVER_TEST(Clear, AnAreaLoadedLeavesTexelsOutsideAlone) {
    const TextureHandle target = gpu.target(Format::RGBA8, 8, 8);
    PassDesc pass = passOver({ { target, Format::RGBA8 } }, 8, 8);
    pass.colors[0].clear = { 0, 0, 1, 1 };
    clearOnly(gpu, pass);
    const Program red = gpu.program(kFullScreenVertex, fragmentOf("", "result = vec4(1.0, 0.0, 0.0, 1.0);"));
    pass.colors[0].load = LoadOp::Load;
    pass.area = { 2, 3, 4, 2 };
    const PipelineHandle pipeline = gpu.pipeline(pipelineFor(red, pass.layout));
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ pipeline });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdEndPass{});
    const std::vector<Rgba8> texels = gpu.readAs<Rgba8>(target, { 0, 0, 8, 8 });
    for (uint32_t y = 0; y < 8; ++y) {
        for (uint32_t x = 0; x < 8; ++x) {
            const bool inside = x >= 2 && x < 6 && y >= 3 && y < 5;
            const Rgba8 expected = inside ? Rgba8{ 255, 0, 0, 255 } : Rgba8{ 0, 0, 255, 255 };
            ASSERT_EQ(texels[y * 8 + x], expected) << x << ", " << y;
        }
    }
}

DRIVER_TEST(Clear, OneLevelAndLayerOfATextureIsClearedAndNoOther) {
    using enum TextureUsage;
    const TextureHandle target = gpu.texture({ .type = TextureKind::Texture2DArray,
                                               .format = Format::RGBA8,
                                               .usage = ColorAttachment | TransferSource,
                                               .levels = 3,
                                               .layers = 2,
                                               .width = 8,
                                               .height = 4 });
    const auto clear = [&](uint8_t level, uint16_t layer, float value) {
        PassDesc pass = passOver({ { target, Format::RGBA8 } }, 8u >> level, 4u >> level);
        pass.colors[0] = { .texture = target, .level = level, .layer = layer, .clear = { value, value, value, value } };
        clearOnly(gpu, pass);
    };
    for (uint8_t level = 0; level < 3; ++level) {
        for (uint16_t layer = 0; layer < 2; ++layer) clear(level, layer, 0);
    }
    clear(1, 1, 1);
    for (uint8_t level = 0; level < 3; ++level) {
        for (uint16_t layer = 0; layer < 2; ++layer) {
            const uint8_t expected = level == 1 && layer == 1 ? 255 : 0;
            EXPECT_THAT(gpu.readAs<uint32_t>(target, { 0, 0, 8u >> level, 4u >> level }, level, layer),
                        Each(0x01010101u * expected))
                    << int{ level } << ", " << layer;
        }
    }
}

DRIVER_TEST(Clear, OneSliceOfALevelIsClearedAndNoOther) {
    using enum TextureUsage;
    for (const Format format : { Format::RGBA8, Format::RGBA8Srgb }) {
        const TextureHandle volume = gpu.texture({ .type = TextureKind::Texture3D,
                                                   .format = format,
                                                   .usage = ColorAttachment | Sampled | TransferSource,
                                                   .levels = 3,
                                                   .layers = 6,
                                                   .width = 8,
                                                   .height = 4 });
        const auto clear = [&](uint8_t level, uint16_t slice, float value) {
            PassDesc pass = passOver({ { volume, format } }, 8u >> level, 4u >> level);
            pass.colors[0] = {
                .texture = volume, .level = level, .layer = slice, .clear = { value, value, value, value }
            };
            clearOnly(gpu, pass);
        };
        constexpr std::array<uint16_t, 3> kSlices{ 6, 3, 1 };
        for (uint8_t level = 0; level < 3; ++level) {
            for (uint16_t slice = 0; slice < kSlices[level]; ++slice) clear(level, slice, 0);
        }
        clear(1, 2, 1);
        clear(0, 4, 1);
        for (uint8_t level = 0; level < 3; ++level) {
            for (uint16_t slice = 0; slice < kSlices[level]; ++slice) {
                const bool isWhite = (level == 1 && slice == 2) || (level == 0 && slice == 4);
                EXPECT_THAT(gpu.readAs<uint32_t>(volume, { 0, 0, 8u >> level, 4u >> level }, level, slice),
                            Each(isWhite ? 0xFFFFFFFFu : 0u))
                        << int{ level } << ", " << slice;
            }
        }
    }
}

DRIVER_TEST(Clear, EveryAttachmentHasItsOwnClearValue) {
    const TextureHandle a = gpu.target(Format::RGBA8, 2, 2), b = gpu.target(Format::R32UI, 2, 2),
                        c = gpu.target(Format::R32F, 2, 2), d = gpu.target(Format::D32F, 2, 2);
    PassDesc pass = passOver({ { a, Format::RGBA8 }, { b, Format::R32UI }, { c, Format::R32F } }, 2, 2);
    pass.layout.depthFormat = Format::D32F;
    pass.colors[0].clear = { 0, 1, 0, 1 };
    pass.colors[1].clear = { 70000, 0, 0, 0 };
    pass.colors[2].clear = { -2.5f, 0, 0, 0 };
    pass.depth = { .texture = d, .clear = { 0.125f, 0, 0, 0 } };
    clearOnly(gpu, pass);
    EXPECT_THAT(gpu.readAs<Rgba8>(a, { 0, 0, 2, 2 }), Each(Rgba8{ 0, 255, 0, 255 }));
    EXPECT_THAT(gpu.readAs<uint32_t>(b, { 0, 0, 2, 2 }), Each(70000u));
    EXPECT_THAT(gpu.readAs<float>(c, { 0, 0, 2, 2 }), Each(-2.5f));
    EXPECT_THAT(gpu.readAs<float>(d, { 0, 0, 2, 2 }), Each(0.125f));
}

} // namespace
} // namespace filament_core::backend
