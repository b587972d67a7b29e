// SPDX-License-Identifier: Apache-2.0
// KHR_node_selectability and KHR_node_hoverability: squares behind each other on random trees of nodes. A pick hits the
// nearest whose node and all nodes above are to be hit, in the file, after changes by the program, and in animations.
#include "tests/filament_core/assets/gltf/GltfTestFile.h"
#include "tests/filament_core/engine/RenderFixture.h"

#include <filament_core/Animator.h>
#include <filament_core/Gltf.h>

#include <random>
#include <string>
#include <vector>

namespace filament_core::pickable_nodes {
namespace {

using assets::test::Json;
using assets::test::TestFile;

constexpr PickAim kAims[] = { PickAim::Select, PickAim::Hover, PickAim::Anything };
constexpr uint32_t kNoParent = ~0u;

/// Nodes from the nearest to the farthest; each has a square, skinned or not.
struct Tree {
    struct Member {
        uint32_t parent = kNoParent; ///< before this one
        bool isSelectable = true, isHoverable = true, isSkinned = false;
    };
    std::vector<Member> members;

    bool isHit(uint32_t at, PickAim aim) const {
        for (; at != kNoParent; at = members[at].parent) {
            if (aim == PickAim::Select && !members[at].isSelectable) return false;
            if (aim == PickAim::Hover && !members[at].isHoverable) return false;
        }
        return true;
    }
    /// The place of the square that a pick hits; nothing: it hits none.
    std::optional<double> expected(PickAim aim) const {
        for (uint32_t i = 0; i < members.size(); ++i) {
            if (isHit(i, aim)) return placeOf(i);
        }
        return std::nullopt;
    }
    static double placeOf(uint32_t at) { return -0.25 * at; }
};

Tree randomTree(std::mt19937& random) {
    Tree tree;
    for (uint32_t i = 0; i < 10; ++i) {
        tree.members.push_back(
                { .parent = i == 0 || random() % 3 == 0 ? kNoParent : static_cast<uint32_t>(random() % i),
                  .isSelectable = random() % 3 != 0,
                  .isHoverable = random() % 3 != 0,
                  .isSkinned = random() % 3 == 0 });
    }
    return tree;
}

TestFile fileOf(Tree const& tree) {
    TestFile file;
    file.positions({ -1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0 });
    file.attribute("JOINTS_0", std::vector<uint8_t>(16, 0), assets::test::kUByte, "VEC4", 4);
    file.attribute("WEIGHTS_0", std::vector<float>{ 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0 },
                   assets::test::kFloat, "VEC4", 4);
    file.indices({ 0, 1, 2, 0, 2, 3 });
    file.root["materials"] = Json::parse(R"([ { "doubleSided": true } ])");
    file.primitive()["material"] = 0;
    file.root["extensionsUsed"] = file.root["extensionsRequired"] =
            Json::array({ "KHR_node_selectability", "KHR_node_hoverability" });
    Json &nodes = file.root["nodes"] = Json::array(), &roots = file.root["scenes"][0]["nodes"] = Json::array();
    for (uint32_t i = 0; i < tree.members.size(); ++i) {
        Tree::Member const& member = tree.members[i];
        const double above = member.parent == kNoParent ? 0 : Tree::placeOf(member.parent);
        nodes.push_back({ { "name", std::to_string(i) }, { "mesh", 0 } });
        nodes[i]["translation"] = { 0, 0, Tree::placeOf(i) - above };
        if (!member.isSelectable) nodes[i]["extensions"]["KHR_node_selectability"]["selectable"] = false;
        if (!member.isHoverable) nodes[i]["extensions"]["KHR_node_hoverability"]["hoverable"] = false;
        (member.parent == kNoParent ? roots : nodes[member.parent]["children"]).push_back(i);
        if (!member.isSkinned) continue;
        nodes[i]["skin"] = file.root["skins"].size(); // follows a joint in the same place
        file.root["skins"].push_back({ { "joints", { tree.members.size() + file.root["skins"].size() } } });
    }
    for (uint32_t i = 0; i < tree.members.size(); ++i) {
        if (!tree.members[i].isSkinned) continue;
        roots.push_back(nodes.size());
        nodes.push_back({ { "translation", { 0, 0, Tree::placeOf(i) } } });
    }
    return file;
}

/// One engine for many trees.
struct PickScene {
    explicit PickScene(Backend backend) : engine(test::makeEngine(backend)) {}

    std::optional<double> pick(PickAim aim) {
        const Result<PickHit> hit = renderer->waitPick(renderer->pick(*scene, view, { 4, 4 }, aim));
        EXPECT_TRUE(hit) << (hit ? "" : hit.error().message);
        if (!hit || !*hit) return std::nullopt;
        return hit->positionWorld.z;
    }
    void expect(Tree const& tree, std::string const& when) {
        for (const PickAim aim : kAims) {
            const std::optional<double> expected = tree.expected(aim), actual = pick(aim);
            ASSERT_EQ(actual.has_value(), expected.has_value()) << when << ", aim " << static_cast<int>(aim);
            EXPECT_NEAR(actual.value_or(0), expected.value_or(0), 1e-3) << when << ", aim " << static_cast<int>(aim);
        }
    }

    std::optional<Engine> engine;
    std::optional<Scene> scene{ *engine };
    std::optional<Renderer> renderer{ *engine };
    View view{ .camera = Camera::lookAt({ 0, 0, 5 }, { 0, 0, 0 }, { .verticalFovDegrees = 20 }), .size = { 9, 9 } };
};

TEST(PickableNodes, AreThoseOfTheFileAndOfTheProgram) {
    std::mt19937 random(5);
    for (const Backend backend : test::kBothApis) {
        PickScene stage(backend);
        ASSERT_TRUE(stage.engine);
        for (int turn = 0; turn < 12; ++turn) {
            const std::string name = std::string(toString(backend)) + ", tree " + std::to_string(turn);
            Tree tree = randomTree(random);
            const Result<Model> model =
                    loadGltf(*stage.engine, GltfMemory{ .file = fileOf(tree).glb(), .name = "tree" });
            ASSERT_TRUE(model) << model.error().message;
            EXPECT_TRUE(model->warnings().empty());
            const Node copy = stage.scene->add(*model);
            stage.expect(tree, name);
            for (uint32_t i = 0; i < tree.members.size(); ++i) {
                const Node node = stage.scene->findNode(std::to_string(i), copy);
                for (const PickAim aim : { PickAim::Select, PickAim::Hover }) {
                    EXPECT_EQ(stage.scene->isPickable(node, aim), tree.isHit(i, aim)) << name << ' ' << i;
                    const bool isHit = random() % 2 == 0;
                    stage.scene->setPickable(node, aim, isHit);
                    (aim == PickAim::Select ? tree.members[i].isSelectable : tree.members[i].isHoverable) = isHit;
                }
            }
            stage.expect(tree, name + ", changed");
            stage.scene->setPickable(copy, PickAim::Select, false);
            EXPECT_EQ(stage.pick(PickAim::Select), std::nullopt) << name << ": nothing of this copy";
            stage.scene->remove(copy);
        }
        test::expectNoErrors(*stage.engine);
    }
}

// A new node in the place of a removed one has no rule.
TEST(PickableNodes, RulesEndWithTheirNodes) {
    PickScene stage(Backend::Null);
    for (int turn = 0; turn < 3; ++turn) {
        const Node node = stage.scene->add(NodeDesc{});
        EXPECT_TRUE(stage.scene->isPickable(node, PickAim::Hover));
        stage.scene->setPickable(node, PickAim::Hover, false);
        EXPECT_FALSE(stage.scene->isPickable(node, PickAim::Hover));
        EXPECT_TRUE(stage.scene->isPickable(node, PickAim::Select));
        stage.scene->remove(node);
    }
}

TEST(PickableNodes, AnimationsChangeWhatPicksHit) {
    const Tree tree{ { { .isSelectable = false }, { .parent = 0, .isHoverable = false } } };
    TestFile file = fileOf(tree);
    const size_t times = file.add(std::vector<float>{ 0, 1, 2 }, assets::test::kFloat, "SCALAR", 1);
    Json& animation = file.root["animations"][0];
    const auto animate = [&](const char* pointer, std::vector<uint8_t> const& values) {
        const size_t output = file.add(values, assets::test::kUByte, "SCALAR", 1);
        animation["channels"].push_back(
                { { "sampler", animation["samplers"].size() },
                  { "target",
                    { { "path", "pointer" },
                      { "extensions", { { "KHR_animation_pointer", { { "pointer", pointer } } } } } } } });
        animation["samplers"].push_back({ { "input", times }, { "output", output }, { "interpolation", "STEP" } });
    };
    animate("/nodes/0/extensions/KHR_node_selectability/selectable", { 1, 0, 1 });
    animate("/nodes/1/extensions/KHR_node_hoverability/hoverable", { 0, 1, 1 });
    file.root["extensionsUsed"].push_back("KHR_animation_pointer");
    PickScene stage(Backend::Null);
    const Result<Model> model = loadGltf(*stage.engine, GltfMemory{ .file = file.glb(), .name = "tree" });
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_TRUE(model->warnings().empty()) << model->warnings().front();
    const Node copy = stage.scene->add(*model), first = stage.scene->findNode("0", copy),
               second = stage.scene->findNode("1", copy);
    const auto hits = [&] {
        return std::array{ stage.scene->isPickable(first, PickAim::Select),
                           stage.scene->isPickable(second, PickAim::Select),
                           stage.scene->isPickable(second, PickAim::Hover) };
    };
    EXPECT_EQ(hits(), (std::array{ false, false, false })) << "at rest";
    Animator animator(*model, *stage.scene, copy);
    animator.apply(0, 0.5);
    EXPECT_EQ(hits(), (std::array{ true, true, false }));
    animator.apply(0, 1.5);
    EXPECT_EQ(hits(), (std::array{ false, false, true }));
    animator.apply(0, 2.0);
    EXPECT_EQ(hits(), (std::array{ true, true, true }));
}

} // namespace
} // namespace filament_core::pickable_nodes
