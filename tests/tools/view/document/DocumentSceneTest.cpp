// SPDX-License-Identifier: Apache-2.0
#include "tools/view/document/DocumentScene.h"
#include "toolkit/paths/Paths.h"
#include "tools/view/document/TextForms.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace filament_core::view {
namespace {

TEST(DocumentScene, HoldsWhatADocumentShows) {
    Document document;
    document.model = { .file = "models/car.glb", .fit = true, .variant = "red" };
    document.environment = { .file = "sky.hdr", .options = { .faceSize = 512 } };
    document.environment.settings.illuminance = Lux{ 12'345 };
    document.lights.push_back({ .light = PointLight{ .positionWorld = { 1, 2, 3 } } });
    document.lights.push_back({ .isOn = false, .light = SunLight{} });
    document.lights.push_back({ .light = SpotLight{}, .profileFile = "lamp.ies" });
    document.probes.push_back({ .name = "hall", .halfExtentMeters = { 2, 1, 3 }, .file = "hall.ktx2" });
    document.playback = { .animation = 2, .seconds = 1.5 };
    document.view.size = { 640, 360 };
    document.view.camera = Camera::lookAt({ 3, 2, 1 }, { 0, 1, 0 });
    document.view.quality.shadows = ShadowFilter::Pcss;
    document.look = "film.cube";
    document.materials.push_back({ .material = "paint" });
    const Result<DocumentScene> scene = sceneOf(document, false);
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    SceneFileContents const& contents = scene->file.contents();
    const auto absolute = [](const char* file) { return std::filesystem::absolute(file).string(); };
    ASSERT_EQ(contents.models.size(), 1u);
    EXPECT_EQ(contents.models[0].file, absolute("models/car.glb"));
    EXPECT_EQ(contents.models[0].variant, "red");
    EXPECT_TRUE(contents.models[0].copies.at(0).isFitted);
    EXPECT_EQ(contents.models[0].animation, 2u);
    EXPECT_EQ(contents.environment.file, absolute("sky.hdr"));
    EXPECT_EQ(contents.environment.options.faceSize, 512u);
    EXPECT_EQ(contents.environment.options.samples, EnvironmentLoadOptions{}.samples);
    EXPECT_EQ(contents.environment.settings.illuminance.value, 12'345);
    ASSERT_EQ(contents.lights.size(), 2u);
    EXPECT_EQ(contents.lights[1].profile, absolute("lamp.ies"));
    ASSERT_EQ(contents.probes.size(), 1u);
    EXPECT_EQ(contents.probes[0].place.halfExtentMeters, float3(2, 1, 3));
    EXPECT_EQ(contents.view.size, uint2(640, 360));
    EXPECT_EQ(contents.view.quality.shadows, ShadowFilter::Pcss);
    EXPECT_EQ(contents.look, absolute("film.cube"));
    EXPECT_EQ(*contents.camera.eye, double3(3, 2, 1));
    EXPECT_EQ(scene->missing, (std::vector<std::string>{ "edits of materials" }));
    EXPECT_EQ(sceneOf(document, true)->file.contents().environment.file, "") << "the model's own";
}

TEST(DocumentScene, IsADocumentAgain) {
    Document document;
    document.model = { .file = "/models/car.glb", .fit = true };
    document.environment = { .file = "/skies/sky.hdr", .prefersModels = false };
    document.lights.push_back({ .name = "point 1", .light = PointLight{ .positionWorld = { 1, 2, 3 } } });
    document.grids.push_back({ .file = "/grids/room.grid", .intensity = 2 });
    document.view.size = { 640, 360 };
    document.view.camera = Camera::lookAt({ 3, 2, 1 }, { 0, 1, 0 });
    document.view.effects.bloom.enabled = true;
    const std::filesystem::path file = tools::buildDir() / "viewer-test.scene.json";
    ASSERT_TRUE(sceneOf(document, false)->file.save(file).ok());
    const Result<Document> again = loadDocument(file);
    ASSERT_TRUE(again.ok()) << again.error().message;
    EXPECT_TRUE(again->model == document.model);
    EXPECT_TRUE(again->environment == document.environment);
    ASSERT_EQ(again->lights.size(), 1u);
    EXPECT_TRUE(again->lights[0] == document.lights[0]);
    EXPECT_TRUE(again->grids.at(0) == document.grids[0]);
    EXPECT_EQ(again->view.size, document.view.size);
    EXPECT_TRUE(again->view.effects.bloom.enabled);
    EXPECT_LT(glm::length(again->view.camera.worldFromView[2] - document.view.camera.worldFromView[2]), 1e-12);
    SceneFile once = sceneOf(document, false)->file, twice = sceneOf(*again, false)->file;
    ASSERT_TRUE(once.erase("camera").ok() && twice.erase("camera").ok()); // whose point `at` is computed again
    EXPECT_EQ(once.text(), twice.text());
    ASSERT_TRUE(loadAny(file).ok());

    std::ofstream(file) << R"({ "model": "a.glb", "copies": [ {}, {} ] })";
    EXPECT_EQ(loadDocument(file).error().message,
              "viewer-test.scene: the viewer does not show this scene file: copies: it shows one");
    std::ofstream(file) << R"({ "modell": "a.glb" })";
    EXPECT_NE(loadDocument(file).error().message.find("viewer-test.scene.json"), std::string::npos);
}

TEST(DocumentScene, SaysWhatNoSceneFileTakes) {
    Document document;
    document.view.camera.lens.verticalFovDegrees = 179.5f;
    const Result<DocumentScene> scene = sceneOf(document, false);
    ASSERT_FALSE(scene.ok());
    EXPECT_NE(scene.error().message.find("fovDegrees"), std::string::npos) << scene.error().message;
}

} // namespace
} // namespace filament_core::view
