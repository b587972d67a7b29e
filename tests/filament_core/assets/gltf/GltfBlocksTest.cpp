// SPDX-License-Identifier: Apache-2.0
// GltfBlocks: which textures of BC7 stay compressed, with the bytes of the file.
#include "filament_core/assets/blocks/BlockDecoder.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"
#include "tests/filament_core/assets/image/DdsWriter.h"
#include "tests/filament_core/assets/image/Ktx2Packing.h"
#include "tests/filament_core/assets/image/Ktx2Writer.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

namespace filament_core::assets::test {
namespace {

using backend::Format;

constexpr uint32_t kBc7Unorm = 145, kBc7Dxgi = 98; // VkFormat and DXGI_FORMAT
constexpr uint32_t kBlockWidth = 10, kBlockHeight = 6;

/// The levels of random blocks, as many as are asked for: 10 x 6, 5 x 3, 2 x 1, 1 x 1.
std::vector<Bytes> levelsOfBlocks(uint32_t count = 4) {
    std::mt19937 random(3);
    std::vector<Bytes> levels;
    for (uint32_t i = 0; i < count; ++i) {
        levels.emplace_back(
                bytesOfBlocks({ BlockKind::Bc7 }, std::max(kBlockWidth >> i, 1u), std::max(kBlockHeight >> i, 1u)));
        for (std::byte& byte : levels.back()) byte = static_cast<std::byte>(random());
    }
    return levels;
}

Bytes joined(std::vector<Bytes> const& levels, size_t first = 0) {
    Bytes all;
    for (size_t i = first; i < levels.size(); ++i) all.insert(all.end(), levels[i].begin(), levels[i].end());
    return all;
}

Ktx2Writer ktxOf(std::vector<Bytes> levels) {
    return {
        .format = kBc7Unorm, .width = kBlockWidth, .height = kBlockHeight, .model = 134, .levels = std::move(levels)
    };
}

DdsWriter ddsOfBlocks(std::vector<Bytes> const& levels) {
    return { .dxgi = kBc7Dxgi,
             .width = kBlockWidth,
             .height = kBlockHeight,
             .levels = static_cast<uint32_t>(levels.size()),
             .texels = joined(levels) };
}

enum class BlocksUse : uint8_t { Color, Occlusion, Normal, Both };

/// A triangle that shows the file as textures of its material.
TestFile modelWith(Bytes const& image, BlocksUse use) {
    TestFile file = TestFile::triangle();
    file.attribute("TEXCOORD_0", std::vector<float>{ 0, 0, 1, 0, 0, 1 }, kFloat, "VEC2", 2);
    file.root["images"].push_back({ { "bufferView", file.addView(image) } });
    file.root["textures"] = { Json::parse(R"({ "extensions": { "KHR_texture_basisu": { "source": 0 } } })") };
    file.root["extensionsUsed"] = { "KHR_texture_basisu" };
    Json material;
    if (use == BlocksUse::Color || use == BlocksUse::Both)
        material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
    if (use == BlocksUse::Occlusion || use == BlocksUse::Both) material["occlusionTexture"]["index"] = 0;
    if (use == BlocksUse::Normal) material["normalTexture"]["index"] = 0;
    file.root["materials"] = { material };
    file.primitive()["material"] = 0;
    return file;
}

std::vector<Image> imagesOf(Bytes const& image, BlocksUse use, GltfOptions const& options) {
    Result<ModelData> model = modelWith(image, use).load(options);
    EXPECT_TRUE(model) << model.error().message;
    return model ? std::move(model->images) : std::vector<Image>(1);
}

Image imageOf(Bytes const& image, GltfOptions const& options, BlocksUse use = BlocksUse::Occlusion) {
    return imagesOf(image, use, options).front();
}

constexpr GltfBlocks kAllBlocks = GltfBlocks::All, kDataBlocks = GltfBlocks::Data;

TEST(GltfBlocks, FilesWithAllLevelsKeepTheirBytes) {
    const std::vector<Bytes> levels = levelsOfBlocks();
    for (Bytes const& file : { ktxOf(levels).file(), ddsOfBlocks(levels).file() }) {
        for (const GltfBlocks blocks : { kDataBlocks, kAllBlocks }) {
            const Image image = imageOf(file, { .blocks = blocks });
            EXPECT_EQ(image.format, Format::BC7);
            EXPECT_EQ(image.width, kBlockWidth);
            EXPECT_EQ(image.height, kBlockHeight);
            EXPECT_EQ(image.levels, levels.size());
            EXPECT_EQ(image.data, joined(levels));
        }
        EXPECT_EQ(imageOf(file, {}).format, Format::RGBA8) << "not requested";
    }
}

TEST(GltfBlocks, SupercompressedLevelsAreInflated) {
    const std::vector<Bytes> levels = levelsOfBlocks();
    Ktx2Writer file = ktxOf(levels);
    file.compression = 2; // Zstandard
    for (Bytes& level : file.levels) {
        file.plainBytes.push_back(level.size());
        level = zstdOf(level);
    }
    EXPECT_EQ(imageOf(file.file(), { .blocks = kDataBlocks }).data, joined(levels));
}

TEST(GltfBlocks, ColoursStayOnlyIfAllMay) {
    const Bytes file = ddsOfBlocks(levelsOfBlocks()).file();
    EXPECT_EQ(imageOf(file, { .blocks = kDataBlocks }, BlocksUse::Color).format, Format::RGBA8Srgb);
    EXPECT_EQ(imageOf(file, { .blocks = kAllBlocks }, BlocksUse::Color).format, Format::BC7Srgb);
    for (const GltfBlocks blocks : { kDataBlocks, kAllBlocks }) {
        const std::vector<Image> both = imagesOf(file, BlocksUse::Both, { .blocks = blocks });
        ASSERT_EQ(both.size(), 2u);
        const bool isKept = blocks == kAllBlocks;
        EXPECT_EQ(both[0].format, isKept ? Format::BC7Srgb : Format::RGBA8Srgb);
        EXPECT_EQ(both[1].format, isKept ? Format::BC7 : Format::RGBA8);
    }
}

TEST(GltfBlocks, ALimitOfSizesLeavesOutLargeLevels) {
    const std::vector<Bytes> levels = levelsOfBlocks();
    for (Bytes const& file : { ktxOf(levels).file(), ddsOfBlocks(levels).file() }) {
        const Image image = imageOf(file, { .maxTextureSize = 5, .blocks = kDataBlocks });
        EXPECT_EQ(image.width, 5u);
        EXPECT_EQ(image.levels, 3u);
        EXPECT_EQ(image.data, joined(levels, 1));
        EXPECT_EQ(imageOf(file, { .maxTextureSize = 1, .blocks = kDataBlocks }).data, levels.back());
    }
}

TEST(GltfBlocks, WhatNeedsItsTexelsIsDecoded) {
    const std::vector<Bytes> levels = levelsOfBlocks(), one = levelsOfBlocks(1);
    const auto formatOf = [](Bytes const& file) { return imageOf(file, { .blocks = kAllBlocks }).format; };
    EXPECT_EQ(formatOf(ktxOf(one).file()), Format::RGBA8) << "levels are computed from texels";
    EXPECT_EQ(formatOf(ddsOfBlocks(one).file()), Format::RGBA8);
    EXPECT_EQ(formatOf(ktxOf(levelsOfBlocks(3)).file()), Format::RGBA8);
    Ktx2Writer swizzled = ktxOf(levels), flipped = ktxOf(levels);
    swizzled.keys = { { "KTXswizzle", "rrra" } };
    EXPECT_EQ(formatOf(swizzled.file()), Format::RGBA8);
    flipped.keys = { { "KTXorientation", "ru" } };
    EXPECT_EQ(formatOf(flipped.file()), Format::RGBA8);
    const GltfOptions filled{ .normals = GltfNormals::WithVariance, .blocks = kAllBlocks };
    EXPECT_EQ(imageOf(ktxOf(levels).file(), filled, BlocksUse::Normal).format, Format::RGBA8);
    EXPECT_EQ(imageOf(ktxOf(levels).file(), { .blocks = kAllBlocks }, BlocksUse::Normal).format, Format::BC7);
    DdsWriter other = ddsOfBlocks(levels);
    other.dxgi = 77; // BC3
    EXPECT_EQ(formatOf(other.file()), Format::RGBA8);
}

} // namespace
} // namespace filament_core::assets::test
