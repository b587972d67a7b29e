// SPDX-License-Identifier: Apache-2.0
// Materials without glTF, for the path tracer: what it cannot know it refuses, and a mirror shows what paths find.
#include "tests/tools/accuracy/comparison/ComparisonFixture.h"
#include "tools/accuracy/Studio.h"
#include "tools/accuracy/TracedPicture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace filament_core::accuracy {
namespace {

tools::SceneSpec sceneOf(fs::path const& file) {
    const auto scenes = tools::readSceneFile(file);
    EXPECT_TRUE(scenes) << scenes.error().message;
    return scenes->front();
}

double rmsOf(Picture const& a, Picture const& b) {
    double sum = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const float3 difference = a.pixels[i] - b.pixels[i];
        sum += static_cast<double>(glm::dot(difference, difference));
    }
    return std::sqrt(sum / static_cast<double>(a.pixels.size()));
}

TEST(TracedMaterials, AreKnownByTheirParameters) {
    const fs::path file = scratch() / "no-parameters.json";
    std::ofstream(file) << R"({"model": {"material": ")"
                        << (tools::sourceDir() / "samples/materials/reflections_screen.mat").string() << R"("}})";
    const auto traced = tracedMaterialOf(sceneOf(file));
    ASSERT_FALSE(traced);
    EXPECT_EQ(traced.error().code, ErrorCode::Unsupported);
    EXPECT_NE(traced.error().message.find("this one has none"), std::string::npos) << traced.error().message;
}

TEST(TracedMaterials, OfCopiesHaveTheirOwnValues) {
    const tools::SceneSpec scene = sceneOf(tools::sourceDir() / "tools/accuracy/scenes/reflections.json");
    ASSERT_EQ(scene.copies.size(), 5u);
    const auto floor = tracedMaterialOf(scene, 0), wall = tracedMaterialOf(scene, 1);
    ASSERT_TRUE(floor && wall);
    EXPECT_EQ(floor->model.data->materials[0].emissiveFactor, float3(0));
    EXPECT_EQ(wall->model.data->materials[0].emissiveFactor, float3(0.5f, 0.35f, 0.2f));
}

// Off, the floor mirrors the sky; on, what stands on it.
TEST(TracedMaterials, AMirrorOfThePictureIsNearerToPathsThanOneOfTheEnvironment) {
    const tools::SceneFolders folders{ scratch() / "work", tools::assetDir() };
    auto studio = Studio::open(Backend::Vulkan, folders);
    ASSERT_TRUE(studio) << studio.error().message;
    const tools::SceneSpec scene = sceneOf(tools::sourceDir() / "tools/accuracy/scenes/reflections.json");
    jobs::JobSystem jobs;
    const Result<reference::ReferenceScene> traced = referenceSceneOf(scene, folders, jobs);
    ASSERT_TRUE(traced) << traced.error().message;
    const auto errorWith = [&](const char* change) {
        Settings settings = settingsOf(scene);
        EXPECT_TRUE(accuracy::change(settings, change));
        auto take = (*studio)->take(scene, settings, { 240, 136 }, true);
        EXPECT_TRUE(take) << take.error().message;
        const Result<Picture> picture = (*take)->shoot();
        const Result<TracedPicture> truth = trace(*traced, (*take)->view(), 64, jobs, reference::Integrator::Path);
        EXPECT_TRUE(picture && truth);
        return rmsOf(*picture, truth->picture);
    };
    const double on = errorWith("screenSpaceReflections=on"), off = errorWith("screenSpaceReflections=off");
    EXPECT_LT(on, off / 3) << "off: " << off;
}

} // namespace
} // namespace filament_core::accuracy
