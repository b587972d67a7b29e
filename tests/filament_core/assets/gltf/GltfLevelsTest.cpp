// SPDX-License-Identifier: Apache-2.0
// MSFT_lod: the finest level is loaded, and the others are not drawn on top of it.
#include "filament_core/assets/gltf/ModelBounds.h"
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <algorithm>

namespace filament_core::assets {
namespace {

using namespace test;

/// Roots that carry a light each, all in the scene; `lists` has the ids of each node, or null.
TestFile lights(Json const& lists) {
    TestFile file;
    file.root = Json::parse(R"({ "asset": { "version": "2.0" }, "extensionsRequired": [ "MSFT_lod" ],
        "extensions": { "KHR_lights_punctual": { "lights": [ { "type": "point" } ] } }, "scenes": [ {} ] })");
    for (size_t i = 0; i < lists.size(); ++i) {
        Json node = { { "extensions", { { "KHR_lights_punctual", { { "light", 0 } } } } } };
        if (!lists[i].is_null()) node["extensions"]["MSFT_lod"]["ids"] = lists[i];
        file.root["nodes"].push_back(node);
        file.root["scenes"][0]["nodes"].push_back(i);
    }
    return file;
}

std::vector<bool> shown(ModelData const& model) {
    std::vector<bool> isShown;
    for (NodeData const& node : model.nodes) isShown.push_back(node.light != kNone);
    return isShown;
}

using Shown = std::vector<bool>;

TEST(GltfLevels, OnlyTheFinestIsShown) {
    const ModelData model = loaded(lights(Json::parse("[ [ 1, 2 ], null, null, null ]")));
    EXPECT_EQ(shown(model), (Shown{ true, false, false, true })) << "the last one is no level";
    EXPECT_TRUE(model.warnings.empty());
}

TEST(GltfLevels, AreHiddenWithAllThatIsBelow) {
    TestFile file = lights(Json::parse("[ [ 1 ], null, null ]"));
    file.root["nodes"][1]["children"] = Json::array({ 2 });
    file.root["scenes"][0]["nodes"] = Json::array({ 0, 1 });
    EXPECT_EQ(shown(loaded(file)), (Shown{ true, false, false }));
}

TEST(GltfLevels, MayBeBelowTheFinest) {
    TestFile file = lights(Json::parse("[ [ 1 ], null, null ]"));
    file.root["nodes"][0]["children"] = Json::array({ 1, 2 });
    file.root["scenes"][0]["nodes"] = Json::array({ 0 });
    EXPECT_EQ(shown(loaded(file)), (Shown{ true, false, true }));
}

TEST(GltfLevels, MeshesOfCoarserOnesAreNotRead) {
    TestFile file = TestFile::triangle();
    file.root["nodes"].push_back({ { "mesh", 1 } });
    file.root["meshes"].push_back(file.root["meshes"][0]);
    file.root["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = Json::array({ 1 });
    file.root["nodes"][0]["extras"]["MSFT_screencoverage"] = Json::array({ 0.5, 0.01 });
    file.root["scenes"] = Json::parse(R"([ { "nodes": [ 0, 1 ] } ])");
    const ModelData model = loaded(file);
    EXPECT_EQ(model.meshes.size(), 1u);
    ASSERT_EQ(model.nodes.size(), 2u) << "animations and joints still find all nodes";
    EXPECT_EQ(model.nodes[0].mesh, 0u);
    EXPECT_EQ(model.nodes[1].mesh, kNone);
}

TEST(GltfLevels, OfMaterialsAreLeftOut) {
    TestFile file = TestFile::triangle();
    file.root["extensionsRequired"] = Json::array({ "MSFT_lod" });
    file.root["materials"] = Json::parse(R"([ { "name": "fine", "extensions": { "MSFT_lod": { "ids": [ 1 ] } } },
                                              { "name": "coarse" } ])");
    file.primitive()["material"] = 0;
    const ModelData model = loaded(file);
    ASSERT_EQ(model.materials.size(), 1u);
    EXPECT_EQ(model.materials[0].name, "fine");
}

TEST(GltfLevels, AHiddenFinestHidesAll) {
    TestFile file = lights(Json::parse("[ [ 1 ], null ]"));
    file.root["nodes"][0]["extensions"]["KHR_node_visibility"]["visible"] = false;
    EXPECT_EQ(shown(loaded(file)), (Shown{ false, false }));
}

TEST(GltfLevels, AnAnimationDoesNotShowACoarserOne) {
    TestFile file = lights(Json::parse("[ [ 1 ], null ]"));
    file.root["nodes"][1]["extensions"]["KHR_node_visibility"]["visible"] = true;
    const size_t times = file.add(std::vector<float>{ 0, 1 }, kFloat, "SCALAR", 1);
    const size_t values = file.add(std::vector<uint8_t>{ 0, 1 }, kUByte, "SCALAR", 1);
    file.root["animations"][0] = Json::parse(R"({ "channels": [ { "sampler": 0, "target": { "path": "pointer",
        "extensions": { "KHR_animation_pointer": { "pointer": "/nodes/1/extensions/KHR_node_visibility/visible" } } } } ] })");
    file.root["animations"][0]["samplers"].push_back(
            { { "input", times }, { "output", values }, { "interpolation", "STEP" } });
    const Result<ModelData> model = file.load({ .deformation = GltfDeformation::Kept });
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_EQ(model->animations.size(), 1u);
    EXPECT_EQ(shown(*model), (Shown{ true, false }));
}

/// Damaged lists: what is shown, and the one warning.
struct Damage {
    const char* lists;
    Shown shown;
    const char* warning;
};

TEST(GltfLevels, DamagedListsAreMended) {
    const Damage damages[] = {
        { "[ [ 0, 1 ], null ]", { true, false }, "nodes[0].extensions.MSFT_lod.ids: nodes[0] is the node itself" },
        { "[ [ 1, 7 ], null ]", { true, false }, "nodes[0].extensions.MSFT_lod.ids[1]: nodes[7] does not exist" },
        { "[ [ 1, 1 ], null ]", { true, false }, "nodes[0].extensions.MSFT_lod.ids: nodes[1] is a coarser level" },
        { "[ [ 1 ], [ 0 ] ]", { true, false }, "nodes[1].extensions.MSFT_lod.ids: nodes[0] is the same thing" },
        { "[ [ 1 ], [ 2 ], [ 0 ] ]", { true, false, false }, "nodes[2].extensions.MSFT_lod.ids: nodes[0] is the" },
        { "[ [ 2 ], [ 2 ], null ]", { true, true, false }, "nodes[1].extensions.MSFT_lod.ids: nodes[2] is a coarser" },
    };
    for (Damage const& damage : damages) {
        const ModelData model = loaded(lights(Json::parse(damage.lists)));
        EXPECT_EQ(shown(model), damage.shown) << damage.lists;
        ASSERT_EQ(model.warnings.size(), 1u) << damage.lists;
        EXPECT_TRUE(model.warnings[0].starts_with(damage.warning)) << model.warnings[0];
    }
}

TEST(GltfLevels, ALevelAboveItsFinestIsIgnored) {
    TestFile file = lights(Json::parse("[ null, [ 0 ], null ]"));
    file.root["nodes"][0]["children"] = Json::array({ 2 });
    file.root["nodes"][2]["children"] = Json::array({ 1 });
    file.root["scenes"][0]["nodes"] = Json::array({ 0 });
    const ModelData model = loaded(file);
    EXPECT_EQ(shown(model), (Shown{ true, true, true }));
    ASSERT_EQ(model.warnings.size(), 1u);
    EXPECT_TRUE(model.warnings[0].starts_with("nodes[1].extensions.MSFT_lod.ids: nodes[0] is above the node"))
            << model.warnings[0];
}

TEST(GltfLevels, AnIdThatIsNoNumberIsAnError) {
    for (const char* ids : { R"([ "1" ])", "[ -1 ]", "[ 0.5 ]", "[ null ]", "3" }) {
        Json lists = Json::parse("[ null, null ]");
        lists[0] = Json::parse(ids);
        const Result<ModelData> model = lights(lists).load();
        ASSERT_FALSE(model) << ids;
        Error const& error = model.error();
        EXPECT_EQ(error.code, ErrorCode::Corrupt) << ids;
        EXPECT_NE(error.message.find("nodes[0].extensions.MSFT_lod.ids"), std::string::npos) << error.message;
    }
}

ModelData allOf(TestFile const& file) {
    const Result<ModelData> model = file.load({ .levels = GltfLevels::All });
    EXPECT_TRUE(model) << (model ? "" : model.error().message);
    return model ? std::move(*model) : ModelData{};
}

TEST(GltfLevels, AllOfThemAreListed) {
    const ModelData model = allOf(lights(Json::parse("[ [ 1, 2 ], null, null, [ 4 ], null, null ]")));
    EXPECT_EQ(shown(model), Shown(6, true));
    ASSERT_EQ(model.levels.size(), 2u);
    EXPECT_EQ(model.levels[0].nodes, (std::vector<uint32_t>{ 0, 1, 2 }));
    EXPECT_EQ(model.levels[0].leastCoverage, (std::vector<double>{ 0.25, 0.0625, 0 })) << "by halves of the size";
    EXPECT_EQ(model.levels[1].nodes, (std::vector<uint32_t>{ 3, 4 }));
    EXPECT_FALSE(model.nodes[0].isCoarserLevel);
    EXPECT_TRUE(model.nodes[2].isCoarserLevel);
    EXPECT_TRUE(model.warnings.empty());
    EXPECT_TRUE(loaded(lights(Json::parse("[ [ 1, 2 ], null, null ]"))).levels.empty()) << "unless asked for";
}

TEST(GltfLevels, LevelsOfLevelsFollowThem) {
    const ModelData model = allOf(lights(Json::parse("[ [ 1, 3 ], [ 2 ], null, null ]")));
    ASSERT_EQ(model.levels.size(), 1u);
    EXPECT_EQ(model.levels[0].nodes, (std::vector<uint32_t>{ 0, 1, 2, 3 }));
}

TEST(GltfLevels, ThoseInNoSceneJoinTheirFinestOne) {
    TestFile file = lights(Json::parse("[ [ 2, 3 ], null, null, null, [ 5 ], null ]"));
    file.root["nodes"][1]["children"] = Json::array({ 0 });
    file.root["nodes"][1]["translation"] = Json::array({ 5, 0, 0 });
    file.root["nodes"][2]["translation"] = Json::array({ 0, 1, 0 });
    file.root["nodes"][2]["children"] = Json::array({ 6 });
    file.root["nodes"].push_back(file.root["nodes"][3]);
    file.root["scenes"][0]["nodes"] = Json::array({ 1, 4 });
    const ModelData model = allOf(file);
    ASSERT_EQ(model.nodes.size(), 7u);
    ASSERT_EQ(model.levels.size(), 2u);
    std::vector<uint32_t> const& levels = model.levels[0].nodes;
    ASSERT_EQ(levels.size(), 3u);
    EXPECT_EQ(model.nodes[levels[1]].parent, model.nodes[levels[0]].parent);
    EXPECT_EQ(double3(model.nodes[levels[1]].worldFromNode[3]), double3(5, 1, 0)) << "of the parent that it has now";
    EXPECT_EQ(double3(model.nodes[levels[2]].worldFromNode[3]), double3(5, 0, 0));
    EXPECT_EQ(model.nodes[model.levels[1].nodes[1]].parent, kNone) << "a root like its finest one";
    EXPECT_EQ(std::ranges::count(model.nodes, kNone, &NodeData::light), 0);
    EXPECT_EQ(loaded(file).nodes.size(), 3u) << "unless asked for";
}

TEST(GltfLevels, ThoseBelowTheirFinestAreNotListed) {
    TestFile file = lights(Json::parse("[ [ 1, 2 ], null, null ]"));
    file.root["nodes"][0]["children"] = Json::array({ 1 });
    file.root["scenes"][0]["nodes"] = Json::array({ 0, 2 });
    const ModelData model = allOf(file);
    ASSERT_EQ(model.levels.size(), 1u);
    EXPECT_EQ(model.levels[0].nodes, (std::vector<uint32_t>{ 0, 2 }));
    EXPECT_TRUE(model.nodes[1].isCoarserLevel);
}

TEST(GltfLevels, CoverageIsMended) {
    const auto coverage = [](Json const& given) {
        TestFile file = lights(Json::parse("[ [ 1, 2 ], null, null ]"));
        file.root["nodes"][0]["extras"] = given;
        const ModelData model = allOf(file);
        return std::pair(model.levels.at(0).leastCoverage, model.warnings.size());
    };
    const auto list = [&](const char* values) { return coverage({ { "MSFT_screencoverage", Json::parse(values) } }); };
    using Least = std::vector<double>;
    EXPECT_EQ(list("[ 0.5, 0.2, 0.01 ]"), (std::pair(Least{ 0.5, 0.2, 0.01 }, size_t{ 0 })));
    EXPECT_EQ(list("[ 1, 0.5 ]"), (std::pair(Least{ 1, 0.5, 0 }, size_t{ 0 }))) << "the last one needs nothing";
    EXPECT_EQ(list("[ 0.5 ]"), (std::pair(Least{ 0.5, 0.125, 0 }, size_t{ 0 })));
    EXPECT_EQ(list("[ 0.5, 0.2, 0.01, 0.001, 0 ]"), (std::pair(Least{ 0.5, 0.2, 0.01 }, size_t{ 0 })));
    EXPECT_EQ(list("[ 0.1, 0.2, -1 ]"), (std::pair(Least{ 0.1, 0.1, 0 }, size_t{ 1 })));
    for (const char* other : { "[ \"0.5\" ]", "7", "{}", "[ null ]", "[]" })
        EXPECT_EQ(list(other), (std::pair(Least{ 0.25, 0.0625, 0 }, size_t{ 0 })))
                << other << " is the file's business";
    EXPECT_EQ(coverage("text").first, (Least{ 0.25, 0.0625, 0 }));
}

TEST(GltfLevels, TheFinestAloneDecidesTheBounds) {
    TestFile file = TestFile::triangle();
    file.root["nodes"].push_back({ { "mesh", 0 }, { "translation", { 100, 0, 0 } } });
    file.root["nodes"][0]["extensions"]["MSFT_lod"]["ids"] = Json::array({ 1 });
    file.root["scenes"] = Json::parse(R"([ { "nodes": [ 0, 1 ] } ])");
    const Box all = boundsOf(allOf(file)), finest = boundsOf(loaded(file));
    EXPECT_EQ(all.max, finest.max);
}

TEST(GltfLevels, LongChainsTakeLinearTime) {
    constexpr uint32_t kCount = 100'000;
    Json lists = Json::array();
    for (uint32_t i = 0; i < kCount; ++i) lists.push_back(i + 1 == kCount ? Json() : Json::array({ i + 1 }));
    const ModelData all = allOf(lights(lists));
    ASSERT_EQ(all.levels.size(), 1u);
    EXPECT_EQ(all.levels[0].nodes.size(), kCount);
    const ModelData model = loaded(lights(lists));
    ASSERT_EQ(model.nodes.size(), kCount);
    EXPECT_EQ(std::ranges::count_if(model.nodes, [](NodeData const& node) { return node.light != kNone; }), 1);
    EXPECT_NE(model.nodes[0].light, kNone) << "nobody's coarser level";
}

} // namespace
} // namespace filament_core::assets
