// SPDX-License-Identifier: Apache-2.0
// GltfNormals::WithVariance: which textures hold the variance of averaged normals.
#include "filament_core/assets/gltf/GltfWriter.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <gtest/gtest.h>

namespace filament_core::assets::test {
namespace {

constexpr uint32_t kStripes = 4;

/// A triangle whose images are stripes: the normals (0.6, 0, 0.8) and (-0.6, 0, 0.8).
TestFile striped(const char* material) {
    TestFile file = TestFile::triangle();
    file.normals({ 0, 0, 1, 0, 0, 1, 0, 0, 1 });
    file.attribute("TEXCOORD_0", std::vector<float>{ 0, 0, 1, 0, 0, 1 }, kFloat, "VEC2", 2);
    std::vector<std::byte> texels;
    for (uint32_t i = 0; i < kStripes * kStripes; ++i)
        for (const int code : { i % 2 ? 204 : 51, 128, 230, 255 }) texels.push_back(static_cast<std::byte>(code));
    const GlbImage image = *glbImageFromPixels("stripes", kStripes, kStripes, texels);
    file.root["images"].push_back({ { "bufferView", file.addView(image.file) }, { "mimeType", "image/png" } });
    file.root["textures"].push_back({ { "source", 0 } });
    file.root["materials"] = { Json::parse(material) };
    file.primitive()["material"] = 0;
    return file;
}

ModelData withWidths(const char* material) {
    Result<ModelData> model = striped(material).load({ .normals = GltfNormals::WithVariance });
    EXPECT_TRUE(model) << model.error().message;
    return model ? std::move(*model) : ModelData{};
}

int lastAlpha(ModelData const& model, TextureRef const& texture) {
    return std::to_integer<int>(model.images.at(texture.image).data.back());
}

constexpr const char* kNormalsAlone = R"({ "normalTexture": { "index": 0 } })";

TEST(GltfNormalVariance, FillAlphaOfNormalsIfTheyAreAskedFor) {
    const ModelData plain = loaded(striped(kNormalsAlone)), wide = withWidths(kNormalsAlone);
    EXPECT_FALSE(plain.materials[0].normal.hasVariance);
    EXPECT_EQ(lastAlpha(plain, plain.materials[0].normal), 255);
    EXPECT_TRUE(wide.materials[0].normal.hasVariance);
    EXPECT_NEAR(lastAlpha(wide, wide.materials[0].normal), 255 * 0.617, 1); // a mean of the length 0.8
    EXPECT_EQ(wide.images.size(), 1u);
    EXPECT_EQ(wide.images[0].data.size(), plain.images[0].data.size()) << "no memory";
}

TEST(GltfNormalVariance, ImagesWithOtherUsesStayWhatTheyAreThere) {
    const ModelData model = withWidths(R"({ "normalTexture": { "index": 0 }, "occlusionTexture": { "index": 0 },
        "pbrMetallicRoughness": { "baseColorTexture": { "index": 0 } } })");
    MaterialData const& material = model.materials[0];
    EXPECT_EQ(model.images.size(), 3u);
    EXPECT_EQ(lastAlpha(model, material.baseColor), 255);
    EXPECT_EQ(lastAlpha(model, material.occlusion), 255);
    EXPECT_LT(lastAlpha(model, material.normal), 200);
    EXPECT_EQ(model.images[material.baseColor.image].format, backend::Format::RGBA8Srgb);
    EXPECT_FALSE(material.occlusion.hasVariance || material.baseColor.hasVariance);
}

TEST(GltfNormalVariance, NormalsOfCoatsShareTheTextureOfTheSurface) {
    const ModelData model = withWidths(R"({ "normalTexture": { "index": 0 }, "extensions": {
        "KHR_materials_clearcoat": { "clearcoatFactor": 1, "clearcoatNormalTexture": { "index": 0 } },
        "KHR_materials_anisotropy": { "anisotropyStrength": 1, "anisotropyTexture": { "index": 0 } } } })");
    MaterialData const& material = model.materials[0];
    EXPECT_TRUE(material.clearCoat.normal.hasVariance);
    EXPECT_EQ(material.clearCoat.normal.image, material.normal.image);
    EXPECT_FALSE(material.anisotropy.map.hasVariance) << "directions are no normals";
    EXPECT_NE(material.anisotropy.map.image, material.normal.image);
}

TEST(GltfNormalVariance, KnowWhatDroppedLevelsAveragedAway) {
    TestFile file = striped(R"({ "normalTexture": { "index": 0 }, "occlusionTexture": { "index": 0 } })");
    const Result<ModelData> model = file.load({ .maxTextureSize = 2, .normals = GltfNormals::WithVariance });
    ASSERT_TRUE(model) << model.error().message;
    ASSERT_EQ(model->images.size(), 2u);
    for (Image const& image : model->images) EXPECT_EQ(image.width, 2u);
    EXPECT_NEAR(std::to_integer<int>(model->images[model->materials[0].normal.image].data[3]), 255 * 0.617, 1);
}

} // namespace
} // namespace filament_core::assets::test
