// SPDX-License-Identifier: Apache-2.0
// A small Cornell box through all of the comparison.
#include "tools/accuracy/interiors/InteriorTable.h"

#include "filament_core/assets/files/FileBytes.h"
#include "filament_core/assets/gltf/GltfLoader.h"
#include "filament_core/assets/gltf/GltfWriter.h"
#include "tools/accuracy/interiors/WithoutMaterial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <unistd.h>

namespace filament_core::accuracy {
namespace {

class InteriorFolder : public ::testing::Test {
protected:
    void TearDown() override { std::filesystem::remove_all(mFolder); }
    std::filesystem::path mFolder =
            std::filesystem::temp_directory_path() / ("filament-interiors-" + std::to_string(::getpid()));
};

TEST_F(InteriorFolder, AModelWithoutAMaterialHasNoMeshOfIt) {
    const Result<std::vector<std::byte>> whole = assets::writeGlb(interiors::gallery().model);
    ASSERT_TRUE(whole);
    const Result<std::vector<std::byte>> part = withoutMaterial(*whole, "stone");
    ASSERT_TRUE(part) << part.error().message;
    ASSERT_TRUE(assets::replaceFile(mFolder / "part.glb", *part));
    jobs::JobSystem jobs({ .workers = 1 });
    const Result<assets::ModelData> model = assets::loadGltf(mFolder / "part.glb", jobs);
    ASSERT_TRUE(model) << model.error().message;
    size_t left = 0;
    for (assets::NodeData const& node : model->nodes) {
        if (node.mesh == assets::kNone) continue;
        ++left;
        for (assets::PrimitiveData const& primitive : model->meshes[node.mesh].primitives)
            EXPECT_NE(model->materials[primitive.material].name, "stone");
    }
    EXPECT_EQ(left, model->nodes.size() - 6) << "three columns and three pedestals";
    EXPECT_FALSE(withoutMaterial(*whole, "gold"));
    for (const size_t length : { 0, 1, 11, 12, 19, 20, 21, 100, 1000, 4000 }) // within the JSON
        EXPECT_FALSE(withoutMaterial(std::span(*whole).first(length), "stone")) << length;
}

TEST_F(InteriorFolder, ALightmapInASmallCornellBoxIsFourTimesNearerThanTheEnvironment) {
    const InteriorOptions options{ .chosen = { "cornell" },
                                   .backends = { Backend::Vulkan },
                                   .rounds = 0,
                                   .settings = { .size = { 48, 32 }, .mostSamples = 32, .coarseness = 3 },
                                   .folders = { mFolder, {} } };
    std::string last;
    double before = -1;
    const Result<InteriorResults> results = measureInteriors(options, [&](std::string const& what, double done) {
        EXPECT_GT(done, before) << what;
        before = done, last = what;
    });
    ASSERT_TRUE(results) << results.error().message;
    EXPECT_LE(before, 1);
    ASSERT_EQ(results->interiors.size(), 1u);
    InteriorResult const& box = results->interiors.front();
    using T = LightTechnique;
    const double environment = box.error(T::Environment), lightmap = box.error(T::Lightmap);
    RecordProperty("environment", std::to_string(environment));
    RecordProperty("lightmap", std::to_string(lightmap));
    EXPECT_LT(lightmap * 4, environment) << lightmap;
    EXPECT_LT(box.meanNoise() * 2, lightmap) << "the noise must not be the result";
    EXPECT_LT(box.error(T::LightmapAndProbes), lightmap * 1.1);
    EXPECT_LT(box.error(T::Grid), environment);
    EXPECT_FALSE(measureInteriors({ .chosen = { "cornel" } }, [](auto const&, double) {}));
}

} // namespace
} // namespace filament_core::accuracy
