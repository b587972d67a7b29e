// SPDX-License-Identifier: Apache-2.0
/// RestingBlocks: renderables that rest near each other, in blocks with a box around each, so that a view leaves out
/// whole blocks. What moved lately is in none: a renderable that moves costs one test of a bit.
///   In      positions of renderables; noteMoved() whenever the box of one changes; settle() once a frame.
///   Out     blocks of at most kMembers positions, and a bit for each renderable that the blocks do not speak for. The
///           box of a block contains the boxes of all members whose bit is not set. Which renderables share a block
///           affects no result: readers of blocks get every renderable that may matter, and others.
///   How     a k-d tree (Bentley 1975) over centres and sizes: a full block is split at the median of what varies most,
///           and neighbours that are nearly empty join. Moved members stay where they were until they come to rest,
///           and settle once they rested for at least kRestFrames: settling takes as long as testing a box in about
///           fifty frames. What was added rests.
///   Thread  the app thread between frames; noteMoved() on many threads at once, each with its own renderables.
///   Memory  about 12 bytes a renderable; 5 in scenes below kFewest.
///   Fails   settle(): std::bad_alloc; what is settled then remains.
///   Cost    settle(): 0.3 us for each renderable that comes to rest, at most kMostSettled a call.
#pragma once

#include "filament_core/scene/BoundsColumns.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace filament_core::scene {

class RestingBlocks {
public:
    static constexpr uint32_t kMembers = 64;
    static constexpr uint32_t kFewest = 4096;      ///< renderables; with fewer, testing all of them takes less
    static constexpr uint32_t kMostSettled = 8192; ///< a call
    static constexpr uint32_t kRestFrames = 64;

    /// Bit i: the renderable at 64 * (index of the word) + i.
    struct Word {
        uint64_t unsettled = 0;              ///< in no block, or its box is not in that of its block
        uint64_t moved = 0, movedBefore = 0; ///< since the last pass began, and in the pass before; always unsettled
        uint64_t unfit = 0;                  ///< unsettled for as long as it does not move
        uint64_t added = 0, addedBefore = 0; ///< it is new at its position since then, and in the pass before

        uint64_t moving() const { return moved | movedBefore; }
        uint64_t recent() const { return moving() | added | addedBefore; }
    };

    /// At the next position.
    void add();
    /// The last position takes the place of `gap`.
    void remove(uint32_t gap);
    /// Its box changed.
    void noteMoved(uint32_t at) {
        Word& word = mWords[at / 64];
        const uint64_t bit = uint64_t{ 1 } << at % 64;
        if (std::atomic_ref(word.moved).load(std::memory_order_relaxed) & bit) return;
        std::atomic_ref(word.unsettled).fetch_or(bit, std::memory_order_relaxed);
        std::atomic_ref(word.unfit).fetch_and(~bit, std::memory_order_relaxed);
        std::atomic_ref(word.moved).fetch_or(bit, std::memory_order_relaxed);
    }
    /// Since the last pass began, or in the pass before. On many threads, as noteMoved().
    bool isMoving(uint32_t at) const {
        Word& word = const_cast<Word&>(mWords[at / 64]); // atomic_ref of C++20 wants it so
        const uint64_t moved = std::atomic_ref(word.moved).load(std::memory_order_relaxed);
        return ((moved | word.movedBefore) >> at % 64 & 1) != 0;
    }
    /// How often movedBefore became moved. A pass begins in settle(), after kRestFrames calls at the earliest.
    uint64_t pass() const { return mPass; }

    /// Takes renderables that rest into blocks. `flags`: RenderableFlag.
    void settle(BoundsColumns const& boxes, std::span<const uint8_t> flags);

    std::span<const Word> words() const { return mWords; }
    uint32_t settled() const { return mSettled; } ///< members of all blocks
    /// Half of all, or more; false: there may be no block.
    bool holdMost() const { return mSettled > 0 && mSettled >= 32 * words().size(); }
    /// Numbers of blocks are below this; some may be empty.
    uint32_t limit() const { return mLimit; }
    BoundsColumns const& bounds() const { return mBounds; } ///< of blocks
    std::span<const uint32_t> members(uint32_t block) const {
        return { mMembers.data() + size_t{ block } * kMembers, mCounts[block] };
    }
    uint32_t depth() const; ///< of the tree

private:
    static constexpr uint32_t kNone = ~0u;
    enum Axis : uint8_t { X, Y, Z, Size, Position, Leaf };
    struct Node {
        double split = 0;                                       ///< smaller: in the first child
        uint32_t first = kNone, second = kNone, parent = kNone; ///< of leaves: the block is `first`
        Axis axis = Leaf;
    };

    struct Cut {
        Axis axis = Leaf;
        double at = 0;
    };

    bool isUnsettled(uint32_t at) const { return (mWords[at / 64].unsettled >> at % 64 & 1) != 0; }
    void loosen(uint32_t block) { mLoosened[block] += mLoosened[block] < 255; }
    bool isFit(BoundsColumns const& boxes, std::span<const uint8_t> flags, uint32_t at) const;
    void beginPass();
    void refitSome(BoundsColumns const& boxes);
    void settleOne(BoundsColumns const& boxes, uint32_t at);
    uint32_t leafFor(BoundsColumns const& boxes, uint32_t at);
    static Cut cutOf(std::array<std::array<double, kMembers>, 5> const& keys);
    void split(BoundsColumns const& boxes, uint32_t leaf);
    void put(BoundsColumns const& boxes, uint32_t at, uint32_t block);
    void includeMember(BoundsColumns const& boxes, uint32_t at, uint32_t block);
    void takeOut(uint32_t at);
    void dropLeaf(uint32_t leaf);
    void joinNeighbor(uint32_t leaf);
    void replace(uint32_t node, uint32_t by);
    void include(uint32_t block, double3 const& low, double3 const& high);
    void fitBounds(BoundsColumns const& boxes, uint32_t block);
    void reserveBlock();
    uint32_t newBlock();
    uint32_t newNode();
    void rebalance();
    uint32_t build(std::span<uint32_t> blocks, uint32_t parent);

    std::vector<Word> mWords;
    std::vector<uint32_t> mPlaces; // by position: block * kMembers + slot, or kNone

    BoundsColumns mBounds; // by block, as the next four
    std::vector<uint32_t> mMembers;
    std::vector<uint8_t> mCounts, mLoosened; // how many members left since the box was fitted
    std::vector<uint32_t> mLeaves;           // the node of the block
    uint32_t mLimit = 0, mSettled = 0;
    std::vector<uint32_t> mFreeBlocks, mFreeNodes;
    std::vector<Node> mNodes;
    uint32_t mRoot = kNone;

    uint32_t mCount = 0, mCalls = kRestFrames; // since the pass began
    uint64_t mPass = 0;
    uint32_t mPassWords = 0, mCursor = 0, mStride = 1;
    uint32_t mDeepest = 0; // that settling saw
    uint32_t mRefit = 0;   // the block that refitSome() looked at last
    std::vector<uint32_t> mOrder;
};

} // namespace filament_core::scene
