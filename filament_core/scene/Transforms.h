// SPDX-License-Identifier: Apache-2.0
/// Transforms: a forest of nodes in double precision, and which of its world transforms are out of date.
///   In      add, remove, setParent, setTransform, in any order.
///   Out     the world transform of every node: a function of its chain of ancestors only, composed from the root down.
///           Neither the order of edits nor the number of threads changes a bit.
///   Order   an update walks the changed nodes level by level, parents before children. It visits only nodes that moved
///           and their descendants; without changes it ends at its first test.
///   Thread  the app thread, except recompute(), which runs on many threads at once, each with its own range.
///   Memory  about 270 bytes per node, in columns by handle index ("slot"), which grow and are reused. A node never
///           moves in memory, so links and attachments are plain slots.
///   Limits  2^20 - 1 nodes, any depth: nothing here is recursive.
///   Cost    add, setTransform: O(1). remove: its subtree. setParent: its subtree and the difference in depth. A world
///           transform on demand: O(1), or O(depth) while changes are pending. Updates: bench/filament_core/prepare.
///   Fails   a stale handle (ObjectHandles::refuse()) and a cycle end the process. A transform that is not finite
///           counts as zero.
#pragma once

#include "filament_core/scene/Affine.h"
#include "filament_core/scene/ObjectHandles.h"

#include <filament_core/Objects.h>

#include <atomic>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace filament_core::scene {

class Transforms {
public:
    /// The slot of the scene itself, which is the parent of all roots and the identity, but not a node. Node{} stands
    /// for it as a parent or as the root of a search.
    static constexpr uint32_t kScene = 0;

    explicit Transforms(uint16_t owner = 0);

    Node add(Node parent, double4x4 const& parentFromNode, std::string name);
    /// Removes the node and its descendants. Returns the freed slots, parents first, so that callers can drop data kept
    /// by slot.
    std::vector<uint32_t> remove(Node node);
    void setTransform(Node node, double4x4 const& parentFromNode);
    /// The node keeps its parentFromNode, and becomes the last child.
    void setParent(Node node, Node parent);
    /// The node stays in place in the world, up to rounding; below a parent without an inverse it becomes zero.
    void setParentKeepingWorld(Node node, Node parent);

    double4x4 parentFromNode(Node node) const { return matrixFrom(mLocal[slotOf(node)]); }
    double4x4 worldFromNode(Node node) const { return matrixFrom(currentWorld(slotOf(node))); }
    std::string const& name(Node node) const { return mName[slotOf(node)]; }
    Node parent(Node node) const { return mLinks[mLinks[slotOf(node)].parent].node; }
    Node firstChild(Node node) const { return mLinks[mLinks[slotOrScene(node)].firstChild].node; }
    Node nextSibling(Node node) const { return mLinks[mLinks[slotOf(node)].next].node; }
    /// The first node with this name at or below `root`, parents first, children in order; none: Node{}.
    Node find(std::string_view name, Node root) const;
    uint32_t count() const { return mCount; }

    /// False: it was removed, or never existed.
    bool isAlive(Node node) const { return node && node.index() < mLinks.size() && mLinks[node.index()].node == node; }
    /// All slots are below this.
    size_t slotLimit() const { return mLinks.size(); }

    uint32_t slotOf(Node node) const {
        if (!isAlive(node)) mHandles.refuse(node);
        return node.index();
    }

    // Things attached to nodes must be placed after every update, and when they were attached between updates.

    /// Something was attached to the node: takeUnplaced() will return it, unless the next update visits it anyway.
    void markUnplaced(Node node);
    /// Slots of nodes that did not move but have new attachments.
    std::vector<uint32_t> const& takeUnplaced();
    bool contains(Node node) const { return node && node.index() < mLinks.size() && nodeAt(node.index()) == node; }
    Node nodeAt(uint32_t slot) const { return mLinks[slot].node; }
    /// As of the last update.
    Affine const& worldAt(uint32_t slot) const { return mWorld[slot]; }

    // An update, in steps; prepare/UpdateTransforms.h runs them:
    //   if (isStale()) for (beginUpdate(); nextLevel();) recompute(0, levelSize()), or its parts on several threads

    bool isStale() const { return !mChanged.empty() || !mUnplaced.empty(); }
    void beginUpdate();
    /// Collects the next level of changed nodes; false at the end.
    bool nextLevel();
    uint32_t levelSize() const { return mLevelEnd - mLevelBegin; }
    /// Computes the world transforms of nodes [begin, end) of this level, queues their children for the next level, and
    /// returns their slots.
    std::span<const uint32_t> recompute(uint32_t begin, uint32_t end);

private:
    struct Links {
        uint32_t parent = kScene;
        uint32_t firstChild = kScene, lastChild = kScene; ///< lists end with kScene, which is never a child
        uint32_t next = kScene, previous = kScene;
        uint32_t childCount = 0;
        uint32_t depth = 0; ///< 1 for roots
        Node node{};        ///< none: the slot is free, or the scene's
    };

    enum Flag : uint8_t {
        kStale = 1,    ///< the next update computes it: it or an ancestor is in mChanged
        kListed = 2,   ///< in mChanged
        kQueued = 4,   ///< queued in the running update
        kUnplaced = 8, ///< in mUnplaced
    };

    uint32_t slotOrScene(Node node) const { return node ? slotOf(node) : kScene; }
    Affine currentWorld(uint32_t slot) const;
    void growTo(uint32_t slots);
    void markChanged(uint32_t slot);
    void link(uint32_t slot, uint32_t parent);
    void unlink(uint32_t slot);
    void setDepths(uint32_t root);
    uint32_t nextInSubtree(uint32_t slot, uint32_t root) const;
    void move(uint32_t slot, uint32_t parent);
    void listByDepth();
    void prefetch(uint32_t slot) const;

    ObjectHandles<NodeObject> mHandles;
    uint32_t mCount = 0;

    std::vector<Links> mLinks;
    std::vector<Affine> mLocal, mWorld;
    std::vector<uint8_t> mFlags;
    std::vector<std::string> mName;

    std::vector<uint32_t> mChanged; // slots in the order of marking; some may have been removed since
    std::vector<uint32_t> mUnplaced, mTakenUnplaced;

    // The running update: changed nodes, level after level. Threads claim ranges of the queue as they go, so the order
    // within a level varies; no value depends on it.
    std::vector<uint32_t> mQueue;
    std::atomic<uint32_t> mQueueEnd{ 0 };
    uint32_t mLevelBegin = 0, mLevelEnd = 0;
    std::vector<uint32_t> mByDepth, mDepthStarts; // mChanged, counting-sorted
    uint32_t mNextListed = 0;                     // into mByDepth
};

} // namespace filament_core::scene
