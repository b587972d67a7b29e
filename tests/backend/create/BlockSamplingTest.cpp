// SPDX-License-Identifier: Apache-2.0
// A texture of blocks beside the texture of the texels that filament_core/assets/blocks decodes from them: where a
// device samples both to the same bits, models may leave blocks on the device (docs/textures.md).
#include "filament_core/assets/blocks/BlockDecoder.h"
#include "tests/backend/create/Gpu.h"
#include "tests/backend/create/RandomBlocks.h"

#include <algorithm>

namespace filament_core::backend {
namespace {

DRIVER_SUITE(BlockSampling);

constexpr uint32_t kTargetSide = 128;

using SampledBits = std::array<uint32_t, 4>;

struct BlockTexture {
    Format blocks, texels;
    assets::BlockKind kind;
    BlockMode (*modeOf)(uint32_t block);
};

using enum assets::BlockKind;
constexpr BlockTexture kLinearBc6{ Format::BC6HUfloat, Format::RGBA16F, Bc6, modeOfBc6 };
constexpr BlockTexture kLinearBc7{ Format::BC7, Format::RGBA8, Bc7, modeOfBc7 };
constexpr BlockTexture kSrgbBc7{ Format::BC7Srgb, Format::RGBA8Srgb, Bc7, modeOfBc7 };
constexpr std::array<BlockTexture, 8> kInRealNumbers{ { { Format::BC1, Format::RGBA8, Bc1Rgba, noMode },
                                                        { Format::BC1Srgb, Format::RGBA8Srgb, Bc1Rgba, noMode },
                                                        { Format::BC2, Format::RGBA8, Bc2, noMode },
                                                        { Format::BC2Srgb, Format::RGBA8Srgb, Bc2, noMode },
                                                        { Format::BC3, Format::RGBA8, Bc3, noMode },
                                                        { Format::BC3Srgb, Format::RGBA8Srgb, Bc3, noMode },
                                                        { Format::BC4, Format::RGBA8, Bc4, noMode },
                                                        { Format::BC5, Format::RGBA8, Bc5, noMode } } };

/// How a fragment stage reads `image`, and with which sampler.
struct BlockReading {
    const char* name;
    const char* color;
    SamplerDesc sampler{};
};

constexpr SamplerDesc kTrilinear{ .magFilter = Filter::Linear,
                                  .minFilter = Filter::Linear,
                                  .mipFilter = MipFilter::Linear,
                                  .wrapU = WrapMode::Repeat,
                                  .wrapV = WrapMode::MirroredRepeat };

constexpr std::array<BlockReading, 4> kBlockReadings{ {
        { "texels", "texelFetch(image, ivec2(gl_FragCoord.xy) % textureSize(image, 0), 0)" },
        { "linear",
          "textureLod(image, gl_FragCoord.xy * vec2(0.0271, -0.0193) + 0.37, 0.0)",
          { .magFilter = Filter::Linear, .minFilter = Filter::Linear } },
        { "trilinear", "textureLod(image, gl_FragCoord.yx * vec2(-0.0131, 0.0177), gl_FragCoord.x * 0.061 - 0.2)",
          kTrilinear },
        { "by derivatives", "texture(image, gl_FragCoord.xy * gl_FragCoord.yx * gl_FragCoord.xy * 4e-6)", kTrilinear },
} };

struct ImageLevels {
    uint32_t width = 0, height = 0;
    std::vector<Bytes> blocks, texels; ///< by level
};

ImageLevels randomLevels(BlockTexture const& texture, uint32_t width, uint32_t height) {
    ImageLevels levels{ .width = width, .height = height };
    const uint32_t count = fullMipCount(width, height);
    for (uint32_t level = 0; level < count; ++level) {
        const uint32_t w = std::max(width >> level, 1u), h = std::max(height >> level, 1u);
        const uint32_t blockBytes = assets::bytesPerBlock(texture.kind);
        levels.blocks.push_back(randomBlocks(blockBytes, assets::bytesOfBlocks({ texture.kind }, w, h) / blockBytes,
                                             level + 1, texture.modeOf));
        Bytes texels(imageBytes(texture.texels, w, h));
        assets::decodeBlocks({ texture.kind }, false, levels.blocks.back(), w, h, texels);
        levels.texels.push_back(std::move(texels));
    }
    return levels;
}

std::vector<SampledBits> sampledBits(Gpu& gpu, Format format, ImageLevels const& size, std::vector<Bytes> const& levels,
                                     BlockReading const& reading) {
    const Program program =
            gpu.program(kFullScreenVertex, fragmentOf("layout(set = 1, binding = 0) uniform sampler2D image;",
                                                      "result = " + std::string(reading.color) + ";"));
    const TextureHandle texture = gpu.texture({ .format = format,
                                                .usage = TextureUsage::Sampled | TextureUsage::TransferTarget,
                                                .levels = static_cast<uint8_t>(levels.size()),
                                                .width = size.width,
                                                .height = size.height });
    for (uint8_t i = 0; i < levels.size(); ++i)
        gpu.upload(texture, { 0, 0, std::max(size.width >> i, 1u), std::max(size.height >> i, 1u) }, levels[i], i);
    const BindGroupHandle group = gpu.imageGroup(program, texture, gpu.sampler(reading.sampler));
    const TextureHandle target = gpu.paint(program, { .width = kTargetSide, .height = kTargetSide, .group = group });
    return gpu.readAs<SampledBits>(target, { 0, 0, kTargetSide, kTargetSide });
}

/// Samples of kTargetSide^2 that differ.
size_t differences(Gpu& gpu, BlockTexture const& texture, ImageLevels const& levels, BlockReading const& reading) {
    const auto blocks = sampledBits(gpu, texture.blocks, levels, levels.blocks, reading);
    const auto texels = sampledBits(gpu, texture.texels, levels, levels.texels, reading);
    size_t count = 0;
    for (size_t i = 0; i < blocks.size(); ++i) count += blocks[i] != texels[i] ? 1 : 0;
    testing::Test::RecordProperty(std::string(formatInfo(texture.blocks).name) + ' ' + reading.name,
                                  std::to_string(count));
    return count;
}

void expectSameSamples(Gpu& gpu, BlockTexture const& texture) {
    for (ImageLevels const& levels : { randomLevels(texture, 128, 128), randomLevels(texture, 75, 26) }) {
        for (BlockReading const& reading : kBlockReadings)
            EXPECT_EQ(differences(gpu, texture, levels, reading), 0u)
                    << formatInfo(texture.blocks).name << ", " << levels.width << " x " << levels.height << ", "
                    << reading.name;
    }
}

constexpr const char* kNoBlocks = "this device samples no BC formats, which are optional: models are decoded for it";

DRIVER_TEST(BlockSampling, LinearBc6AndBc7HaveTheBitsOfTheirTexels) {
    if (!gpu.info().features.blockCompression) GTEST_SKIP() << kNoBlocks;
    expectSameSamples(gpu, kLinearBc6);
    expectSameSamples(gpu, kLinearBc7);
}

DRIVER_TEST(BlockSampling, SrgbBc7HasTheBitsOfItsTexelsWhereTheDeviceIsSaidToHaveThem) {
    if (!gpu.info().features.blockCompression) GTEST_SKIP() << kNoBlocks;
    if (gpu.info().features.exactSrgbBlocks) return expectSameSamples(gpu, kSrgbBc7);
    EXPECT_GT(differences(gpu, kSrgbBc7, randomLevels(kSrgbBc7, 128, 128), kBlockReadings[0]), 0u)
            << "the quirk convertsSrgbOfBlocks is gone with this driver";
}

DRIVER_TEST(BlockSampling, Bc1ToBc5HaveOtherBitsOnCpuDriversThanTheirTexels) {
    if (!gpu.info().features.blockCompression || gpu.info().features.exactSrgbBlocks)
        GTEST_SKIP() << "no CPU driver of Mesa with BC formats: how devices round these formats is up to them";
    for (BlockTexture const& texture : kInRealNumbers)
        EXPECT_GT(differences(gpu, texture, randomLevels(texture, 128, 128), kBlockReadings[0]), 0u)
                << formatInfo(texture.blocks).name << " could stay compressed";
}

} // namespace
} // namespace filament_core::backend
