// SPDX-License-Identifier: Apache-2.0
// GltfLoadOptions::compressedTextures on both APIs: the bits of the decoded textures, in less memory.
#include "filament_core/assets/blocks/BlockFormat.h"
#include "tests/filament_core/assets/image/DdsWriter.h"
#include "tests/filament_core/engine/gltf/QuadFile.h"
#include "tests/filament_core/engine/materials/MaterialStage.h"
#include "toolkit/showcase/SceneBuilder.h"

#include <filament_core/Gltf.h>

#include <memory>
#include <random>

namespace filament_core {
namespace {

using assets::MaterialData;
using test::MaterialStage;

constexpr uint32_t kBlocksSize = 64, kLevelsOfBlocks = 7;
constexpr uint32_t kBytesOfBlocks = 5488;  ///< 16 * (256 + 64 + 16 + 4 + 1 + 1 + 1)
constexpr uint32_t kBytesOfTexels = 21844; ///< 4 * (64^2 + 32^2 + ... + 1)

/// Random blocks of all modes of BC7.
assets::GlbImage blocksOf(uint32_t seed) {
    assets::test::DdsWriter file{
        .dxgi = 98, .width = kBlocksSize, .height = kBlocksSize, .levels = kLevelsOfBlocks, .texels = {}
    };
    std::mt19937 random(seed);
    for (uint32_t i = 0; i < kBytesOfBlocks; ++i) file.texels.push_back(static_cast<std::byte>(random()));
    for (uint32_t i = 0; i < kBytesOfBlocks; i += 16) file.texels[i] = static_cast<std::byte>(1u << (i / 16 % 8));
    return { "blocks", file.file() };
}

std::vector<std::byte> quadOfBlocks() {
    MaterialData material{ .name = "blocks" };
    material.baseColor = showcase::textured(0);
    material.metallicRoughness = showcase::textured(1);
    material.normal = showcase::textured(2);
    return test::quadFile({ blocksOf(1), blocksOf(2), blocksOf(3) }, material,
                          { { 0, 0 }, { 0, 3 }, { 5, 4 }, { 4, 0 } });
}

struct BlocksFrame {
    Image image;
    std::vector<uint64_t> bytes; ///< of the model on each device
};

BlocksFrame drawnWith(bool isCompressed) {
    BlocksFrame frame;
    frame.image = test::onBothApis([&](MaterialStage& stage) {
        const auto bytes = [&] {
            stage.engine.waitIdle();
            return stage.engine.statistics().deviceBytes;
        };
        const uint64_t before = bytes();
        Result<Model> model = loadGltf(stage.engine, GltfMemory{ .file = quadOfBlocks(), .name = "blocks.glb" },
                                       { .compressedTextures = isCompressed });
        ASSERT_TRUE(model) << model.error().message;
        frame.bytes.push_back(bytes() - before);
        const auto kept = std::make_shared<Model>(std::move(*model));
        stage.keep(kept);
        stage.scene.add(*kept);
        stage.scene.add(SunLight{ .directionWorld = { -0.2f, -0.1f, -1.0f }, .illuminance = Lux{ 3 } });
        stage.view.camera = Camera::lookAt({ 0.3, 0.9, 0.75 }, { 0, 0, 0 }, { .verticalFovDegrees = 70 });
        stage.view.camera.exposure = { .aperture = 1, .shutterSeconds = 1, .iso = 100 };
        stage.view.size = { 96, 64 };
    });
    return frame;
}

TEST(CompressedTextures, HaveTheBitsOfDecodedOnesInLessMemory) {
    const BlocksFrame decoded = drawnWith(false), compressed = drawnWith(true);
    EXPECT_EQ(compressed.image.pixels, decoded.image.pixels);
    ASSERT_EQ(compressed.bytes.size(), decoded.bytes.size());
    for (size_t i = 0; i < decoded.bytes.size(); ++i)
        EXPECT_LE(compressed.bytes[i] + 2 * (kBytesOfTexels - kBytesOfBlocks), decoded.bytes[i])
                << "two textures of data, at least";
}

} // namespace
} // namespace filament_core
