// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/Transforms.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace filament_core::scene {
namespace {

constexpr size_t kPrefetchAhead = 6; // nodes

} // namespace

Transforms::Transforms(uint16_t owner) : mHandles(owner) {
    mHandles.allocate(); // index 0 belongs to the scene
    growTo(1);
}

Node Transforms::add(Node parent, double4x4 const& parentFromNode, std::string name) {
    const uint32_t above = slotOrScene(parent);
    const Node node = mHandles.allocate();
    const uint32_t slot = node.index();
    growTo(slot + 1);
    mLinks[slot].node = node;
    mLinks[slot].depth = mLinks[above].depth + 1;
    mLocal[slot] = affineFrom(parentFromNode);
    mName[slot] = std::move(name);
    link(slot, above);
    ++mCount;
    if (mFlags[above] & kStale) {
        mFlags[slot] = kStale; // updated with its parent
    } else {
        markChanged(slot);
    }
    return node;
}

std::vector<uint32_t> Transforms::remove(Node node) {
    const uint32_t root = slotOf(node);
    std::vector<uint32_t> subtree;
    // The whole subtree is listed first: the walk follows the links that removing clears.
    for (uint32_t slot = root; slot != kScene; slot = nextInSubtree(slot, root)) subtree.push_back(slot);
    unlink(root);
    for (const uint32_t slot : subtree) {
        mHandles.free(mLinks[slot].node);
        mLinks[slot] = {};
        mFlags[slot] = 0; // lists that still contain it skip it from now on
        mName[slot].clear();
    }
    mCount -= static_cast<uint32_t>(subtree.size());
    return subtree;
}

void Transforms::setTransform(Node node, double4x4 const& parentFromNode) {
    const uint32_t slot = slotOf(node);
    markChanged(slot);
    mLocal[slot] = affineFrom(parentFromNode);
}

void Transforms::setParent(Node node, Node parent) {
    const uint32_t slot = slotOf(node);
    move(slot, slotOrScene(parent));
    markChanged(slot);
}

void Transforms::setParentKeepingWorld(Node node, Node parent) {
    const uint32_t slot = slotOf(node), above = slotOrScene(parent);
    const Affine world = currentWorld(slot);
    // Both matrices are computed before the move, because currentWorld() follows the links.
    const Affine local = compose(inverse(currentWorld(above)), world);
    move(slot, above);
    mLocal[slot] = local;
    markChanged(slot);
}

void Transforms::move(uint32_t slot, uint32_t parent) {
    uint32_t ancestor = parent;
    while (mLinks[ancestor].depth > mLinks[slot].depth) ancestor = mLinks[ancestor].parent;
    // Before anything is unlinked: a cycle would make every later walk endless. Depths keep the search short.
    FILAMENT_ASSERT(ancestor != slot, "a node is never its own ancestor: the new parent is the node or hangs below it");
    unlink(slot);
    link(slot, parent);
    setDepths(slot);
}

Node Transforms::find(std::string_view name, Node root) const {
    const uint32_t top = slotOrScene(root);
    for (uint32_t slot = top == kScene ? mLinks[kScene].firstChild : top; slot != kScene;
         slot = nextInSubtree(slot, top)) {
        if (mName[slot] == name) return mLinks[slot].node;
    }
    return {};
}

/// The next node in a walk through the subtree of `root`, parents first; kScene at the end.
uint32_t Transforms::nextInSubtree(uint32_t slot, uint32_t root) const {
    if (mLinks[slot].firstChild != kScene) return mLinks[slot].firstChild;
    while (slot != root) {
        if (mLinks[slot].next != kScene) return mLinks[slot].next;
        slot = mLinks[slot].parent;
    }
    return kScene;
}

void Transforms::link(uint32_t slot, uint32_t parent) {
    Links& above = mLinks[parent];
    mLinks[slot].parent = parent;
    mLinks[slot].previous = above.lastChild;
    mLinks[slot].next = kScene;
    (above.lastChild == kScene ? above.firstChild : mLinks[above.lastChild].next) = slot;
    above.lastChild = slot;
    ++above.childCount;
}

void Transforms::unlink(uint32_t slot) {
    const Links links = mLinks[slot];
    Links& above = mLinks[links.parent];
    (links.previous == kScene ? above.firstChild : mLinks[links.previous].next) = links.next;
    (links.next == kScene ? above.lastChild : mLinks[links.next].previous) = links.previous;
    --above.childCount;
}

/// Called after `root` got another parent.
void Transforms::setDepths(uint32_t root) {
    const uint32_t depth = mLinks[mLinks[root].parent].depth + 1;
    if (mLinks[root].depth == depth) return;
    for (uint32_t slot = root; slot != kScene; slot = nextInSubtree(slot, root)) {
        mLinks[slot].depth = mLinks[mLinks[slot].parent].depth + 1;
    }
}

void Transforms::growTo(uint32_t slots) {
    if (slots <= mLinks.size()) return;
    mLinks.resize(slots);
    mLocal.resize(slots, kIdentity);
    mWorld.resize(slots, kIdentity);
    mFlags.resize(slots);
    mName.resize(slots);
}

void Transforms::markChanged(uint32_t slot) {
    if (mFlags[slot] & kListed) return;
    mChanged.push_back(slot);
    mFlags[slot] |= kListed | kStale;
}

void Transforms::markUnplaced(Node node) {
    const uint32_t slot = slotOf(node);
    if (mFlags[slot] & (kStale | kUnplaced)) return;
    mUnplaced.push_back(slot);
    mFlags[slot] |= kUnplaced;
}

std::vector<uint32_t> const& Transforms::takeUnplaced() {
    mTakenUnplaced.clear();
    mTakenUnplaced.reserve(mUnplaced.size());
    for (const uint32_t slot : mUnplaced) {
        if (mFlags[slot] & kUnplaced) mTakenUnplaced.push_back(slot);
        mFlags[slot] &= static_cast<uint8_t>(~kUnplaced);
    }
    mUnplaced.clear();
    return mTakenUnplaced;
}

/// Computes from the highest changed ancestor downwards, like an update, so that the bits are the same.
Affine Transforms::currentWorld(uint32_t slot) const {
    if (mChanged.empty()) return mWorld[slot];
    std::vector<uint32_t> chain;
    size_t changed = 0; // how many nodes at the end of the chain must be computed
    for (uint32_t at = slot; at != kScene; at = mLinks[at].parent) {
        chain.push_back(at);
        if (mFlags[at] & kListed) changed = chain.size();
    }
    if (changed == 0) return mWorld[slot];
    Affine world = mWorld[mLinks[chain[changed - 1]].parent];
    for (size_t i = changed; i-- > 0;) world = compose(world, mLocal[chain[i]]);
    return world;
}

void Transforms::beginUpdate() {
    // Workers append to the queue without a check. It never needs more places than there are nodes, because each is
    // queued once.
    if (mQueue.size() < mLinks.size()) mQueue.resize(mLinks.size());
    listByDepth();
    mChanged.clear();
    mQueueEnd.store(0, std::memory_order_relaxed);
    mLevelBegin = mLevelEnd = mNextListed = 0;
}

/// Counting sort of the changed nodes, except those that are updated with a changed parent. Allocates first, so that
/// running out of memory leaves the update unstarted.
void Transforms::listByDepth() {
    uint32_t deepest = 0;
    for (const uint32_t slot : mChanged) deepest = std::max(deepest, mLinks[slot].depth);
    mDepthStarts.assign(deepest + 2, 0);
    mByDepth.reserve(mChanged.size());
    std::erase_if(mChanged,
                  [&](uint32_t slot) { return !(mFlags[slot] & kListed) || (mFlags[mLinks[slot].parent] & kListed); });
    for (const uint32_t slot : mChanged) ++mDepthStarts[mLinks[slot].depth + 1];
    for (size_t i = 1; i < mDepthStarts.size(); ++i) mDepthStarts[i] += mDepthStarts[i - 1];
    mByDepth.resize(mChanged.size());
    for (const uint32_t slot : mChanged) mByDepth[mDepthStarts[mLinks[slot].depth]++] = slot;
}

bool Transforms::nextLevel() {
    mLevelBegin = mLevelEnd;
    mLevelEnd = mQueueEnd.load(std::memory_order_relaxed);
    const auto isWaiting = [&](uint32_t slot) { return (mFlags[slot] & (kListed | kQueued)) == kListed; };
    while (mNextListed < mByDepth.size() && !isWaiting(mByDepth[mNextListed])) ++mNextListed;
    if (mNextListed == mByDepth.size()) return mLevelBegin != mLevelEnd;
    const uint32_t depth = mLinks[mLevelBegin != mLevelEnd ? mQueue[mLevelBegin] : mByDepth[mNextListed]].depth;
    // A node is computed from the finished matrix of its parent. A changed node therefore joins the level of its own
    // depth, together with the children of the level before; one that such a parent has queued already is left out.
    for (; mNextListed < mByDepth.size() && mLinks[mByDepth[mNextListed]].depth <= depth; ++mNextListed) {
        const uint32_t slot = mByDepth[mNextListed];
        if (!isWaiting(slot)) continue;
        mFlags[slot] |= kQueued;
        mQueue[mLevelEnd++] = slot;
    }
    mQueueEnd.store(mLevelEnd, std::memory_order_relaxed);
    return true;
}

/// Prefetches the two matrices of a node, at least three cache lines, while others are computed: saves 20 to 30 % of an
/// update of 100 000 nodes.
void Transforms::prefetch(uint32_t slot) const {
    constexpr size_t kLine = 64;
    __builtin_prefetch(&mLocal[slot]);
    __builtin_prefetch(reinterpret_cast<const std::byte*>(&mLocal[slot]) + kLine);
    __builtin_prefetch(&mWorld[slot], 1);
    __builtin_prefetch(reinterpret_cast<const std::byte*>(&mWorld[slot]) + kLine, 1);
}

std::span<const uint32_t> Transforms::recompute(uint32_t begin, uint32_t end) {
    const std::span<const uint32_t> slots(mQueue.data() + mLevelBegin + begin, end - begin);
    uint32_t children = 0;
    for (const uint32_t slot : slots) children += mLinks[slot].childCount;
    // Relaxed: the addition only gives each job places of its own, and the end of a level's jobs orders the contents.
    // The order in the queue depends on the workers, the matrices do not, since a node reads only its parent.
    uint32_t out = children ? mQueueEnd.fetch_add(children, std::memory_order_relaxed) : 0;
    for (size_t i = 0; i < slots.size(); ++i) {
        prefetch(slots[std::min(i + kPrefetchAhead, slots.size() - 1)]);
        const uint32_t slot = slots[i];
        Links const& links = mLinks[slot];
        mWorld[slot] = compose(mWorld[links.parent], mLocal[slot]);
        mFlags[slot] = 0;
        for (uint32_t child = links.firstChild; child != kScene; child = mLinks[child].next) {
            mFlags[child] |= kQueued;
            mQueue[out++] = child;
        }
    }
    return slots;
}

} // namespace filament_core::scene
