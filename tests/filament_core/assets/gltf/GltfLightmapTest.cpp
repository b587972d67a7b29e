// SPDX-License-Identifier: Apache-2.0
// FILAMENT_lightmap, docs/baking.md.
#include "base/math/Half.h"
#include "filament_core/assets/image/Ktx2Encoder.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <gmock/gmock.h>

#include <array>
#include <cstring>

namespace filament_core::assets::test {
namespace {

using testing::HasSubstr;

std::string refusalOfLightmap(TestFile const& file) {
    const auto model = file.load();
    return model ? std::string() : model.error().message;
}

/// A triangle with texture coordinates, a texture of 2 x 1 half floats, and a material that names it.
TestFile litTriangle(Json extension,
                     Json texture = { { "extensions", { { "FILAMENT_lightmap", { { "source", 0 } } } } } }) {
    TestFile file = TestFile::triangle();
    file.attribute("TEXCOORD_0", std::vector<float>{ 0, 0, 1, 0, 0, 1 }, kFloat, "VEC2", 2);
    file.attribute("TEXCOORD_1", std::vector<float>{ 0, 0, 1, 0, 0, 1 }, kFloat, "VEC2", 2);
    Image image{ .width = 2, .height = 1, .format = backend::Format::RGBA16F };
    image.data.resize(16);
    const float values[8] = { 1000, 2, 3, 0.5f, 4, 5, 6, 1 };
    for (size_t i = 0; i < 8; ++i) {
        const uint16_t code = halfFromFloat(values[i]);
        std::memcpy(&image.data[i * 2], &code, 2);
    }
    file.root["images"] = { { { "bufferView", file.addView(encodeKtx2(image)) }, { "mimeType", "image/ktx2" } } };
    file.root["textures"] = { std::move(texture) };
    file.root["materials"] = { { { "extensions", { { "FILAMENT_lightmap", std::move(extension) } } } } };
    file.root["extensionsUsed"] = { "FILAMENT_lightmap" };
    file.primitive()["material"] = 0;
    return file;
}

TEST(GltfLightmap, KeepsTheHalfFloatsOfItsFile) {
    const ModelData model = loaded(litTriangle({ { "lightmapTexture", { { "index", 0 }, { "texCoord", 1 } } },
                                                 { "intensity", 64 },
                                                 { "directLight", true } }));
    ASSERT_EQ(model.materials.size(), 1u);
    LightMapData const& light = model.materials[0].light;
    ASSERT_TRUE(light.isUsed());
    EXPECT_EQ(light.map.uvSet, 1u);
    EXPECT_EQ(light.intensityLux, 64);
    EXPECT_TRUE(light.hasDirectLight);
    Image const& image = model.images[light.map.image];
    ASSERT_EQ(image.format, backend::Format::RGBA16F);
    EXPECT_EQ(image.levels, 1u);
    uint16_t first = 0;
    std::memcpy(&first, image.data.data(), 2);
    EXPECT_EQ(floatFromHalf(first), 1000);
    EXPECT_TRUE(model.warnings.empty()) << model.warnings.front();
}

// Others would be means over the borders of charts.
TEST(GltfLightmap, KeepsTheLevelsOfItsFileThoughTheyAreFew) {
    TestFile file = litTriangle({ { "lightmapTexture", { { "index", 0 } } } });
    Image image{ .width = 8, .height = 4, .levels = 2, .format = backend::Format::RGBA16F };
    image.data.resize(image.levelOffset(2));
    for (size_t i = 0; i < image.data.size() / 2; ++i) {
        const uint16_t code = halfFromFloat(i < 8 * 4 * 4 ? 1.0f : 3.0f);
        std::memcpy(&image.data[i * 2], &code, 2);
    }
    file.root["images"] = { { { "bufferView", file.addView(encodeKtx2(image)) }, { "mimeType", "image/ktx2" } } };
    const ModelData model = loaded(file);
    Image const& kept = model.images[model.materials[0].light.map.image];
    EXPECT_EQ(kept.levels, 2u);
    EXPECT_EQ(kept.data, image.data);
}

TEST(GltfLightmap, HasTheDefaultsOfItsDescription) {
    const ModelData model = loaded(litTriangle({ { "lightmapTexture", { { "index", 0 } } } }));
    EXPECT_EQ(model.materials[0].light.intensityLux, 1);
    EXPECT_FALSE(model.materials[0].light.hasDirectLight);
    EXPECT_FALSE(loaded(litTriangle(Json::object())).materials[0].light.isUsed());
}

/// Light of 8 x 8 halves and an openness of it in another file.
TestFile litWithOpenness(Image const& openness) {
    TestFile file =
            litTriangle({ { "lightmapTexture", { { "index", 0 } } } },
                        { { "extensions", { { "FILAMENT_lightmap", { { "source", 0 }, { "openness", 1 } } } } } });
    Image light{ .width = 8, .height = 8, .levels = 2, .format = backend::Format::RGBA16F };
    for (size_t i = 0; i < (64 + 16) * 4; ++i) {
        const uint16_t code = halfFromFloat(static_cast<float>(i));
        const auto bytes = std::as_bytes(std::span(&code, 1));
        light.data.insert(light.data.end(), bytes.begin(), bytes.end());
    }
    file.root["images"] = { { { "bufferView", file.addView(encodeKtx2(light)) }, { "mimeType", "image/ktx2" } },
                            { { "bufferView", file.addView(encodeKtx2(openness)) }, { "mimeType", "image/ktx2" } } };
    return file;
}

TEST(GltfLightmap, TakesItsAlphaFromTheOpenness) {
    Image openness{ .width = 8, .height = 8, .levels = 2, .format = backend::Format::R8 };
    for (int i = 0; i < 64 + 16; ++i) openness.data.push_back(static_cast<std::byte>(3 * i));
    const ModelData model = loaded(litWithOpenness(openness));
    Image const& image = model.images[model.materials[0].light.map.image];
    EXPECT_EQ(image.levels, 2u);
    for (size_t i = 0; i < 64 + 16; ++i) {
        std::array<uint16_t, 4> texel;
        std::memcpy(texel.data(), &image.data[8 * i], 8);
        EXPECT_EQ(floatFromHalf(texel[1]), static_cast<float>(4 * i + 1));
        EXPECT_NEAR(floatFromHalf(texel[3]), static_cast<float>(3 * i) / 255, 3e-4);
    }
}

TEST(GltfLightmap, AnOpennessOfAnotherSizeIsNamed) {
    Image openness{ .width = 8, .height = 4, .levels = 2, .format = backend::Format::R8 };
    openness.data.resize(32 + 8);
    EXPECT_THAT(refusalOfLightmap(litWithOpenness(openness)), HasSubstr("images[1] has 8 x 4 texels"));
    openness = { .width = 8, .height = 8, .levels = 1, .format = backend::Format::R8, .data = {} };
    openness.data.resize(64);
    EXPECT_THAT(refusalOfLightmap(litWithOpenness(openness)), HasSubstr("with 1 levels"));
    openness = { .width = 8, .height = 8, .levels = 2, .format = backend::Format::RGBA16F, .data = {} };
    openness.data.resize(640);
    EXPECT_THAT(refusalOfLightmap(litWithOpenness(openness)), HasSubstr("needs 8 bits"));
    TestFile file = litWithOpenness(openness);
    file.root["textures"][0]["extensions"]["FILAMENT_lightmap"]["openness"] = 9;
    EXPECT_THAT(refusalOfLightmap(file), HasSubstr("openness"));
}

// All codes of its bytes are blocks of BC6H.
TEST(GltfLightmap, StaysCompressedIfItIsAskedForAndHasNoOpenness) {
    Image blocks{ .width = 8, .height = 8, .levels = 2, .format = backend::Format::BC6HUfloat };
    for (size_t i = 0; i < 4 * 16 + 16; ++i) blocks.data.push_back(static_cast<std::byte>(i * 77 + 3));
    TestFile file = litTriangle({ { "lightmapTexture", { { "index", 0 } } } });
    file.root["images"] = { { { "bufferView", file.addView(encodeKtx2(blocks)) }, { "mimeType", "image/ktx2" } } };
    for (const GltfBlocks kept : { GltfBlocks::None, GltfBlocks::Data }) {
        const auto model = file.load({ .blocks = kept });
        ASSERT_TRUE(model) << model.error().message;
        Image const& image = model->images[model->materials[0].light.map.image];
        EXPECT_EQ(image.format, kept == GltfBlocks::None ? backend::Format::RGBA16F : backend::Format::BC6HUfloat);
        EXPECT_EQ(image.levels, 2u);
        EXPECT_EQ(image.data == blocks.data, kept == GltfBlocks::Data);
    }
}

TEST(GltfLightmap, MissingTexturesAreNamed) {
    EXPECT_THAT(refusalOfLightmap(litTriangle({ { "lightmapTexture", { { "index", 7 } } } })),
                HasSubstr("lightmapTexture"));
    EXPECT_THAT(refusalOfLightmap(litTriangle({ { "lightmapTexture", { { "index", 0 } } } }, Json::object())),
                HasSubstr("textures[0]"));
}

} // namespace
} // namespace filament_core::assets::test
