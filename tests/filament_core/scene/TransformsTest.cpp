// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/Transforms.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace filament_core::scene {
namespace {

using testing::ElementsAre;

double4x4 moved(double x, double y = 0, double z = 0) {
    double4x4 matrix(1.0);
    matrix[3] = double4(x, y, z, 1);
    return matrix;
}

struct TransformsTest : testing::Test {
    Transforms transforms;

    Node add(Node parent, double x, std::string name = {}) { return transforms.add(parent, moved(x), std::move(name)); }
    double worldX(Node node) const { return transforms.worldFromNode(node)[3].x; }

    /// Returns how many nodes were computed.
    uint32_t update() {
        uint32_t count = 0;
        if (!transforms.isStale()) return count;
        for (transforms.beginUpdate(); transforms.nextLevel();) {
            count += static_cast<uint32_t>(transforms.recompute(0, transforms.levelSize()).size());
        }
        transforms.takeUnplaced();
        return count;
    }

    std::vector<std::string> namesBelow(Node parent) const {
        std::vector<std::string> names;
        for (Node child = transforms.firstChild(parent); child; child = transforms.nextSibling(child)) {
            names.push_back(transforms.name(child));
        }
        return names;
    }
};

TEST_F(TransformsTest, ChildrenStandWhereTheirParentsPutThem) {
    const Node root = add({}, 100), child = add(root, 10), grandChild = add(child, 1);
    EXPECT_EQ(worldX(grandChild), 111) << "before any update";
    EXPECT_EQ(update(), 3u);
    EXPECT_EQ(worldX(grandChild), 111);
    EXPECT_EQ(transforms.parent(grandChild), child);
    EXPECT_EQ(transforms.parent(root), Node{});
    EXPECT_EQ(transforms.parentFromNode(child)[3].x, 10);
}

TEST_F(TransformsTest, AnUpdateVisitsWhatChangedAndWhatHangsBelowItOnce) {
    const Node a = add({}, 1), b = add(a, 2), c = add(b, 3), other = add({}, 9);
    add(a, 7);
    EXPECT_EQ(update(), 5u);
    EXPECT_FALSE(transforms.isStale());
    EXPECT_EQ(update(), 0u);
    transforms.setTransform(c, moved(30));
    EXPECT_EQ(update(), 1u);
    transforms.setTransform(c, moved(31));
    transforms.setTransform(b, moved(20));
    transforms.setTransform(b, moved(21));
    EXPECT_EQ(worldX(c), 1 + 21 + 31);
    EXPECT_EQ(worldX(other), 9);
    EXPECT_EQ(update(), 2u);
    EXPECT_EQ(worldX(c), 1 + 21 + 31);
    transforms.setTransform(c, moved(32));
    transforms.setTransform(a, moved(5)); // takes b along, b takes c along
    EXPECT_EQ(update(), 4u);
    EXPECT_EQ(worldX(c), 5 + 21 + 32);
}

TEST_F(TransformsTest, ListsChildrenInTheOrderTheyCame) {
    const Node root = add({}, 0, "root"), a = add(root, 0, "a"), b = add(root, 0, "b"), c = add(root, 0, "c");
    EXPECT_THAT(namesBelow(root), ElementsAre("a", "b", "c"));
    transforms.remove(b);
    EXPECT_THAT(namesBelow(root), ElementsAre("a", "c"));
    transforms.setParent(a, root);
    EXPECT_THAT(namesBelow(root), ElementsAre("c", "a"));
    transforms.setParent(c, {});
    EXPECT_THAT(namesBelow(root), ElementsAre("a"));
    EXPECT_THAT(namesBelow({}), ElementsAre("root", "c"));
}

TEST_F(TransformsTest, RemovesAWholeSubtreeAndNothingElse) {
    const Node keep = add({}, 1), gone = add({}, 2), child = add(gone, 3), grandChild = add(child, 4);
    EXPECT_THAT(transforms.remove(gone), ElementsAre(gone.index(), child.index(), grandChild.index()));
    EXPECT_EQ(transforms.count(), 1u);
    EXPECT_EQ(update(), 1u) << "nodes that were removed before their first update are not computed";
    EXPECT_EQ(worldX(keep), 1);
    const Node reused = add(keep, 5);
    EXPECT_EQ(transforms.firstChild(reused), Node{});
    EXPECT_EQ(worldX(reused), 6);
}

TEST_F(TransformsTest, ASlotThatIsUsedAgainBeforeAnUpdateIsComputedOnce) {
    const Node root = add({}, 1);
    update();
    transforms.remove(add(root, 2));
    const Node child = add(root, 3);
    EXPECT_EQ(update(), 1u);
    EXPECT_EQ(worldX(child), 4);
}

TEST_F(TransformsTest, ReparentingKeepsTheLocalTransformOrThePlaceInTheWorld) {
    const Node a = add({}, 100), b = transforms.add({}, double4x4(2.0), {}), child = add(a, 1), below = add(child, 1);
    transforms.setTransform(b, [] {
        double4x4 matrix = moved(8);
        matrix[0][0] = -2;
        return matrix;
    }());
    update();
    transforms.setParent(child, b);
    EXPECT_EQ(worldX(child), 8 - 2);
    EXPECT_EQ(worldX(below), 8 - 4);
    EXPECT_EQ(update(), 2u);
    EXPECT_EQ(worldX(below), 8 - 4);
    transforms.setParentKeepingWorld(child, a);
    EXPECT_EQ(worldX(child), 8 - 2);
    EXPECT_EQ(worldX(below), 8 - 4);
    EXPECT_EQ(transforms.parentFromNode(child)[0][0], -2);
    transforms.setParentKeepingWorld(child, {});
    EXPECT_EQ(worldX(below), 8 - 4);
}

TEST_F(TransformsTest, WhatIsNotFiniteCollapsesToAPointAndNeverToNan) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
    double4x4 huge(1e200);
    huge[3] = double4(0, 0, 0, 1);
    const Node root = add({}, 5), child = add(root, 1);
    for (double4x4 const& broken : { moved(kNan), moved(kInf), moved(-kInf) }) {
        transforms.setTransform(root, broken);
        EXPECT_EQ(transforms.worldFromNode(child)[0], double4(0));
        update();
        EXPECT_EQ(transforms.worldFromNode(child)[0], double4(0));
        EXPECT_EQ(transforms.worldFromNode(child)[3], double4(0, 0, 0, 1));
    }
    transforms.setTransform(root, huge);
    transforms.setTransform(child, huge);
    update();
    EXPECT_EQ(transforms.worldFromNode(root)[0].x, 1e200);
    EXPECT_EQ(transforms.worldFromNode(child)[0], double4(0)) << "the product overflows";
    transforms.setTransform(root, moved(5));
    transforms.setTransform(child, moved(1));
    EXPECT_EQ(worldX(child), 6) << "a broken transform is forgotten when it is replaced";
}

TEST_F(TransformsTest, TheLastRowCountsAsThatOfAnAffineTransform) {
    double4x4 odd = moved(3);
    odd[0].w = 1, odd[3].w = 2;
    const Node root = transforms.add({}, odd, {});
    EXPECT_EQ(transforms.worldFromNode(root), moved(3));
    EXPECT_EQ(worldX(add(root, 1)), 4);
}

TEST_F(TransformsTest, AParentWithoutInverseCannotKeepAChildWhereItIs) {
    const Node flat = transforms.add({},
                                     [] {
                                         double4x4 matrix = moved(3);
                                         matrix[1][1] = 0;
                                         return matrix;
                                     }(),
                                     {});
    const Node child = add({}, 1);
    transforms.setParentKeepingWorld(child, flat);
    EXPECT_EQ(transforms.parentFromNode(child)[0], double4(0));
    EXPECT_EQ(worldX(child), 3);
}

TEST_F(TransformsTest, FindsTheFirstNodeOfANameParentsFirst) {
    const Node a = add({}, 0, "a"), deep = add(a, 0, "x"), deeper = add(deep, 0, "wheel");
    const Node second = add(a, 0, "wheel"), b = add({}, 0, "b"), third = add(b, 0, "wheel");
    EXPECT_EQ(transforms.find("wheel", {}), deeper);
    EXPECT_EQ(transforms.find("wheel", a), deeper);
    EXPECT_EQ(transforms.find("wheel", second), second);
    EXPECT_EQ(transforms.find("wheel", b), third);
    EXPECT_EQ(transforms.find("b", a), Node{}) << "a sibling of the root is outside";
    EXPECT_EQ(transforms.find("nobody", {}), Node{});
    EXPECT_EQ(Transforms().find("", {}), Node{}) << "the scene itself is no node";
}

TEST_F(TransformsTest, DeepChainsAreMovedSearchedAndRemovedWithoutRecursion) {
    constexpr uint32_t kDepth = 20'000;
    Node last{};
    std::vector<Node> chain;
    for (uint32_t i = 0; i < kDepth; ++i) chain.push_back(last = add(last, 1, i + 1 == kDepth ? "end" : ""));
    EXPECT_EQ(worldX(last), kDepth);
    EXPECT_EQ(update(), kDepth);
    EXPECT_EQ(worldX(last), kDepth);
    EXPECT_EQ(transforms.find("end", {}), last);
    const Node side = add({}, 0.5);
    transforms.setParent(chain[kDepth / 2], side);
    EXPECT_EQ(worldX(last), 0.5 + kDepth / 2);
    EXPECT_EQ(update(), kDepth / 2 + 1);
    EXPECT_EQ(worldX(last), 0.5 + kDepth / 2);
    EXPECT_EQ(transforms.remove(side).size(), kDepth / 2 + 1);
    transforms.remove(chain[0]);
    EXPECT_EQ(transforms.count(), 0u);
}

TEST_F(TransformsTest, OnlyWhatAnUpdateDoesNotVisitIsUnplaced) {
    const Node a = add({}, 0), b = add(a, 0);
    transforms.markUnplaced(b);
    EXPECT_TRUE(transforms.takeUnplaced().empty()) << "b is computed by the next update anyway";
    update();
    transforms.markUnplaced(b);
    transforms.markUnplaced(b);
    EXPECT_TRUE(transforms.isStale());
    EXPECT_THAT(transforms.takeUnplaced(), ElementsAre(b.index()));
    EXPECT_FALSE(transforms.isStale());
    transforms.markUnplaced(b);
    transforms.remove(b);
    EXPECT_TRUE(transforms.takeUnplaced().empty());
}

using TransformsDeathTest = TransformsTest;

TEST_F(TransformsDeathTest, NamesTheRuleOfACycle) {
    const Node a = add({}, 0), b = add(a, 0), c = add(b, 0);
    EXPECT_DEATH(transforms.setParent(a, c), "never its own ancestor");
    EXPECT_DEATH(transforms.setParent(a, a), "never its own ancestor");
    EXPECT_DEATH(transforms.setParentKeepingWorld(b, c), "never its own ancestor");
}

TEST_F(TransformsDeathTest, NamesTheRuleOfAStaleHandle) {
    const Node a = add({}, 0), b = add(a, 0);
    transforms.remove(a);
    const Node reused = add({}, 0);
    EXPECT_EQ(reused.index(), b.index());
    for (const Node stale : { a, b }) {
        EXPECT_DEATH(transforms.setTransform(stale, double4x4(1.0)), "the node was removed from the scene");
        EXPECT_DEATH(transforms.add(stale, double4x4(1.0), {}), "the node was removed from the scene");
        EXPECT_DEATH(transforms.remove(stale), "the node was removed from the scene");
    }
    EXPECT_DEATH(transforms.remove({}), "the node is null");
    EXPECT_DEATH(transforms.worldFromNode(Node::make(12345, 1)), "the node was removed from the scene");
}

} // namespace
} // namespace filament_core::scene
