// SPDX-License-Identifier: Apache-2.0
// FILAMENT_lightmap, docs/baking.md.
#include "base/math/Half.h"
#include "filament_core/assets/image/Ktx2Encoder.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <gmock/gmock.h>

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

TEST(GltfLightmap, MissingTexturesAreNamed) {
    EXPECT_THAT(refusalOfLightmap(litTriangle({ { "lightmapTexture", { { "index", 7 } } } })),
                HasSubstr("lightmapTexture"));
    EXPECT_THAT(refusalOfLightmap(litTriangle({ { "lightmapTexture", { { "index", 0 } } } }, Json::object())),
                HasSubstr("textures[0]"));
}

} // namespace
} // namespace filament_core::assets::test
