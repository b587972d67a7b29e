// SPDX-License-Identifier: Apache-2.0
// KHR_materials_variants through the public API: a copy of a model changes its materials, and nothing else does.
#include "tests/filament_core/engine/RenderFixture.h"

#include <unistd.h>

#include <fstream>

namespace filament_core {
namespace {

/// Two unlit triangles side by side: the left one is blue, in variant "signal red" red and in "green" green; the right
/// one is white and changes in "green" only.
constexpr const char* kModel = R"({ "asset": { "version": "2.0" }, "scene": 0, "scenes": [ { "nodes": [ 0, 1 ] } ],
    "extensionsUsed": [ "KHR_materials_unlit", "KHR_materials_variants" ],
    "extensions": { "KHR_materials_variants": { "variants": [ { "name": "signal red" }, { "name": "green" } ] } },
    "nodes": [ { "mesh": 0, "name": "left" }, { "mesh": 1, "name": "right", "translation": [ 2, 0, 0 ] } ],
    "materials": [
        { "pbrMetallicRoughness": { "baseColorFactor": [ 0, 0, 1, 1 ] }, "extensions": { "KHR_materials_unlit": {} } },
        { "pbrMetallicRoughness": { "baseColorFactor": [ 1, 0, 0, 1 ] }, "extensions": { "KHR_materials_unlit": {} } },
        { "pbrMetallicRoughness": { "baseColorFactor": [ 0, 1, 0, 1 ] }, "extensions": { "KHR_materials_unlit": {} } },
        { "pbrMetallicRoughness": { "baseColorFactor": [ 1, 1, 1, 1 ] }, "extensions": { "KHR_materials_unlit": {} } } ],
    "meshes": [
        { "primitives": [ { "attributes": { "POSITION": 0 }, "material": 0, "extensions": { "KHR_materials_variants": {
            "mappings": [ { "material": 1, "variants": [ 0 ] }, { "material": 2, "variants": [ 1 ] } ] } } } ] },
        { "primitives": [ { "attributes": { "POSITION": 0 }, "material": 3, "extensions": { "KHR_materials_variants": {
            "mappings": [ { "material": 2, "variants": [ 1 ] } ] } } } ] } ],
    "accessors": [ { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3" } ],
    "bufferViews": [ { "buffer": 0, "byteLength": 36 } ],
    "buffers": [ { "byteLength": 36,
        "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA" } ] })";

const float4 kRedPaint(1, 0, 0, 1), kGreenPaint(0, 1, 0, 1), kBluePaint(0, 0, 1, 1), kWhitePaint(1);

class ModelVariantsTest : public testing::TestWithParam<Backend> {
protected:
    void SetUp() override {
        mPath = std::filesystem::temp_directory_path() / ("variants-" + std::to_string(getpid()) + ".gltf");
        std::ofstream(mPath) << kModel;
        engine = test::makeEngine(GetParam());
        ASSERT_TRUE(engine);
        auto loaded = loadGltf(*engine, mPath);
        ASSERT_TRUE(loaded) << loaded.error().message;
        model.emplace(std::move(*loaded));
        scene.emplace(*engine);
    }
    void TearDown() override {
        std::filesystem::remove(mPath);
        if (engine) test::expectNoErrors(*engine);
    }

    /// The colours of the left and the right triangle of a copy moved up by `y`.
    std::pair<float4, float4> colors(double y = 0) {
        const auto at = [&](double x) {
            const View view{ .camera = Camera::lookAt({ x + 0.25, y + 0.25, 0.2 }, { x + 0.25, y + 0.25, 0 },
                                                      { .verticalFovDegrees = 10 }),
                             .size = { 1, 1 } };
            return test::halfPixel(test::renderLinear(*engine, *scene, view), 0, 0);
        };
        return { at(0), at(2) };
    }

    std::optional<Engine> engine;
    std::optional<Model> model;
    std::optional<Scene> scene;
    std::filesystem::path mPath;
};

TEST_P(ModelVariantsTest, AVariantChangesWhatItNamesAndTheEmptyNameBringsTheFileBack) {
    const Node copy = scene->add(*model);
    EXPECT_EQ(model->variantNames(), (std::vector<std::string>{ "signal red", "green" }));
    EXPECT_EQ(colors(), std::pair(kBluePaint, kWhitePaint));
    ASSERT_TRUE(scene->setVariant(copy, "signal red"));
    EXPECT_EQ(colors(), std::pair(kRedPaint, kWhitePaint));
    ASSERT_TRUE(scene->setVariant(copy, "green"));
    EXPECT_EQ(colors(), std::pair(kGreenPaint, kGreenPaint));
    ASSERT_TRUE(scene->setVariant(copy, ""));
    EXPECT_EQ(colors(), std::pair(kBluePaint, kWhitePaint));
}

TEST_P(ModelVariantsTest, CopiesOfAModelChangeOneByOne) {
    const Node low = scene->add(*model);
    double4x4 above(1.0);
    above[3].y = 5;
    const Node high = scene->add(*model, above);
    ASSERT_TRUE(scene->setVariant(high, "green"));
    EXPECT_EQ(colors(), std::pair(kBluePaint, kWhitePaint));
    EXPECT_EQ(colors(5), std::pair(kGreenPaint, kGreenPaint));
    scene->remove(high);
    ASSERT_TRUE(scene->setVariant(low, "signal red"));
    EXPECT_EQ(colors(), std::pair(kRedPaint, kWhitePaint));
}

TEST_P(ModelVariantsTest, WhatWasRemovedFromACopyIsLeftAlone) {
    const Node copy = scene->add(*model);
    scene->remove(scene->findNode("left", copy));
    ASSERT_TRUE(scene->setVariant(copy, "green"));
    EXPECT_EQ(colors().second, kGreenPaint);
    EXPECT_EQ(scene->renderableCount(), 1u);
}

TEST_P(ModelVariantsTest, AnUnknownNameSaysWhatMayHaveBeenMeantAndChangesNothing) {
    const Node copy = scene->add(*model);
    const Result<void> done = scene->setVariant(copy, "gren");
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(done.error().message, model->name() + " has no variant 'gren'; did you mean 'green'?");
    EXPECT_EQ(colors(), std::pair(kBluePaint, kWhitePaint));
}

TEST_P(ModelVariantsTest, ANodeThatIsNoCopyIsRefusedByName) {
    const Node copy = scene->add(*model);
    const Result<void> done = scene->setVariant(scene->findNode("left", copy), "green");
    ASSERT_FALSE(done);
    EXPECT_NE(done.error().message.find("'left'"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(BothApis, ModelVariantsTest, testing::ValuesIn(test::kBothApis),
                         [](auto const& test) { return std::string(toString(test.param)); });

} // namespace
} // namespace filament_core
