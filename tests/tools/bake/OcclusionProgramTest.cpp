// SPDX-License-Identifier: Apache-2.0
// filament-bake --occlusion from outside, and its files as the loader reads them.
#include "filament_core/assets/gltf/GltfLoader.h"
#include "tests/tools/bake/BakeRun.h"
#include "toolkit/interiors/Interiors.h"

#include <gmock/gmock.h>

#include <set>

namespace filament_core::bake {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class OcclusionProgram : public test::BakeRun {
protected:
    void SetUp() override {
        BakeRun::SetUp();
        write("cornell.glb", interiors::cornellBox().model);
    }
    Result<assets::ModelData> load(std::filesystem::path const& file) {
        return assets::loadGltf(mFolder / file, mJobs);
    }
    jobs::JobSystem mJobs{ { .workers = 1 } };
    const std::string mQuick = "cornell.glb --density 6 --samples 32 --held-out 64 ";
};

TEST_F(OcclusionProgram, WritesATextureOfTheSameBytesForAnyThreadsAndParts) {
    const std::string quick = mQuick + "--occlusion texture ";
    const Outcome outcome = run(quick + "--threads 1 --out one");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    ASSERT_EQ(run(quick + "--threads 3 --out three").status, 0);
    ASSERT_EQ(run(quick + "--shard 0/2 --out 0").status, 0);
    ASSERT_EQ(run(quick + "--shard 1/2 --out 1").status, 0);
    ASSERT_EQ(run(quick + "--merge 0 1 --out merged").status, 0);
    for (const char* name : { "baked.glb", "report.json", "occlusion.png", "error.png" }) {
        EXPECT_EQ(read(std::filesystem::path("one") / name), read(std::filesystem::path("three") / name)) << name;
        EXPECT_EQ(read(std::filesystem::path("one") / name), read(std::filesystem::path("merged") / name)) << name;
    }
    const Result<assets::ModelData> model = load("one/baked.glb");
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_TRUE(model->warnings.empty()) << model->warnings.front();
    for (assets::MeshData const& mesh : model->meshes) {
        for (assets::PrimitiveData const& primitive : mesh.primitives) {
            assets::MaterialData const& material = model->materials[primitive.material];
            ASSERT_NE(material.occlusion.image, assets::kNone);
            EXPECT_EQ(material.occlusion.uvSet, 1u);
            EXPECT_TRUE(material.hasBentNormals);
            EXPECT_FALSE(material.light.isUsed());
        }
    }
    const std::string report = read("one/report.json");
    EXPECT_THAT(report, HasSubstr("\"interpolation\""));
    EXPECT_THAT(report, Not(HasSubstr("Lux")));
}

TEST_F(OcclusionProgram, WritesValuesOfVerticesWithoutAnExtension) {
    const std::string quick = mQuick + "--occlusion vertex ";
    const Outcome outcome = run(quick + "--threads 1 --out one");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    ASSERT_EQ(run(quick + "--threads 3 --out three").status, 0);
    EXPECT_EQ(read("one/baked.glb"), read("three/baked.glb"));
    EXPECT_THAT(read("one/baked.glb"), HasSubstr("_OCCLUSION"));
    EXPECT_THAT(read("one/baked.glb"), HasSubstr("_BENT_NORMAL"));
    EXPECT_THAT(read("one/baked.glb"), Not(HasSubstr("FILAMENT_")));
    const Result<assets::ModelData> model = load("one/baked.glb"), before = load("cornell.glb");
    ASSERT_TRUE(model) << model.error().message;
    ASSERT_TRUE(before);
    EXPECT_TRUE(model->warnings.empty()) << model->warnings.front();
    assets::MaterialData const& material = model->materials[model->meshes[0].primitives[0].material];
    ASSERT_NE(material.occlusion.image, assets::kNone);
    EXPECT_EQ(material.occlusion.uvSet, 1u);
    EXPECT_FALSE(material.hasBentNormals);
    assets::Image const& ramp = model->images[material.occlusion.image];
    EXPECT_EQ(ramp.width, 256u);
    EXPECT_EQ(ramp.height, 1u);
}

// As of lightmaps: a texture and materials for each page.
TEST_F(OcclusionProgram, GoesOnToFurtherPagesWhereOneIsFull) {
    const Outcome outcome = run(mQuick + "--occlusion texture --max-size 32 --levels 3 --out pages");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr(" pages"));
    const Result<assets::ModelData> model = load("pages/baked.glb");
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_TRUE(model->warnings.empty()) << model->warnings.front();
    std::set<uint32_t> images;
    for (assets::MeshData const& mesh : model->meshes) {
        for (assets::PrimitiveData const& primitive : mesh.primitives) {
            assets::MaterialData const& material = model->materials[primitive.material];
            ASSERT_NE(material.occlusion.image, assets::kNone);
            images.insert(material.occlusion.image);
            EXPECT_EQ(material.occlusion.sampler.mipFilter, MipFilter::Linear);
            EXPECT_TRUE(material.hasBentNormals);
        }
    }
    EXPECT_GT(images.size(), 1u);
    for (const uint32_t image : images) EXPECT_EQ(model->images[image].width, model->images[image].height);
    EXPECT_TRUE(std::filesystem::exists(mFolder / "pages/occlusion-1.png"));
    ASSERT_EQ(run(mQuick + "--occlusion vertex --max-size 32 --levels 3 --out vertices").status, 0);
    EXPECT_TRUE(std::filesystem::exists(mFolder / "vertices/occlusion-1.png"));
}

TEST_F(OcclusionProgram, EndsAtItsDistance) {
    const auto meanOf = [&](std::string const& more) {
        EXPECT_EQ(run(mQuick + "--occlusion texture --out mean " + more).status, 0);
        const std::string report = read("mean/report.json");
        return std::stod(report.substr(report.rfind("\"mean\": ") + 8));
    };
    EXPECT_GT(meanOf("--occlusion-distance 0.1"), meanOf("") + 0.2);
}

TEST_F(OcclusionProgram, RefusalsNameTheOptionAndTheCure) {
    EXPECT_THAT(run("cornell.glb --occlusion pixel").text, HasSubstr("texture or vertex"));
    EXPECT_THAT(run("cornell.glb --occlusion-distance 1").text, HasSubstr("needs --occlusion"));
    EXPECT_THAT(run("cornell.glb --occlusion vertex --occlusion-distance 0").text, HasSubstr("--occlusion-distance"));
    EXPECT_THAT(run("cornell.glb --occlusion texture --grid g.json").text, HasSubstr("without it"));
    EXPECT_THAT(run("cornell.glb --occlusion texture --store bc6h").text, HasSubstr("without them"));
}

} // namespace
} // namespace filament_core::bake
