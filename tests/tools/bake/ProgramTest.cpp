// SPDX-License-Identifier: Apache-2.0
// filament-bake from outside, and the file that it writes as the loader reads it.
#include "base/math/Half.h"
#include "filament_core/assets/gltf/GltfLoader.h"
#include "tests/tools/bake/BakeRun.h"
#include "toolkit/interiors/Interiors.h"
#include "toolkit/json/JsonFile.h"

#include <filament_core/IrradianceGrid.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <map>
#include <set>

namespace filament_core::bake {
namespace {

using ::testing::HasSubstr;

class BakeProgram : public test::BakeRun {
protected:
    void SetUp() override {
        BakeRun::SetUp();
        write("cornell.glb", interiors::cornellBox().model);
    }
    /// Ends the program as soon as the first block is in its journal.
    Outcome stopOnceBegun(std::string const& arguments, std::string const& journal, std::string const& signal) const {
        // In the foreground: what a shell starts in the background ignores SIGINT.
        return shell("p=$$; { until [ $(stat -c %s '" + journal +
                     "' 2> /dev/null || echo 0) -gt 100 ] || ! kill -0 $p; do sleep 0.02; done; kill -" + signal +
                     " $p; } & exec '" + program() + "' " + arguments);
    }
};

constexpr const char* kQuick = "cornell.glb --density 6 --samples 32 ";

TEST_F(BakeProgram, WritesAModelWhoseMaterialsNameTheLightmap) {
    const Outcome outcome = run(std::string(kQuick) + "--out whole");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_FALSE(std::filesystem::exists(mFolder / "whole/bake.part"));
    for (const char* name : { "report.json", "report.md", "lightmap.png", "error.png" })
        EXPECT_GT(std::filesystem::file_size(mFolder / "whole" / name), 100u) << name;

    jobs::JobSystem jobs({ .workers = 1 });
    const Result<assets::ModelData> model = assets::loadGltf(mFolder / "whole/baked.glb", jobs);
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_TRUE(model->warnings.empty()) << model->warnings.front();
    const Result<assets::ModelData> before = assets::loadGltf(mFolder / "cornell.glb", jobs);
    ASSERT_TRUE(before);
    EXPECT_EQ(model->nodes.size(), before->nodes.size());
    EXPECT_EQ(model->meshes.size(), before->meshes.size() + 1) << "the blocks share a mesh no longer";
    for (assets::MeshData const& mesh : model->meshes) {
        for (assets::PrimitiveData const& primitive : mesh.primitives) {
            EXPECT_TRUE(primitive.hasUv1);
            assets::MaterialData const& material = model->materials[primitive.material];
            ASSERT_TRUE(material.light.isUsed()) << material.name;
            EXPECT_EQ(material.light.map.uvSet, 1u);
            EXPECT_FALSE(material.light.hasDirectLight);
            assets::Image const& image = model->images[material.light.map.image];
            EXPECT_EQ(image.format, backend::Format::RGBA16F);
            EXPECT_EQ(image.levels, 4u);
            EXPECT_EQ(material.light.map.sampler.mipFilter, MipFilter::Linear);
        }
    }
}

TEST_F(BakeProgram, PartsOnAnyThreadsMergeToTheBytesOfOneRun) {
    ASSERT_EQ(run(std::string(kQuick) + "--threads 2 --out whole").status, 0);
    ASSERT_EQ(run(std::string(kQuick) + "--shard 0/3 --threads 1 --out 0").status, 0);
    ASSERT_EQ(run(std::string(kQuick) + "--shard 1/3 --out 1").status, 0);
    const Outcome early = run(std::string(kQuick) + "--merge 0/bake.part 1/bake.part --out merged");
    EXPECT_EQ(early.status, 1);
    EXPECT_THAT(early.text, HasSubstr("are missing"));
    ASSERT_EQ(run(std::string(kQuick) + "--shard 2/3 --out 2").status, 0);
    const Outcome merged = run(std::string(kQuick) + "--merge 2/bake.part 0 1 --out merged");
    ASSERT_EQ(merged.status, 0) << merged.text;
    for (const char* name : { "baked.glb", "report.json", "lightmap.png", "error.png" })
        EXPECT_EQ(read(std::filesystem::path("whole") / name), read(std::filesystem::path("merged") / name)) << name;
}

// Stopped after a while, by Ctrl-C or by a kill that it does not see coming, and started again: the bytes of a run that
// nothing stopped.
TEST_F(BakeProgram, ContinuesAfterCtrlCAndAfterAKill) {
    write("gallery.glb", interiors::gallery().model);
    const std::string slow = "gallery.glb --density 4 --samples 32 --threads 1 ";
    ASSERT_EQ(run(slow + "--out whole").status, 0);
    for (const char* signal : { "INT", "KILL" }) {
        const std::string folder = std::string("stopped-") + signal;
        const Outcome stopped = stopOnceBegun(slow + "--out " + folder, folder + "/bake.part", signal);
        ASSERT_TRUE(std::filesystem::exists(mFolder / folder / "bake.part")) << stopped.text;
        ASSERT_FALSE(std::filesystem::exists(mFolder / folder / "baked.glb")) << stopped.text;
        const Outcome rest = run(slow + "--out " + folder);
        ASSERT_EQ(rest.status, 0) << rest.text;
        for (const char* name : { "baked.glb", "report.json", "lightmap.png", "error.png" })
            EXPECT_EQ(read(std::filesystem::path("whole") / name), read(std::filesystem::path(folder) / name)) << name;
    }
}

TEST_F(BakeProgram, RefusalsNameTheOptionAndTheCure) {
    EXPECT_THAT(run("cornell.glb --density 0").text, HasSubstr("--density"));
    EXPECT_THAT(run("cornell.glb --samples 3").text, HasSubstr("from 32 to 1048576"));
    EXPECT_THAT(run("none.glb").text, HasSubstr("none.glb"));
    EXPECT_THAT(run("cornell.glb --shard 0/2 --merge a").text, HasSubstr("without it"));
    const Outcome large = run("cornell.glb --density 1e5 --max-size 256");
    EXPECT_EQ(large.status, 1);
    EXPECT_THAT(large.text, HasSubstr("try --density"));
}

// A primitive whose charts lie on two pages becomes two, with the triangles of each.
TEST_F(BakeProgram, GoesOnToFurtherPagesWhereOneIsFull) {
    ASSERT_EQ(run(std::string(kQuick) + "--out one").status, 0);
    const Outcome outcome = run(std::string(kQuick) + "--max-size 24 --levels 3 --show-charts on --out pages");
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr(" pages"));
    EXPECT_TRUE(std::filesystem::exists(mFolder / "pages/lightmap-1.png"));
    EXPECT_THAT(run(std::string(kQuick) + "--max-size 24 --max-pages 2").text, HasSubstr("on 2 pages; try --density"));

    jobs::JobSystem jobs({ .workers = 1 });
    const Result<assets::ModelData> one = assets::loadGltf(mFolder / "one/baked.glb", jobs);
    const Result<assets::ModelData> pages = assets::loadGltf(mFolder / "pages/baked.glb", jobs);
    ASSERT_TRUE(one && pages) << pages.error().message;
    EXPECT_TRUE(pages->warnings.empty()) << pages->warnings.front();
    const Result<assets::ModelData> charts = assets::loadGltf(mFolder / "pages/charts.glb", jobs);
    ASSERT_TRUE(charts) << charts.error().message;
    EXPECT_EQ(charts->meshes.size(), pages->meshes.size());
    std::set<uint32_t> images;
    size_t triangles = 0, primitives = 0;
    for (assets::MeshData const& mesh : pages->meshes) {
        for (assets::PrimitiveData const& primitive : mesh.primitives) {
            auto const& light = pages->materials[primitive.material].light;
            ASSERT_TRUE(light.isUsed());
            images.insert(light.map.image);
            triangles += primitive.indexCount / 3, ++primitives;
        }
    }
    size_t expected = 0, before = 0;
    for (assets::MeshData const& mesh : one->meshes) {
        for (assets::PrimitiveData const& primitive : mesh.primitives) expected += primitive.indexCount / 3, ++before;
    }
    EXPECT_EQ(triangles, expected);
    EXPECT_GT(images.size(), 2u);
    EXPECT_GT(primitives, before);
    EXPECT_LT(primitives, before + images.size()) << "at most one is split between two pages";
    const Result<tools::Json> report = tools::readJson(mFolder / "pages/report.json");
    ASSERT_TRUE(report) << report.error().message;
    ASSERT_EQ((*report)["pages"].size(), images.size());
    uint64_t texels = 0;
    for (tools::Json const& page : (*report)["pages"]) texels += page["texels"].get<uint64_t>();
    EXPECT_EQ(texels, (*report)["texels"].get<uint64_t>());
}

// What the loader reads is what the report judged: halves of the same number, whatever the file holds.
TEST_F(BakeProgram, StoresLightInFewerBytesAndStatesTheError) {
    jobs::JobSystem jobs({ .workers = 1 });
    std::map<std::string, double> bytes, errors;
    for (const char* store : { "half", "rgb9e5", "bc6h", "bc6h --openness off" }) {
        const Outcome outcome = run(std::string(kQuick) + "--levels 3 --out stored --store " + store);
        ASSERT_EQ(outcome.status, 0) << outcome.text;
        const Result<assets::ModelData> model = assets::loadGltf(mFolder / "stored/baked.glb", jobs);
        ASSERT_TRUE(model) << model.error().message;
        EXPECT_TRUE(model->warnings.empty()) << model->warnings.front();
        assets::Image const& image =
                model->images[model->materials[model->meshes[0].primitives[0].material].light.map.image];
        ASSERT_EQ(image.format, backend::Format::RGBA16F);
        EXPECT_EQ(image.levels, 3u);
        float least = 1;
        for (size_t i = 0; i < image.levelBytes(0); i += 8) {
            uint16_t alpha;
            std::memcpy(&alpha, &image.data[i + 6], sizeof(alpha));
            least = std::min(least, floatFromHalf(alpha));
        }
        EXPECT_EQ(least < 1, std::string(store).find("off") == std::string::npos) << store;
        const Result<tools::Json> report = tools::readJson(mFolder / "stored/report.json");
        ASSERT_TRUE(report) << report.error().message;
        tools::Json const& storage = (*report)["storage"];
        bytes[store] = storage["bytes"].get<double>() / (double(image.width) * image.height * 21 / 16);
        errors[store] = storage["relativeError"].get<double>();
    }
    EXPECT_NEAR(bytes["half"], 8, 0.4);
    EXPECT_NEAR(bytes["rgb9e5"], 5, 0.4);
    EXPECT_NEAR(bytes["bc6h"], 1.5, 0.4);
    EXPECT_NEAR(bytes["bc6h --openness off"], 1, 0.4);
    EXPECT_LT(errors["half"], 1.0 / 4096); // half a step of 2^-10
    EXPECT_GT(errors["rgb9e5"], errors["half"]);
    EXPECT_LT(errors["rgb9e5"], 1.0 / 512);
    EXPECT_GT(errors["bc6h"], errors["rgb9e5"]);
    EXPECT_LT(errors["bc6h"], 0.1);
    EXPECT_EQ(errors["bc6h"], errors["bc6h --openness off"]);
    EXPECT_THAT(run("cornell.glb --store rgbm").text, HasSubstr("half, rgb9e5 or bc6h"));
}

TEST_F(BakeProgram, SpendsABudgetOfTexelsAlikeOnAnyNumberOfThreads) {
    const Outcome one = run("cornell.glb --texels 2000 --samples 32 --threads 1 --out one");
    ASSERT_EQ(one.status, 0) << one.text;
    const size_t count = one.text.find(" texels of");
    ASSERT_NE(count, std::string::npos) << one.text;
    const double texels = std::stod(one.text.substr(one.text.rfind(' ', count - 1)));
    EXPECT_GT(texels, 1000);
    EXPECT_LT(texels, 2100);
    ASSERT_EQ(run("cornell.glb --texels 2000 --samples 32 --threads 3 --out three").status, 0);
    EXPECT_EQ(read("one/baked.glb"), read("three/baked.glb"));
    EXPECT_THAT(run("cornell.glb --texels 1").text, HasSubstr("from 16 to"));
}

TEST_F(BakeProgram, WritesAnIrradianceGridOfTheSameBytesForAnyNumberOfThreads) {
    std::ofstream(mFolder / "grid.json") << R"({"name": "box", "at": [0, 1, 0], "halfExtent": [0.9, 0.9, 0.9],
        "spacing": 1, "maxProbes": 30, "paths": 64, "depthSize": 8, "heldOut": 8, "leakPoints": 2})";
    for (const char* threads : { "1", "3" }) {
        const Outcome outcome = run(fmt::format("cornell.glb --grid grid.json --threads {0} --out grid{0}", threads));
        ASSERT_EQ(outcome.status, 0) << outcome.text;
        EXPECT_THAT(outcome.text, HasSubstr("held-out points"));
    }
    EXPECT_EQ(read("grid1/box.grid"), read("grid3/box.grid"));
    const Result<std::vector<std::byte>> bytes = assets::readFileBytes(mFolder / "grid1/box.grid");
    ASSERT_TRUE(bytes);
    const Result<IrradianceGridDesc> grid = readIrradianceGrid(*bytes);
    ASSERT_TRUE(grid) << grid.error().message;
    EXPECT_GE(grid->probes->probes.size(), 8u);
    EXPECT_FALSE(std::filesystem::exists(mFolder / "grid1/baked.glb"));
}

// Refined twice before the budget is spent. Parts trace more than one run does if a bound is met early.
TEST_F(BakeProgram, GridsContinueAndMergeToTheBytesOfOneRun) {
    for (const char* error : { "0", "0.5" }) {
        std::ofstream(mFolder / "grid.json")
                << fmt::format(R"({{"name": "box", "at": [0, 1, 0], "halfExtent": [0.9, 0.9, 0.9], "spacing": 1,
            "maxProbes": 80, "maxError": {}, "paths": 512, "depthSize": 8, "heldOut": 16, "judged": 64}})",
                               error);
        const std::string grid = "cornell.glb --grid grid.json --threads 1 ", name = error;
        ASSERT_EQ(run(grid + "--out whole" + name).status, 0);
        EXPECT_FALSE(std::filesystem::exists(mFolder / ("whole" + name) / "bake.part"));
        std::string parts;
        for (const char* part : { "2", "0", "1" }) {
            const std::string folder = "part" + name + part;
            ASSERT_EQ(run(grid + "--shard " + part + "/3 --out " + folder).status, 0);
            parts += folder + " ";
        }
        const Outcome merged = run(grid + "--merge " + parts + "--out merged" + name);
        ASSERT_EQ(merged.status, 0) << merged.text;
        for (const char* signal : { "INT", "KILL" }) {
            const std::string folder = "stopped" + name + signal;
            stopOnceBegun(grid + "--out " + folder, folder + "/bake.part", signal);
            ASSERT_FALSE(std::filesystem::exists(mFolder / folder / "box.grid"));
            const Outcome rest = run(grid + "--out " + folder);
            ASSERT_EQ(rest.status, 0) << rest.text;
            EXPECT_EQ(read("whole" + name + "/box.grid"), read(folder + "/box.grid"));
            EXPECT_EQ(read("whole" + name + "/box-report.json"), read(folder + "/box-report.json"));
        }
        EXPECT_EQ(read("whole" + name + "/box.grid"), read("merged" + name + "/box.grid"));
        EXPECT_EQ(read("whole" + name + "/box-report.json"), read("merged" + name + "/box-report.json"));
    }
}

TEST_F(BakeProgram, WarnsOfASceneWithoutLight) {
    write("dark.glb", interiors::cornellBox(0).model);
    const Outcome outcome = run("dark.glb --density 4 --samples 32 --environment none --out dark");
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("no light reaches a surface"));
    std::ofstream(mFolder / "grid.json") << R"({"at": [0, 1, 0], "halfExtent": [0.5, 0.5, 0.5], "paths": 16})";
    const Outcome grid = run("dark.glb --grid grid.json --environment none --out dark");
    EXPECT_EQ(grid.status, 0) << grid.text;
    EXPECT_THAT(grid.text, HasSubstr("no light reaches a probe"));
}

TEST_F(BakeProgram, SaysWhatIsWrongWithAGrid) {
    std::ofstream(mFolder / "grid.json") << R"({"name": "a/b", "spacing": 0})";
    const Outcome invalid = run("cornell.glb --grid grid.json");
    EXPECT_EQ(invalid.status, 1);
    EXPECT_THAT(invalid.text, HasSubstr("grid.json"));
    EXPECT_THAT(run("cornell.glb --grid none.json").text, HasSubstr("none.json"));
}

} // namespace
} // namespace filament_core::bake
