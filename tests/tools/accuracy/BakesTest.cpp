// SPDX-License-Identifier: Apache-2.0
// Scenes whose light is baked before they are measured.
#include "tools/accuracy/Bakes.h"

#include <gmock/gmock.h>

#include <fstream>

namespace filament_core::accuracy {
namespace {

using testing::HasSubstr;

/// A box of 20 cm in a sky that is equally bright everywhere.
class BakedScenes : public testing::Test {
public:
    Result<tools::SceneSpec const*> bake(BakeChoice const& choice) { return mBakes.bake(spec, choice, mFolders); }

    const tools::SceneFolders mFolders{ std::filesystem::path(testing::TempDir()) / "bakes", {} };
    Bakes mBakes{ 32, 1024 };
    tools::SceneSpec spec = [] {
        const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "baked-scene.json";
        std::ofstream(file) << R"({ "description": "one box", "model": { "objects": [
            {"shape": "box", "scale": [0.2, 0.2, 0.2], "material": {"color": [0, 0, 0, 1], "roughness": 1}} ] },
            "environment": {"file": "white", "lux": 3000} })";
        const Result<std::vector<tools::SceneSpec>> read = tools::readSceneFile(file);
        EXPECT_TRUE(read) << read.error().message;
        return read->front();
    }();
};

TEST_F(BakedScenes, NothingToBakeIsTheSceneItself) {
    const Result<tools::SceneSpec const*> scene = bake({});
    ASSERT_TRUE(scene);
    EXPECT_EQ(*scene, &spec);
}

TEST_F(BakedScenes, AGridKnowsTheLightOfTheSkyAndIsBakedOnce) {
    const Result<tools::SceneSpec const*> scene = bake({ .gridMeters = 1 });
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(spec.grids.empty());
    ASSERT_EQ((*scene)->grids.size(), 1u);
    IrradianceGridDesc const& grid = (*scene)->grids.front().grid;
    ASSERT_TRUE(grid.probes);
    EXPECT_EQ(grid.probes->count, uint3(2));            // a cell of a metre
    EXPECT_NEAR(grid.halfExtentMeters.x, 0.05f, 1e-4f); // in the walls
    const Result<tools::SceneSpec const*> again = bake({ .gridMeters = 1 });
    ASSERT_TRUE(again);
    EXPECT_EQ(*again, *scene);
}

TEST_F(BakedScenes, ALightmapReplacesTheModelByAFile) {
    const Result<tools::SceneSpec const*> scene = bake({ .texelsPerMeter = 20 });
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_FALSE((*scene)->modelObject);
    const Result<std::filesystem::path> file = tools::modelFile(**scene, mFolders);
    ASSERT_TRUE(file);
    EXPECT_GT(std::filesystem::file_size(*file), 1000u);
}

TEST_F(BakedScenes, CopiesAreRefused) {
    spec.copies.push_back(double4x4(1.0));
    EXPECT_THAT(bake({ .gridMeters = 1 }).error().message, HasSubstr("once"));
}

} // namespace
} // namespace filament_core::accuracy
