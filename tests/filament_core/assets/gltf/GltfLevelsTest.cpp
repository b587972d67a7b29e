// SPDX-License-Identifier: Apache-2.0
// MSFT_lod: the finest level is loaded, and the others are not drawn on top of it.
#include "tests/filament_core/assets/gltf/GltfTestFile.h"

#include <algorithm>

namespace filament::assets {
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

TEST(GltfLevels, LongChainsTakeLinearTime) {
    constexpr uint32_t kCount = 100'000;
    Json lists = Json::array();
    for (uint32_t i = 0; i < kCount; ++i) lists.push_back(i + 1 == kCount ? Json() : Json::array({ i + 1 }));
    const ModelData model = loaded(lights(lists));
    ASSERT_EQ(model.nodes.size(), kCount);
    EXPECT_EQ(std::ranges::count_if(model.nodes, [](NodeData const& node) { return node.light != kNone; }), 1);
    EXPECT_NE(model.nodes[0].light, kNone) << "nobody's coarser level";
}

} // namespace
} // namespace filament::assets
