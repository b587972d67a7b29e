// SPDX-License-Identifier: Apache-2.0
// MSFT_lod in scenes: of all levels, the finest alone is drawn, at any distance and with the same bits on both devices.
#include "tests/filament_core/engine/RenderFixture.h"

#include <gmock/gmock.h>

#include <string>

namespace filament {
namespace {

/// A green square, and before it two larger ones, red and blue, which `extension` may make its coarser levels.
/// `roots`: of the scene.
std::string squares(std::string const& extension, std::string const& roots) {
    return R"({ "asset": { "version": "2.0" }, "scenes": [ { "nodes": )" + roots + R"( } ],
    "extensionsUsed": [ "KHR_materials_unlit", "MSFT_lod" ],
    "nodes": [ { "name": "fine", "mesh": 0 )" +
           extension + R"( },
        { "name": "medium", "mesh": 1, "translation": [ 0, 0, 0.1 ], "scale": [ 1.5, 1.5, 1 ] },
        { "name": "coarse", "mesh": 2, "translation": [ 0, 0, 0.2 ], "scale": [ 2, 2, 1 ] } ],
    "materials": [
        { "pbrMetallicRoughness": { "baseColorFactor": [ 0, 1, 0, 1 ] }, "extensions": { "KHR_materials_unlit": {} } },
        { "pbrMetallicRoughness": { "baseColorFactor": [ 1, 0, 0, 1 ] }, "extensions": { "KHR_materials_unlit": {} } },
        { "pbrMetallicRoughness": { "baseColorFactor": [ 0, 0, 1, 1 ] }, "extensions": { "KHR_materials_unlit": {} } } ],
    "meshes": [ { "primitives": [ { "mode": 5, "material": 0, "attributes": { "POSITION": 0 } } ] },
                { "primitives": [ { "mode": 5, "material": 1, "attributes": { "POSITION": 0 } } ] },
                { "primitives": [ { "mode": 5, "material": 2, "attributes": { "POSITION": 0 } } ] } ],
    "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" } ],
    "bufferViews": [ { "buffer": 0, "byteLength": 48 } ], "buffers": [ { "byteLength": 48, "uri":
        "data:application/octet-stream;base64,AAAAvwAAAL8AAAAAAAAAPwAAAL8AAAAAAAAAvwAAAD8AAAAAAAAAPwAAAD8AAAAA" } ] })";
}

constexpr const char* kLevels =
        R"(, "extensions": { "MSFT_lod": { "ids": [ 1, 2 ] } }, "extras": { "MSFT_screencoverage": [ 0.5, 0.1, 0.01 ] })";

/// From near, and from where the squares cover a thousandth of the picture.
std::vector<Image> draw(Backend backend, std::string const& file) {
    auto engine = test::makeEngine(backend);
    if (!engine) return {};
    std::vector<Image> images;
    {
        const auto model = loadGltf(*engine, GltfMemory{ .file = std::as_bytes(std::span(file)) });
        if (!model) {
            ADD_FAILURE() << model.error().message;
            return {};
        }
        EXPECT_THAT(model->warnings(), testing::IsEmpty());
        Scene scene(*engine);
        scene.add(*model);
        for (const double meters : { 2.0, 30.0 }) {
            const View view{ .camera = Camera::lookAt({ 0, 0, meters }, { 0, 0, 0 }), .size = { 64, 48 } };
            images.push_back(test::renderLinear(*engine, scene, view));
        }
    }
    test::expectNoErrors(*engine);
    return images;
}

TEST(LevelsOfDetail, OnlyTheFinestIsDrawn) {
    for (const Backend backend : { Backend::Vulkan, Backend::Gles }) {
        const std::vector<Image> levels = draw(backend, squares(kLevels, "[ 0, 1, 2 ]"));
        const std::vector<Image> fine = draw(backend, squares("", "[ 0 ]"));
        const std::vector<Image> all = draw(backend, squares("", "[ 0, 1, 2 ]"));
        ASSERT_EQ(levels.size(), 2u);
        ASSERT_EQ(fine.size(), levels.size());
        ASSERT_EQ(all.size(), levels.size());
        for (size_t i = 0; i < levels.size(); ++i) {
            EXPECT_EQ(levels[i].pixels, fine[i].pixels) << "distance " << i;
            EXPECT_NE(levels[i].pixels, all[i].pixels) << "distance " << i;
            const float4 middle = test::halfPixel(levels[i], 32, 24);
            EXPECT_GT(middle.y, middle.x) << "the finest is green";
        }
    }
}

TEST(LevelsOfDetail, HaveTheSameBitsOnBothApis) {
    const std::string file = squares(kLevels, "[ 0, 1, 2 ]");
    const std::vector<Image> vulkan = draw(Backend::Vulkan, file), gles = draw(Backend::Gles, file);
    ASSERT_EQ(vulkan.size(), 2u);
    ASSERT_EQ(gles.size(), vulkan.size());
    for (size_t i = 0; i < vulkan.size(); ++i) EXPECT_EQ(vulkan[i].pixels, gles[i].pixels) << "distance " << i;
}

} // namespace
} // namespace filament
