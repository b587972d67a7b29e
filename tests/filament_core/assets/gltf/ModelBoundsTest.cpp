// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/gltf/ModelBounds.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <gmock/gmock.h>

#include <numbers>

namespace filament_core::assets::test {
namespace {

constexpr double kHalfRoot = std::numbers::sqrt2 / 2;

ModelData loadedAs(TestFile const& file, GltfDeformation deformation, PositionStorage positions) {
    const Result<ModelData> model = file.load({ .storage = { .positions = positions }, .deformation = deformation });
    EXPECT_TRUE(model) << (model ? "" : model.error().message);
    return model ? *model : ModelData{};
}

/// The corners (0, 0, 0), (1, 0, 0), (0, 1, 0), turned by 45 degrees about z and moved.
TestFile turnedTriangle() {
    TestFile file = TestFile::triangle();
    file.root["nodes"] = Json::parse(R"([ { "mesh": 0, "translation": [ 10, 0, 0 ],
        "rotation": [ 0, 0, 0.38268343, 0.92387953 ] } ])");
    return file;
}

void expectBox(Box const& box, double3 min, double3 max) {
    EXPECT_LT(glm::length(box.min - min), 2e-5) << box.min.x << " " << box.min.y << " " << box.min.z;
    EXPECT_LT(glm::length(box.max - max), 2e-5) << box.max.x << " " << box.max.y << " " << box.max.z;
}

TEST(ModelBounds, TouchTheVerticesOfRotatedPartsHoweverTheyAreStored) {
    for (const auto positions : { PositionStorage::AsAuthored, PositionStorage::Half, PositionStorage::Unorm16 }) {
        const ModelData model = loadedAs(turnedTriangle(), GltfDeformation::AtRest, positions);
        expectBox(boundsOf(model), { 10 - kHalfRoot, 0, 0 }, { 10 + kHalfRoot, kHalfRoot, 0 });
    }
}

TEST(ModelBounds, FollowMorphTargetsOfTheRestPose) {
    TestFile file = turnedTriangle();
    const size_t target = file.add(std::vector<float>{ 0, 0, 0, 0, 0, 0, 0, 2, 0 }, kFloat, "VEC3", 3);
    file.root["meshes"][0]["primitives"][0]["targets"] = { { { "POSITION", target } } };
    file.root["meshes"][0]["weights"] = { 0.5 }; // the corner (0, 1, 0) moves to (0, 2, 0)
    for (const auto deformation : { GltfDeformation::AtRest, GltfDeformation::Kept }) {
        const ModelData model = loadedAs(file, deformation, PositionStorage::AsAuthored);
        expectBox(boundsOf(model), { 10 - 2 * kHalfRoot, 0, 0 }, { 10 + kHalfRoot, 2 * kHalfRoot, 0 });
    }
}

TEST(ModelBounds, OfAModelWithoutVerticesAreEmpty) { EXPECT_TRUE(boundsOf(ModelData{}).empty()); }

TEST(ModelBounds, AreTheUnionOfAllNodesThatShowAMesh) {
    TestFile file = TestFile::triangle();
    file.root["nodes"] = Json::parse(R"([ { "mesh": 0 }, { "mesh": 0, "translation": [ 0, 0, 5 ] },
        { "mesh": 0, "scale": [ 0.5, 0.5, 0.5 ] } ])");
    file.root["scenes"][0]["nodes"] = { 0, 1, 2 };
    const ModelData model = loadedAs(file, GltfDeformation::AtRest, PositionStorage::AsAuthored);
    expectBox(boundsOf(model), { 0, 0, 0 }, { 1, 1, 5 });
}

} // namespace
} // namespace filament_core::assets::test
