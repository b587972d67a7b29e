// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/environment/AnalyticSky.h"
#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/gltf/GltfLoader.h"
#include "filament_core/assets/image/HdrReader.h"
#include "toolkit/showcase/Showcase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unistd.h>

namespace filament_core::showcase {
namespace {

class ShowcaseFiles : public ::testing::Test {
protected:
    std::filesystem::path mFolder =
            std::filesystem::temp_directory_path() / ("showcase_tests_" + std::to_string(::getpid()));
    void TearDown() override { std::filesystem::remove_all(mFolder); }
};

uint32_t triangles(assets::GlbScene const& scene) {
    size_t count = 0;
    for (auto const& mesh : scene.meshes) {
        for (auto const& primitive : mesh.primitives) count += primitive.indices.size() / 3;
    }
    return static_cast<uint32_t>(count);
}

template <class Predicate>
bool anyMaterial(assets::GlbScene const& scene, Predicate const& predicate) {
    return std::any_of(scene.materials.begin(), scene.materials.end(), predicate);
}

TEST(Showcase, ShowsEveryKindOfMaterialWithinItsBudget) {
    jobs::JobSystem jobs;
    const Result<assets::GlbScene> scene = makeScene(jobs);
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    EXPECT_LT(triangles(*scene), 150'000u);
    using assets::AlphaMode, assets::MaterialData;
    EXPECT_TRUE(
            anyMaterial(*scene, [](MaterialData const& m) { return m.alphaMode == AlphaMode::Mask && m.doubleSided; }));
    EXPECT_TRUE(anyMaterial(*scene, [](MaterialData const& m) { return m.alphaMode == AlphaMode::Blend; }));
    EXPECT_TRUE(anyMaterial(*scene, [](MaterialData const& m) { return m.emissiveStrength > 5; }));
    EXPECT_TRUE(anyMaterial(*scene, [](MaterialData const& m) { return m.normal.image != assets::kNone; }));
    EXPECT_TRUE(anyMaterial(*scene, [](MaterialData const& m) { return m.emissive.image != assets::kNone; }));
    for (const float metallic : { 0.0f, 1.0f }) {
        for (const float roughness : { 0.0f, 0.5f, 1.0f }) {
            EXPECT_TRUE(anyMaterial(*scene,
                                    [=](MaterialData const& m) {
                                        return m.metallicFactor == metallic &&
                                               std::abs(m.roughnessFactor - roughness) < 1e-6f;
                                    }))
                    << "metallic " << metallic << ", roughness " << roughness;
        }
    }
}

TEST(Showcase, HasTheSameBytesForAnyNumberOfWorkers) {
    jobs::JobSystem none({ .workers = 0 }), three({ .workers = 3 });
    const auto alone = makeScene(none), together = makeScene(three);
    ASSERT_TRUE(alone.ok() && together.ok());
    EXPECT_TRUE(*assets::writeGlb(*alone) == *assets::writeGlb(*together));
}

TEST_F(ShowcaseFiles, LoadWithoutAWarningAndFillTheStage) {
    jobs::JobSystem jobs;
    const Result<Files> files = writeFiles(mFolder / "new", jobs);
    ASSERT_TRUE(files.ok()) << files.error().message;
    const Result<assets::ModelData> model = assets::loadGltf(files->model, jobs);
    ASSERT_TRUE(model.ok()) << model.error().message;
    EXPECT_TRUE(model->warnings.empty()) << model->warnings.front();
    EXPECT_EQ(model->lights.size(), 1u);
    for (auto const& node : model->nodes) {
        if (node.mesh == assets::kNone) continue;
        for (auto const& primitive : model->meshes[node.mesh].primitives) {
            const double3 low(node.worldFromNode * double4(double3(primitive.boundsMin), 1));
            EXPECT_GE(low.y, -0.51) << node.name;
            EXPECT_LE(std::abs(node.worldFromNode[3].x), 5.0) << node.name;
        }
    }
}

TEST_F(ShowcaseFiles, TheSkyFitsTheDefaultExposureAndHasNoDisc) {
    jobs::JobSystem jobs;
    const Result<Files> files = writeFiles(mFolder, jobs);
    ASSERT_TRUE(files.ok()) << files.error().message;
    const Result<assets::HdrImage> sky = assets::readHdrImage(files->environment);
    ASSERT_TRUE(sky.ok()) << sky.error().message;
    EXPECT_EQ(sky->width, 2 * sky->height);
    float brightest = 0;
    for (float3 const& pixel : sky->pixels) brightest = std::max({ brightest, pixel.x, pixel.y, pixel.z });
    EXPECT_LT(brightest, 10.0f); // the disc would be above 10^4
    EXPECT_GT(brightest, 0.2f);  // a clear sky near the sun has some 10 kcd/m^2
}

TEST_F(ShowcaseFiles, TheSkyForModelsOfUsersIsThatOfTheShowcaseAndMadeOnce) {
    jobs::JobSystem jobs;
    const Result<Files> files = writeFiles(mFolder, jobs);
    const Result<std::filesystem::path> sky = writeSky(mFolder, jobs);
    ASSERT_TRUE(files.ok() && sky.ok());
    const auto made = assets::readFileBytes(*sky);
    EXPECT_TRUE(*made == *assets::readFileBytes(files->environment));
    ASSERT_TRUE(assets::replaceFile(*sky, {}).ok());
    EXPECT_EQ(writeSky(mFolder, jobs).value(), *sky);
    EXPECT_EQ(std::filesystem::file_size(*sky), 0u) << "what is there is kept";
}

TEST_F(ShowcaseFiles, AFolderThatCannotBeMadeIsAnErrorThatNamesIt) {
    jobs::JobSystem jobs({ .workers = 0 });
    ASSERT_TRUE(assets::replaceFile(mFolder / "file", {}).ok());
    const Result<Files> files = writeFiles(mFolder / "file" / "below", jobs);
    ASSERT_FALSE(files.ok());
    EXPECT_NE(files.error().message.find("below"), std::string::npos) << files.error().message;
}

} // namespace
} // namespace filament_core::showcase
