// SPDX-License-Identifier: Apache-2.0
// Bind groups that show a part of a texture, while the pass writes another part of it.
#include "tests/backend/create/Gpu.h"

namespace filament_core::backend {

DRIVER_SUITE(TextureRanges);

namespace {

constexpr uint32_t kTextureSize = 16;
constexpr uint8_t kLevels = 5;

using enum TextureUsage;

TextureHandle mipped(Gpu& gpu, Format format, TextureUsage attachment, TextureKind type = TextureKind::Texture2D,
                     uint16_t layers = 1) {
    return gpu.texture({ .type = type,
                         .format = format,
                         .usage = attachment | Sampled | TransferSource | TransferTarget,
                         .levels = kLevels,
                         .layers = layers,
                         .width = kTextureSize,
                         .height = kTextureSize,
                         .debugName = "chain" });
}

uint32_t sizeOf(uint32_t level) { return kTextureSize >> level; }

/// Texels that a box filter halves without rounding at every level.
std::vector<float> levelZero() {
    std::vector<float> texels(kTextureSize * kTextureSize);
    for (uint32_t i = 0; i < texels.size(); ++i) texels[i] = static_cast<float>(i * 37 % 64) * 256;
    return texels;
}

std::vector<float> halved(std::vector<float> const& from, uint32_t size) {
    std::vector<float> to(size_t{ size } * size / 4);
    for (uint32_t y = 0; y < size / 2; ++y) {
        for (uint32_t x = 0; x < size / 2; ++x) {
            float const* corner = &from[size_t{ 2 * y } * size + 2 * x];
            to[size_t{ y } * (size / 2) + x] = (corner[0] + corner[1] + corner[size] + corner[size + 1]) / 4;
        }
    }
    return to;
}

const std::string& halve() {
    static const std::string text = fragmentOf("layout(set = 1, binding = 0) uniform highp sampler2D above;",
                                               R"(
        ivec2 at = 2 * ivec2(gl_FragCoord.xy);
        vec4 sum = texelFetch(above, at, 0) + texelFetch(above, at + ivec2(1, 0), 0) +
                   texelFetch(above, at + ivec2(0, 1), 0) + texelFetch(above, at + ivec2(1, 1), 0);
        result = sum / 4.0;)");
    return text;
}

PassDesc passTo(TextureHandle texture, Format format, uint8_t level, uint16_t layer = 0) {
    PassDesc pass = passOver({ { texture, format } }, sizeOf(level), sizeOf(level));
    pass.colors[0].level = level;
    pass.colors[0].layer = layer;
    return pass;
}

void draw(Gpu& gpu, PassDesc const& pass, PipelineHandle pipeline, BindGroupHandle group) {
    gpu.record(CmdBeginPass{ pass });
    gpu.record(CmdBindPipeline{ pipeline });
    gpu.record(CmdBindGroup{ .group = group, .index = 1 });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdEndPass{});
}

} // namespace

DRIVER_TEST(TextureRanges, EachLevelIsMadeFromTheOneAboveItInOneTexture) {
    const TextureHandle chain = mipped(gpu, Format::R32F, ColorAttachment);
    std::vector<float> expected = levelZero();
    gpu.upload(chain, { 0, 0, kTextureSize, kTextureSize }, bytesOf(expected));
    const Program program = gpu.program(kFullScreenVertex, halve());
    const PipelineHandle pipeline = gpu.pipeline(pipelineFor(program, passTo(chain, Format::R32F, 1).layout));
    for (uint8_t level = 1; level < kLevels; ++level) {
        const BindGroupHandle above = gpu.group(
                program, 1,
                { { .texture = chain, .sampler = gpu.sampler(), .range = oneLevel(static_cast<uint8_t>(level - 1)) } });
        draw(gpu, passTo(chain, Format::R32F, level), pipeline, above);
    }
    for (uint8_t level = 1; level < kLevels; ++level) {
        expected = halved(expected, sizeOf(level - 1u));
        EXPECT_EQ(gpu.readAs<float>(chain, { 0, 0, sizeOf(level), sizeOf(level) }, level), expected)
                << "level " << int{ level };
    }
}

// The upsampling half of a bloom: adds the level below to every level, while sampling that one with a filter.
DRIVER_TEST(TextureRanges, LevelsAreAddedUpwardsWithAFilterWhileTheyAreSampled) {
    const TextureHandle chain = mipped(gpu, Format::RGBA16F, ColorAttachment);
    std::vector<uint16_t> texels(size_t{ kTextureSize } * kTextureSize * 4);
    for (uint8_t level = 0; level < kLevels; ++level) {
        const uint32_t size = sizeOf(level);
        for (uint32_t i = 0; i < size * size * 4; ++i)
            texels[i] = static_cast<uint16_t>(0x3000 + (i * 97 + level) % 2048);
        texels.resize(size_t{ size } * size * 4);
        gpu.upload(chain, { 0, 0, size, size }, bytesOf(texels), level);
    }
    const Program program =
            gpu.program(kFullScreenVertex,
                        fragmentOf("layout(set = 1, binding = 0) uniform highp sampler2D below;",
                                   "result = texture(below, gl_FragCoord.xy / vec2(2 * textureSize(below, 0)));"));
    PipelineDesc desc = pipelineFor(program, passTo(chain, Format::RGBA16F, 0).layout);
    desc.blend[0] = { .enabled = true, .dstColor = BlendFactor::One, .dstAlpha = BlendFactor::One };
    const PipelineHandle pipeline = gpu.pipeline(desc);
    const SamplerHandle linear = gpu.sampler({ .magFilter = Filter::Linear,
                                               .minFilter = Filter::Linear,
                                               .wrapU = WrapMode::ClampToEdge,
                                               .wrapV = WrapMode::ClampToEdge });
    std::vector<Bytes> before;
    for (uint8_t level = 0; level < kLevels; ++level) {
        before.push_back(gpu.read(chain, { 0, 0, sizeOf(level), sizeOf(level) }, level));
    }
    for (uint8_t level = kLevels - 1; level-- > 0;) {
        const BindGroupHandle below = gpu.group(
                program, 1,
                { { .texture = chain, .sampler = linear, .range = oneLevel(static_cast<uint8_t>(level + 1)) } });
        PassDesc pass = passTo(chain, Format::RGBA16F, level);
        pass.colors[0].load = LoadOp::Load;
        draw(gpu, pass, pipeline, below);
    }
    for (uint8_t level = 0; level < kLevels; ++level) {
        const Bytes after = gpu.read(chain, { 0, 0, sizeOf(level), sizeOf(level) }, level);
        EXPECT_EQ(after == before[level], level == kLevels - 1) << "level " << int{ level };
    }
}

DRIVER_TEST(TextureRanges, TheFirstLevelAndLayerOfTheRangeAreLevelAndLayerZero) {
    const TextureHandle array = mipped(gpu, Format::R32F, ColorAttachment, TextureKind::Texture2DArray, 4);
    for (uint8_t level = 0; level < kLevels; ++level) {
        for (uint16_t layer = 0; layer < 4; ++layer) {
            const std::vector<float> texels(size_t{ sizeOf(level) } * sizeOf(level),
                                            static_cast<float>(10 * layer + level));
            gpu.upload(array, { 0, 0, sizeOf(level), sizeOf(level) }, bytesOf(texels), level, layer);
        }
    }
    const Program program = gpu.program(kFullScreenVertex,
                                        fragmentOf("layout(set = 1, binding = 0) uniform highp sampler2DArray part;\n"
                                                   "layout(set = 1, binding = 1) uniform highp sampler2DArray whole;",
                                                   R"(
        result.x = texelFetch(part, ivec3(0), 0).x;
        result.y = texelFetch(part, ivec3(0, 0, 1), 1).x + 1000.0 * texelFetch(whole, ivec3(0, 0, 3), 4).x;
        result.z = float(textureSize(part, 0).x * 10 + textureSize(part, 0).z) + 1000.0 * float(textureSize(whole, 0).z);
        result.w = textureLod(part, vec3(0.5, 0.5, 9.0), 9.0).x;)"));
    const SamplerHandle mips = gpu.sampler({ .mipFilter = MipFilter::Nearest });
    const BindGroupHandle group =
            gpu.group(program, 1,
                      { { .binding = 0, .texture = array, .sampler = mips, .range = { 1, 2, 2, 2 } },
                        { .binding = 1, .texture = array, .sampler = mips } });
    const TextureHandle painted = gpu.paint(program, { .width = 1, .height = 1, .group = group });
    EXPECT_EQ(gpu.readAs<Rgba>(painted, { 0, 0, 1, 1 })[0],
              (Rgba{ 21, 32 + 1000 * 34, 8 * 10 + 2 + 4000, 32 })); // lod and layer clamp to the end of the range
}

DRIVER_TEST(TextureRanges, OneLayerIsWrittenWhileOthersAreSampled) {
    const TextureHandle array = mipped(gpu, Format::R32F, ColorAttachment, TextureKind::Texture2DArray, 3);
    for (uint16_t layer = 0; layer < 2; ++layer) {
        std::vector<float> texels = levelZero();
        for (float& texel : texels) texel += layer;
        gpu.upload(array, { 0, 0, kTextureSize, kTextureSize }, bytesOf(texels), 0, layer);
    }
    const Program program =
            gpu.program(kFullScreenVertex, fragmentOf("layout(set = 1, binding = 0) uniform highp sampler2DArray two;",
                                                      "ivec2 at = ivec2(gl_FragCoord.xy);\n"
                                                      "result = 2.0 * texelFetch(two, ivec3(at, 0), 0) + "
                                                      "texelFetch(two, ivec3(at, 1), 0);"));
    const PassDesc pass = passTo(array, Format::R32F, 0, 2);
    const BindGroupHandle two =
            gpu.group(program, 1, { { .texture = array, .sampler = gpu.sampler(), .range = { 0, 1, 0, 2 } } });
    draw(gpu, pass, gpu.pipeline(pipelineFor(program, pass.layout)), two);
    std::vector<float> expected = levelZero();
    for (float& texel : expected) texel = 3 * texel + 1;
    EXPECT_EQ(gpu.readAs<float>(array, { 0, 0, kTextureSize, kTextureSize }, 0, 2), expected);
}

DRIVER_TEST(TextureRanges, DepthLevelsKeepTheFarthestOfTheOnesAbove) {
    const TextureHandle chain = mipped(gpu, Format::D32F, DepthAttachment);
    PassDesc first;
    first.layout.depthFormat = Format::D32F;
    first.depth.texture = chain;
    first.depth.clear = {};
    first.area = { 0, 0, kTextureSize, kTextureSize };
    first.debugName = "depth";
    const Program ramp =
            gpu.program(kFullScreenVertex, "#version 450\nvoid main() { ivec2 at = ivec2(gl_FragCoord.xy);\n"
                                           "gl_FragDepth = float((at.x * 7 + at.y * 13) % 64) / 64.0; }");
    const Program farthest =
            gpu.program(kFullScreenVertex,
                        "#version 450\nlayout(set = 1, binding = 0) uniform highp sampler2D above;\n"
                        "void main() { ivec2 at = 2 * ivec2(gl_FragCoord.xy);\n"
                        "gl_FragDepth = min(min(texelFetch(above, at, 0).x, texelFetch(above, at + ivec2(1, 0), 0).x),"
                        "min(texelFetch(above, at + ivec2(0, 1), 0).x, texelFetch(above, at + ivec2(1, 1), 0).x)); }");
    PipelineDesc rampDesc = pipelineFor(ramp, first.layout), minDesc = pipelineFor(farthest, first.layout);
    rampDesc.depthStencil = minDesc.depthStencil = { .depthCompare = CompareOp::Always, .depthWrite = true };
    const PipelineHandle rampPipeline = gpu.pipeline(rampDesc), minPipeline = gpu.pipeline(minDesc);
    gpu.record(CmdBeginPass{ first });
    gpu.record(CmdBindPipeline{ rampPipeline });
    gpu.record(CmdDraw{ .vertexCount = 3 });
    gpu.record(CmdEndPass{});
    for (uint8_t level = 1; level < 3; ++level) {
        PassDesc pass = first;
        pass.depth.level = level;
        pass.area = { 0, 0, sizeOf(level), sizeOf(level) };
        const BindGroupHandle above = gpu.group(
                farthest, 1,
                { { .texture = chain, .sampler = gpu.sampler(), .range = oneLevel(static_cast<uint8_t>(level - 1)) } });
        draw(gpu, pass, minPipeline, above);
    }
    const auto depths = gpu.readAs<float>(chain, { 0, 0, sizeOf(2), sizeOf(2) }, 2);
    for (uint32_t y = 0; y < sizeOf(2); ++y) {
        for (uint32_t x = 0; x < sizeOf(2); ++x) {
            float expected = 1;
            for (uint32_t i = 0; i < 16; ++i) {
                const uint32_t value = ((4 * x + i % 4) * 7 + (4 * y + i / 4) * 13) % 64;
                expected = std::min(expected, static_cast<float>(value) / 64);
            }
            EXPECT_EQ(depths[y * sizeOf(2) + x], expected) << x << ", " << y;
        }
    }
}

DRIVER_TEST(TextureRanges, AFaceOfACubeIsWrittenWhileTheLevelAboveIsSampled) {
    const TextureHandle cube = mipped(gpu, Format::R32F, ColorAttachment, TextureKind::Cube, 6);
    for (uint16_t face = 0; face < 6; ++face) {
        const std::vector<float> texels(size_t{ kTextureSize } * kTextureSize, static_cast<float>(face + 1));
        gpu.upload(cube, { 0, 0, kTextureSize, kTextureSize }, bytesOf(texels), 0, face);
    }
    const Program program =
            gpu.program(kFullScreenVertex, fragmentOf("layout(set = 1, binding = 0) uniform highp samplerCube above;",
                                                      "result = 100.0 * textureLod(above, vec3(1, 0, 0), 0.0) + "
                                                      "textureLod(above, vec3(0, 0, -1), 0.0);"));
    const BindGroupHandle above =
            gpu.group(program, 1, { { .texture = cube, .sampler = gpu.sampler(), .range = oneLevel(0) } });
    const PassDesc pass = passTo(cube, Format::R32F, 1, 3);
    draw(gpu, pass, gpu.pipeline(pipelineFor(program, pass.layout)), above);
    EXPECT_EQ(gpu.readAs<float>(cube, { 0, 0, 1, 1 }, 1, 3)[0], 106);
}

} // namespace filament_core::backend
