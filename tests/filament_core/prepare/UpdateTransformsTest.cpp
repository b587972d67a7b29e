// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/UpdateTransforms.h"

#include "base/Hash.h"
#include "filament_core/prepare/PrepareFrame.h"
#include "filament_core/scene/SceneNodes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <optional>

namespace filament_core::prepare {
namespace {

/// The same numbers on every run and machine.
class Random {
public:
    explicit Random(uint32_t seed) : mState(seed * 2654435761u + 1) {}
    uint32_t below(uint32_t limit) {
        mState = mState * 1664525u + 1013904223u;
        return static_cast<uint32_t>((static_cast<uint64_t>(mState) * limit) >> 32);
    }
    double real() { return below(2'000'001) * 1e-6 - 1; } // [-1, 1]

    /// Like a rotation, skewed or mirrored; sometimes flat, rarely broken.
    double4x4 transform() {
        double4x4 matrix(1.0);
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 3; ++row) matrix[column][row] = real() * (column == 3 ? 1000 : 1.4);
        }
        if (below(16) == 0) matrix[static_cast<int>(below(3))] = double4(0);
        if (below(64) == 0) matrix[1].y = std::nan("");
        return matrix;
    }

private:
    uint32_t mState;
};

bool isBroken(double4x4 const& matrix) { return std::isnan(matrix[1].y); }

/// The second implementation: nodes that own their children, world transforms by recursion over full matrices.
struct NaiveNode {
    double4x4 parentFromNode{ 1.0 };
    std::vector<std::unique_ptr<NaiveNode>> children;
    NaiveNode* parent = nullptr;
    Node node;
    std::vector<Renderable> renderables;
    std::vector<Light> lights;
};

struct NaiveWorlds {
    std::map<Node, double4x4> nodes;
    std::map<Renderable, double4x4> renderables;
    std::map<Light, double4x4> lights;
};

void collectWorlds(NaiveNode const& node, double4x4 const& worldFromParent, NaiveWorlds& worlds) {
    const double4x4 world = worldFromParent * node.parentFromNode;
    if (node.node) worlds.nodes[node.node] = world;
    for (Renderable renderable : node.renderables) worlds.renderables[renderable] = world;
    for (Light light : node.lights) worlds.lights[light] = world;
    for (auto const& child : node.children) collectWorlds(*child, world, worlds);
}

/// A scene and its naive double, edited together at random.
class Edited {
public:
    explicit Edited(uint32_t seed) : mRandom(seed) {}

    void edit() {
        const uint32_t choice = mRandom.below(100);
        if (choice < 35 || mNodes.size() < 3) return addNode();
        NaiveNode& node = *mNodes[mRandom.below(static_cast<uint32_t>(mNodes.size()))];
        if (choice < 60) return setTransform(node);
        if (choice < 75) return setParent(node, pickParent());
        if (choice < 85) return addRenderable(node);
        if (choice < 90) return addLight(node);
        if (choice < 94) return removeThings(node);
        if (choice < 97) removeNode(node);
    }

    NaiveWorlds worlds() const {
        NaiveWorlds worlds;
        collectWorlds(mRoot, double4x4(1.0), worlds);
        return worlds;
    }

    Random& random() { return mRandom; }
    scene::SceneData scene;

private:
    NaiveNode& pickParent() {
        const uint32_t pick = mRandom.below(static_cast<uint32_t>(mNodes.size()) + 1);
        return pick == mNodes.size() ? mRoot : *mNodes[pick];
    }

    double4x4 nextTransform() {
        const double4x4 matrix = mRandom.transform();
        mLastNaive = isBroken(matrix) ? double4x4({}, {}, {}, double4(0, 0, 0, 1)) : matrix;
        return matrix;
    }

    void addNode() {
        NaiveNode& parent = pickParent();
        auto made = std::make_unique<NaiveNode>();
        made->node = scene.transforms.add(parent.node, nextTransform(), {});
        made->parentFromNode = mLastNaive;
        made->parent = &parent;
        mNodes.push_back(made.get());
        parent.children.push_back(std::move(made));
    }

    void setTransform(NaiveNode& node) {
        scene.transforms.setTransform(node.node, nextTransform());
        node.parentFromNode = mLastNaive;
    }

    void setParent(NaiveNode& node, NaiveNode& parent) {
        for (NaiveNode const* above = &parent; above; above = above->parent) {
            if (above == &node) return; // would be a cycle
        }
        scene.transforms.setParent(node.node, parent.node);
        parent.children.push_back(take(node));
        node.parent = &parent;
    }

    static std::unique_ptr<NaiveNode> take(NaiveNode& node) {
        auto& siblings = node.parent->children;
        const auto at = std::find_if(siblings.begin(), siblings.end(), [&](auto const& s) { return s.get() == &node; });
        auto taken = std::move(*at);
        siblings.erase(at);
        return taken;
    }

    void addRenderable(NaiveNode& node) {
        const Renderable renderable = scene::addRenderable(
                scene, { .material = &mInstance, .boundsMin = float3(-1), .boundsMax = float3(1, 2, 3) });
        scene::attach(scene, renderable, node.node);
        node.renderables.push_back(renderable);
    }

    void addLight(NaiveNode& node) {
        const Light light = scene::addLight(scene, { .type = scene::LightRecord::Type::Spot,
                                                     .positionWorld = { 1, 2, 3 },
                                                     .directionWorld = { 0, 0, -1 } });
        scene::attach(scene, light, node.node);
        node.lights.push_back(light);
    }

    void removeThings(NaiveNode& node) {
        for (Renderable renderable : node.renderables) scene::removeRenderable(scene, renderable);
        for (Light light : node.lights) scene::removeLight(scene, light);
        node.renderables.clear();
        node.lights.clear();
    }

    void removeNode(NaiveNode& node) {
        scene::removeNode(scene, node.node);
        const std::unique_ptr<NaiveNode> removed = take(node);
        std::vector<NaiveNode*> dead{ removed.get() };
        for (size_t i = 0; i < dead.size(); ++i) {
            for (auto const& child : dead[i]->children) dead.push_back(child.get());
        }
        std::erase_if(mNodes, [&](NaiveNode* n) { return std::find(dead.begin(), dead.end(), n) != dead.end(); });
    }

    scene::Material mMaterial;
    scene::MaterialInstance mInstance{ .material = &mMaterial };
    Random mRandom;
    NaiveNode mRoot;
    std::vector<NaiveNode*> mNodes;
    double4x4 mLastNaive{ 1.0 };
};

void expectRenderablesFollow(scene::SceneData const& scene, NaiveWorlds const& worlds) {
    ASSERT_EQ(scene.renderables.count(), worlds.renderables.size());
    for (auto const& [renderable, world] : worlds.renderables) {
        const uint32_t at = scene.renderables.index.at(renderable);
        scene::Placement const& placement = scene.renderables.placement[at];
        EXPECT_EQ(placement.translation, double3(world[3]));
        EXPECT_EQ(placement.rows[1], float3(double3(world[0].y, world[1].y, world[2].y)));
        EXPECT_EQ(placement.side, glm::determinant(double3x3(world)) < 0 ? -1.0f : 1.0f);
        const double3 center(world * double4(0, 0.5, 1, 1));
        EXPECT_NEAR(glm::length(scene.renderables.bounds.centerAt(at) - center), 0, 1e-9 * (1 + glm::length(center)));
    }
}

void expectLightsFollow(scene::SceneData const& scene, NaiveWorlds const& worlds) {
    ASSERT_EQ(scene.lights.index.size(), worlds.lights.size());
    for (auto const& [light, world] : worlds.lights) {
        scene::LightRecord const& record = scene.lights.records[scene.lights.index.at(light)];
        const double3 position(world * double4(1, 2, 3, 1)), axis = -double3(world[2]);
        EXPECT_NEAR(glm::length(record.positionWorld - position), 0, 1e-9 * (1 + glm::length(position)));
        const float3 direction = glm::length(axis) > 0 ? float3(glm::normalize(axis)) : float3(0, 0, -1);
        EXPECT_NEAR(glm::length(record.directionWorld - direction), 0, 1e-6);
    }
}

TEST(UpdateTransforms, EqualsANaiveRecursionAfterAnySequenceOfEdits) {
    for (const int workers : { 0, 2 }) {
        jobs::JobSystem jobs({ .workers = workers });
        for (uint32_t seed = 0; seed < 30; ++seed) {
            Edited edited(seed);
            for (int frame = 0; frame < 12; ++frame) {
                const uint32_t edits = frame == 0 ? 600 : edited.random().below(30);
                for (uint32_t i = 0; i < edits; ++i) edited.edit();
                const NaiveWorlds worlds = edited.worlds();
                scene::Transforms const& transforms = edited.scene.transforms;
                ASSERT_EQ(transforms.count(), worlds.nodes.size());
                for (auto const& [node, world] : worlds.nodes) ASSERT_EQ(transforms.worldFromNode(node), world);
                updateTransforms(jobs, edited.scene);
                ASSERT_FALSE(transforms.isStale());
                for (auto const& [node, world] : worlds.nodes) ASSERT_EQ(transforms.worldFromNode(node), world);
                expectRenderablesFollow(edited.scene, worlds);
                expectLightsFollow(edited.scene, worlds);
                ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed << ", frame " << frame;
            }
        }
    }
}

/// `count` nodes with a box each; every node is a child of a random one of the previous `reach`. reach 1 gives a chain.
struct Forest {
    Forest(uint32_t count, uint32_t reach) {
        Random random(count);
        for (uint32_t i = 0; i < count; ++i) {
            const Node parent = i == 0 ? Node{} : nodes[i - 1 - random.below(std::min(i, reach))];
            nodes.push_back(scene.transforms.add(parent, small(random), {}));
            renderables.push_back(scene::addRenderable(
                    scene, { .material = &instance, .boundsMin = float3(-1), .boundsMax = float3(1) }));
            scene::attach(scene, renderables.back(), nodes.back());
        }
    }

    /// Close to the identity, so that thousands of them in a row stay in the range of double.
    static double4x4 small(Random& random) {
        double4x4 matrix(1.0);
        const double angle = random.real();
        matrix[0] = { std::cos(angle), std::sin(angle), 0, 0 };
        matrix[1] = { -std::sin(angle), std::cos(angle), 0, 0 };
        matrix[3] = { random.real(), random.real(), random.real(), 1 };
        return matrix;
    }

    void changeSome(uint32_t seed, uint32_t count) {
        Random random(seed);
        for (uint32_t i = 0; i < count; ++i) {
            scene.transforms.setTransform(nodes[random.below(static_cast<uint32_t>(nodes.size()))], small(random));
        }
    }

    uint64_t hash() const {
        uint64_t hash = 0;
        for (const Node node : nodes) {
            const double4x4 world = scene.transforms.worldFromNode(node);
            hash = hashBytes(std::as_bytes(std::span(&world, 1)), hash);
        }
        hash = hashBytes(std::as_bytes(std::span(scene.renderables.placement)), hash);
        for (uint32_t i = 0; i < scene.renderables.count(); ++i) {
            const double3 center = scene.renderables.bounds.centerAt(i);
            hash = hashBytes(std::as_bytes(std::span(&center, 1)), hash);
        }
        return hash;
    }

    scene::Material material;
    scene::MaterialInstance instance{ .material = &material };
    scene::SceneData scene;
    std::vector<Node> nodes;
    std::vector<Renderable> renderables;
};

TEST(UpdateTransforms, GivesTheSameBitsForAnyNumberOfWorkers) {
    for (const uint32_t reach : { 1u, 40u, 20'000u }) { // a chain, a tree of several hundred levels, a wide tree
        std::optional<uint64_t> reference;
        for (const int workers : { 0, 1, 2, 3, 16 }) {
            jobs::JobSystem jobs({ .workers = workers });
            Forest forest(20'000, reach);
            uint64_t hash = 0;
            for (uint32_t frame = 0; frame < 4; ++frame) {
                updateTransforms(jobs, forest.scene);
                hash = hashCombine(hash, forest.hash());
                forest.changeSome(frame, frame * 400);
            }
            if (!reference) reference = hash;
            EXPECT_EQ(hash, *reference) << workers << " workers, reach " << reach;
        }
    }
}

TEST(UpdateTransforms, AChainOfTwentyThousandLevelsEqualsItsProduct) {
    constexpr uint32_t kDepth = 20'000;
    jobs::JobSystem jobs({ .workers = 1 });
    Forest chain(kDepth, 1);
    updateTransforms(jobs, chain.scene);
    double4x4 product(1.0);
    for (const Node node : chain.nodes) product = product * chain.scene.transforms.parentFromNode(node);
    EXPECT_EQ(chain.scene.transforms.worldFromNode(chain.nodes.back()), product);
    const uint32_t at = chain.scene.renderables.index.at(chain.renderables.back());
    EXPECT_EQ(chain.scene.renderables.placement[at].translation, double3(product[3]));
}

TEST(UpdateTransforms, NeitherTheOrderOfEditsNorTheirNumberChangesABit) {
    jobs::JobSystem jobs({ .workers = 1 });
    Forest direct(3000, 50), roundabout(3000, 50);
    direct.changeSome(1, 500);
    updateTransforms(jobs, direct.scene);

    updateTransforms(jobs, roundabout.scene);
    for (Node node : { roundabout.nodes[7], roundabout.nodes[700] }) {
        const Node parent = roundabout.scene.transforms.parent(node);
        roundabout.scene.transforms.setParent(node, {});
        updateTransforms(jobs, roundabout.scene);
        roundabout.scene.transforms.setParent(node, parent);
    }
    roundabout.changeSome(2, 500);
    updateTransforms(jobs, roundabout.scene);
    for (size_t i = direct.nodes.size(); i-- > 0;) {
        roundabout.scene.transforms.setTransform(roundabout.nodes[i],
                                                 direct.scene.transforms.parentFromNode(direct.nodes[i]));
    }
    updateTransforms(jobs, roundabout.scene);
    EXPECT_EQ(roundabout.hash(), direct.hash());
}

TEST(UpdateTransforms, WhatIsAttachedToANodeThatRestsIsPlacedToo) {
    jobs::JobSystem jobs({ .workers = 1 });
    Forest forest(2000, 2000);
    updateTransforms(jobs, forest.scene);
    std::vector<Renderable> late;
    for (const Node node : forest.nodes) {
        late.push_back(scene::addRenderable(
                forest.scene, { .material = &forest.instance, .boundsMin = float3(-1), .boundsMax = float3(1) }));
        scene::attach(forest.scene, late.back(), node);
    }
    updateTransforms(jobs, forest.scene);
    for (size_t i = 0; i < late.size(); ++i) {
        const uint32_t at = forest.scene.renderables.index.at(late[i]);
        EXPECT_EQ(forest.scene.renderables.placement[at].translation,
                  double3(forest.scene.transforms.worldFromNode(forest.nodes[i])[3]));
    }
}

TEST(UpdateTransforms, RemovingANodeRemovesEverythingThatHangsBelow) {
    jobs::JobSystem jobs({ .workers = 1 });
    Forest forest(3000, 3000);
    const Node root = forest.nodes[0], outside = forest.scene.transforms.add({}, double4x4(1.0), {});
    const Light inside = scene::addLight(forest.scene, {}), free = scene::addLight(forest.scene, {});
    scene::attach(forest.scene, inside, forest.nodes[2999]);
    const Renderable kept = scene::addRenderable(forest.scene, { .material = &forest.instance });
    scene::attach(forest.scene, kept, outside);
    updateTransforms(jobs, forest.scene);
    scene::removeNode(forest.scene, root);
    EXPECT_EQ(forest.scene.renderables.count(), 1u);
    EXPECT_EQ(forest.scene.lights.index.size(), 1u);
    EXPECT_EQ(scene::nodeOf(forest.scene, kept), outside);
    EXPECT_EQ(scene::nodeOf(forest.scene, free), Node{});
    EXPECT_EQ(forest.scene.transforms.count(), 1u);
    updateTransforms(jobs, forest.scene);
}

/// Boxes below a root in front of a camera.
struct Group {
    explicit Group(double4x4 const& worldFromRoot) {
        const Node root = scene.transforms.add({}, worldFromRoot, {});
        for (int i = 0; i < 50; ++i) {
            double4x4 matrix(1.0);
            matrix[3] = double4(i % 10 * 0.3 - 1.5, i / 10 * 0.3 - 0.7, 0, 1);
            const Node node = scene.transforms.add(root, matrix, {});
            const scene::Geometry geometry{ .vertices = backend::BufferHandle::make(1, 1), .indexCount = 36 };
            const Renderable renderable = scene::addRenderable(
                    scene, { geometry, &instance, float3(-0.1f), float3(0.1f), double4x4(1.0), true, {} });
            scene::attach(scene, renderable, node);
        }
        rootNode = root;
    }

    scene::Material material;
    scene::MaterialInstance instance{ .material = &material };
    scene::SceneData scene;
    Node rootNode;
};

TEST(UpdateTransforms, AGroupMovedByItsRootPreparesToTheSamePacketAsOneAddedThere) {
    jobs::JobSystem jobs({ .workers = 1 });
    Arena arena;
    double4x4 place = double4x4(0.7);
    place[3] = double4(1e6 + 0.25, -3e5, 4e5, 1);
    const std::array view{ ViewInput{ .camera = Camera::lookAt(double3(place[3]) + double3(0, 0, 5), double3(place[3])),
                                      .size = { 640, 480 } } };
    Group added(place), moved(double4x4(1.0));
    updateTransforms(jobs, added.scene);
    updateTransforms(jobs, moved.scene);
    EXPECT_EQ(prepareFrame(jobs, arena, moved.scene, view).mainView().counts.visible, 0u);
    moved.scene.transforms.setTransform(moved.rootNode, place);
    updateTransforms(jobs, moved.scene);
    const FramePacket a = prepareFrame(jobs, arena, added.scene, view);
    const FramePacket b = prepareFrame(jobs, arena, moved.scene, view);
    ASSERT_EQ(a.mainView().counts.visible, 50u);
    ASSERT_EQ(b.mainView().counts.visible, 50u);
    EXPECT_EQ(hashPacket(a), hashPacket(b));
}

using UpdateTransformsDeathTest = testing::Test;

TEST(UpdateTransformsDeathTest, ARenderableOfANodeHasNoTransformOfItsOwn) {
    Forest forest(2, 1);
    EXPECT_DEATH(scene::setTransform(forest.scene, forest.renderables[0], double4x4(1.0)), "moved by its node");
    EXPECT_DEATH(scene::attach(forest.scene, forest.renderables[0], forest.nodes[1]), "one node only");
}

} // namespace
} // namespace filament_core::prepare
