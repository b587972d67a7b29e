// SPDX-License-Identifier: Apache-2.0
// Textures of models with more than 8 bits a channel, as shaders see them on both APIs.
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/gltf/GltfWriter.h"
#include "tests/filament_core/engine/materials/MaterialStage.h"

#include <filament_core/Gltf.h>
#include <filament_core/Image.h>

#include <cstring>
#include <memory>
#include <set>

namespace filament_core {
namespace {

using test::MaterialStage;

constexpr uint32_t kFineSide = 8;

/// 64 neighbouring codes of 10 bits: with 8 bits there would be 16 of them.
std::vector<std::byte> finePng() {
    Image image{ .width = kFineSide, .height = kFineSide, .format = Format::RGB10A2, .pixels = {} };
    for (uint32_t i = 0; i < kFineSide * kFineSide; ++i) {
        const uint32_t code = 600 + i, word = code | code << 10 | code << 20;
        for (int byte = 0; byte < 4; ++byte) image.pixels.push_back(static_cast<std::byte>(word >> (8 * byte)));
    }
    const std::filesystem::path file = test::folderOfThisTest() / "fine.png";
    EXPECT_TRUE(savePng(file, image));
    return *assets::readFileBytes(file);
}

/// A square with one texel per pixel at its centre; `size`: of the view.
Image fineSquare(uint32_t size) {
    assets::GlbScene scene{ .images = { { "fine", finePng() } } };
    assets::MaterialData material{ .name = "fine", .unlit = true };
    material.baseColor = {
        .image = 0,
        .sampler = { .magFilter = Filter::Nearest, .minFilter = Filter::Nearest, .mipFilter = MipFilter::Nearest }
    };
    scene.materials.push_back(material);
    scene.meshes.push_back({ .name = "square",
                             .primitives = { { .positions = { { -1, 1, 0 }, { -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 } },
                                               .uvs = { { 0, 0 }, { 0, 1 }, { 1, 1 }, { 1, 0 } },
                                               .indices = { 0, 1, 2, 0, 2, 3 },
                                               .material = 0 } } });
    scene.nodes.push_back({ .name = "square", .mesh = 0 });
    const Result<std::vector<std::byte>> glb = assets::writeGlb(scene);
    EXPECT_TRUE(glb);
    return test::onBothApis([&](MaterialStage& stage) {
        Result<Model> model = loadGltf(stage.engine, GltfMemory{ .file = *glb, .name = "fine.glb" });
        ASSERT_TRUE(model) << model.error().message;
        const auto kept = std::make_shared<Model>(std::move(*model));
        stage.keep(kept);
        stage.scene.add(*kept);
        stage.view.camera = Camera::lookAt({ 0, 0, 1 }, { 0, 0, 0 }, { .verticalFovDegrees = 90 });
        stage.view.size = { size, size };
    });
}

TEST(DeepTextures, MoreThan8BitsReachTheShader) {
    const Image seen = fineSquare(kFineSide);
    std::set<float> values;
    for (uint32_t i = 0; i < kFineSide * kFineSide; ++i)
        values.insert(test::halfPixel(seen, i % kFineSide, i / kFineSide).y);
    EXPECT_GT(values.size(), 60u) << "halves hold almost all of them apart";
    EXPECT_GT(test::halfPixel(seen, 7, 7).y, test::halfPixel(seen, 0, 0).y);
}

// The mean light of the image, between those of its first and last code.
TEST(DeepTextures, TheirMipsAreSeen) {
    const Image all = fineSquare(kFineSide), one = fineSquare(1);
    float sum = 0;
    for (uint32_t i = 0; i < kFineSide * kFineSide; ++i) sum += test::halfPixel(all, i % kFineSide, i / kFineSide).y;
    EXPECT_NEAR(test::halfPixel(one, 0, 0).y, sum / (kFineSide * kFineSide), sum / (kFineSide * kFineSide) / 512);
}

} // namespace
} // namespace filament_core
