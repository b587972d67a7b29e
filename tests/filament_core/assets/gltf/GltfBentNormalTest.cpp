// SPDX-License-Identifier: Apache-2.0
// FILAMENT_bent_normal, docs/baking.md.
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <gmock/gmock.h>

namespace filament_core::assets::test {
namespace {

using testing::HasSubstr;

constexpr const char* kPixel =
        "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mP8z8BQDwAEhQGA"
        "hKmMIQAAAABJRU5ErkJggg==";

/// A triangle whose material is `material` with the extension.
TestFile bentTriangle(Json material) {
    TestFile file = TestFile::triangle();
    file.attribute("TEXCOORD_0", std::vector<float>{ 0, 0, 1, 0, 0, 1 }, kFloat, "VEC2", 2);
    file.root["images"] = { { { "uri", kPixel } } };
    file.root["textures"] = { { { "source", 0 } } };
    material["extensions"]["FILAMENT_bent_normal"] = Json::object();
    file.root["materials"] = { std::move(material) };
    file.root["extensionsUsed"] = { "FILAMENT_bent_normal" };
    file.primitive()["material"] = 0;
    return file;
}

TEST(GltfBentNormal, IsOfTheOcclusionTexture) {
    const ModelData model = loaded(bentTriangle({ { "occlusionTexture", { { "index", 0 } } } }));
    EXPECT_TRUE(model.materials[0].hasBentNormals);
    EXPECT_TRUE(model.warnings.empty()) << model.warnings.front();
    TestFile without = bentTriangle({ { "occlusionTexture", { { "index", 0 } } } });
    without.root["materials"][0].erase("extensions");
    EXPECT_FALSE(loaded(without).materials[0].hasBentNormals);
}

TEST(GltfBentNormal, WithoutAnOcclusionTextureIsLeftOut) {
    const ModelData model = loaded(bentTriangle(Json::object()));
    EXPECT_FALSE(model.materials[0].hasBentNormals);
    ASSERT_EQ(model.warnings.size(), 1u);
    EXPECT_THAT(model.warnings[0],
                HasSubstr("materials[0].extensions.FILAMENT_bent_normal: needs an occlusionTexture"));
}

} // namespace
} // namespace filament_core::assets::test
