// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/RestingBlocks.h"

#include "base/Assert.h"
#include "filament_core/scene/DenseIndex.h"
#include "filament_core/scene/Renderables.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

namespace filament_core::scene {
namespace {

constexpr uint32_t kFewMembers = RestingBlocks::kMembers / 2; ///< neighbours with so few join
constexpr uint8_t kMostLoosened = 16;
constexpr uint32_t kMostLooked = 256, kMostFitted = 16; // blocks, a call
constexpr double kLargest = 1e30;                       // metres

/// Spreads neighbouring positions.
double scattered(uint32_t at) { return at * 2654435769u; }

float largest(float3 v) { return std::max({ v.x, v.y, v.z }); }

/// What the tree splits by.
std::array<double, 5> keysOf(BoundsColumns const& boxes, uint32_t at) {
    const double3 center = boxes.centerAt(at);
    return { center.x, center.y, center.z, 2.0 * static_cast<double>(largest(boxes.halfExtentAt(at))), scattered(at) };
}

uint32_t depthLimit(uint32_t blocks) { return 3 * static_cast<uint32_t>(std::bit_width(blocks)) + 8; }

} // namespace

void RestingBlocks::add() {
    const uint32_t at = mCount;
    append(mPlaces, kNone);
    if (at / 64 >= mWords.size()) append(mWords, {});
    mWords[at / 64].unsettled |= uint64_t{ 1 } << at % 64;
    mWords[at / 64].added |= uint64_t{ 1 } << at % 64;
    ++mCount;
}

void RestingBlocks::remove(uint32_t gap) {
    const uint32_t last = mCount - 1;
    if (mPlaces[gap] != kNone) takeOut(gap);
    Word& to = mWords[gap / 64];
    Word& from = mWords[last / 64];
    const uint64_t toBit = uint64_t{ 1 } << gap % 64, fromBit = uint64_t{ 1 } << last % 64;
    for (uint64_t Word::*plane :
         { &Word::unsettled, &Word::moved, &Word::movedBefore, &Word::unfit, &Word::added, &Word::addedBefore }) {
        const bool isSet = (from.*plane & fromBit) != 0;
        to.*plane = isSet ? to.*plane | toBit : to.*plane & ~toBit;
        from.*plane &= ~fromBit;
    }
    if (gap != last) to.added |= toBit;
    if (gap != last && mPlaces[last] != kNone) mMembers[mPlaces[last]] = gap;
    closeGap(mPlaces, gap);
    --mCount;
    if (mCount <= (mWords.size() - 1) * 64) mWords.pop_back();
}

bool RestingBlocks::isFit(BoundsColumns const& boxes, std::span<const uint8_t> flags, uint32_t at) const {
    if ((flags[at] & kCulled) == 0) return false; // always in view
    const double3 center = glm::abs(boxes.centerAt(at));
    const float3 half = boxes.halfExtentAt(at);
    const bool isSmall = center.x < kLargest && center.y < kLargest && center.z < kLargest;
    return isSmall && half.x >= 0 && half.y >= 0 && half.z >= 0 && largest(half) < static_cast<float>(kLargest);
}

/// Words are visited in an order that has nothing to do with that of their renderables: trees of sorted insertions
/// would be lists.
void RestingBlocks::beginPass() {
    for (Word& word : mWords) {
        word.movedBefore = std::exchange(word.moved, 0);
        word.addedBefore = std::exchange(word.added, 0);
    }
    ++mPass;
    mCalls = mCursor = 0;
    mPassWords = static_cast<uint32_t>(mWords.size());
    mStride = std::max(1u, static_cast<uint32_t>(0.618 * mPassWords));
    while (std::gcd(mStride, mPassWords) != 1) ++mStride;
}

void RestingBlocks::settle(BoundsColumns const& boxes, std::span<const uint8_t> flags) {
    if (mCursor == mPassWords && mCalls >= kRestFrames) beginPass();
    ++mCalls;
    if (mCount < kFewest) mCursor = mPassWords;
    for (uint32_t settled = 0; mCursor < mPassWords && settled < kMostSettled; ++mCursor) {
        const uint64_t index = uint64_t{ mCursor } * mStride % mPassWords;
        if (index >= mWords.size()) continue;
        Word& word = mWords[index];
        for (uint64_t left = word.unsettled & ~word.moved & ~word.movedBefore & ~word.unfit; left; left &= left - 1) {
            const auto at = static_cast<uint32_t>(index * 64 + static_cast<uint32_t>(std::countr_zero(left)));
            ++settled;
            if (isFit(boxes, flags, at))
                settleOne(boxes, at);
            else
                word.unfit |= left & -left;
        }
    }
    refitSome(boxes);
    if (mDeepest > depthLimit(mLimit)) rebalance();
}

/// Boxes reach where members were until they are fitted again.
void RestingBlocks::refitSome(BoundsColumns const& boxes) {
    for (uint32_t looked = 0, fitted = 0; looked < std::min(kMostLooked, mLimit) && fitted < kMostFitted; ++looked) {
        mRefit = mRefit + 1 < mLimit ? mRefit + 1 : 0;
        if (mLoosened[mRefit] == 0 || mCounts[mRefit] == 0) continue;
        fitBounds(boxes, mRefit);
        ++fitted;
    }
}

void RestingBlocks::settleOne(BoundsColumns const& boxes, uint32_t at) {
    for (;;) {
        reserveBlock();
        const uint32_t leaf = leafFor(boxes, at), block = mNodes[leaf].first, old = mPlaces[at];
        const bool isInside = old != kNone && old / kMembers == block;
        if (!isInside && mCounts[block] == kMembers) {
            split(boxes, leaf);
            continue;
        }
        mWords[at / 64].unsettled &= ~(uint64_t{ 1 } << at % 64);
        if (isInside) {
            loosen(block);
            return includeMember(boxes, at, block);
        }
        if (old != kNone) takeOut(at);
        return put(boxes, at, mNodes[leafFor(boxes, at)].first); // its leaf may have joined another
    }
}

uint32_t RestingBlocks::leafFor(BoundsColumns const& boxes, uint32_t at) {
    if (mRoot == kNone) {
        mRoot = newNode();
        mNodes[mRoot].first = newBlock();
        mLeaves[mNodes[mRoot].first] = mRoot;
    }
    const std::array<double, 5> keys = keysOf(boxes, at);
    uint32_t node = mRoot, depth = 0;
    for (; mNodes[node].axis != Leaf; ++depth)
        node = keys[mNodes[node].axis] < mNodes[node].split ? mNodes[node].first : mNodes[node].second;
    mDeepest = std::max(mDeepest, depth);
    return node;
}

/// At the median of the centres, or in the middle of the sizes if these vary more: a large member makes all of its
/// block large.
RestingBlocks::Cut RestingBlocks::cutOf(std::array<std::array<double, kMembers>, 5> const& keys) {
    Cut cut{ .axis = Position };
    double most = 0;
    for (size_t axis = X; axis <= Position; ++axis) {
        const auto [least, greatest] = std::ranges::minmax(keys[axis]);
        if (axis == Position ? most > 0 : !(greatest - least > most)) continue;
        std::array<double, kMembers> sorted = keys[axis];
        std::ranges::nth_element(sorted, sorted.begin() + kMembers / 2);
        const double at = axis == Size ? (least + greatest) * 0.5 : sorted[kMembers / 2];
        if (!(least < at)) continue; // nothing would be in the first half
        most = greatest - least;
        cut = { static_cast<Axis>(axis), at };
    }
    return cut;
}

void RestingBlocks::split(BoundsColumns const& boxes, uint32_t leaf) {
    const uint32_t block = mNodes[leaf].first;
    const std::span<uint32_t> all(mMembers.data() + size_t{ block } * kMembers, kMembers);
    std::array<std::array<double, kMembers>, 5> keys;
    for (uint32_t i = 0; i < kMembers; ++i) {
        const std::array<double, 5> of = keysOf(boxes, all[i]);
        for (size_t axis = 0; axis < 5; ++axis) keys[axis][i] = of[axis];
    }
    const auto [axis, at] = cutOf(keys);

    const uint32_t other = newBlock();
    uint32_t kept = 0;
    for (uint32_t i = 0; i < kMembers; ++i) {
        const uint32_t member = all[i];
        if (keys[axis][i] < at) {
            mPlaces[member] = block * kMembers + kept;
            all[kept++] = member;
        } else {
            const uint32_t slot = other * kMembers + mCounts[other]++;
            mPlaces[member] = slot;
            mMembers[slot] = member;
        }
    }
    mCounts[block] = static_cast<uint8_t>(kept);
    fitBounds(boxes, block);
    fitBounds(boxes, other);
    const uint32_t first = newNode(), second = newNode();
    mNodes[first] = { .first = block, .parent = leaf };
    mNodes[second] = { .first = other, .parent = leaf };
    mLeaves[block] = first;
    mLeaves[other] = second;
    mNodes[leaf].first = first;
    mNodes[leaf].second = second;
    mNodes[leaf].axis = axis;
    mNodes[leaf].split = at;
}

void RestingBlocks::put(BoundsColumns const& boxes, uint32_t at, uint32_t block) {
    const uint32_t slot = block * kMembers + mCounts[block]++;
    mMembers[slot] = at;
    mPlaces[at] = slot;
    ++mSettled;
    includeMember(boxes, at, block);
}

void RestingBlocks::includeMember(BoundsColumns const& boxes, uint32_t at, uint32_t block) {
    if (mLoosened[block] >= kMostLoosened) return fitBounds(boxes, block);
    const double3 half(boxes.halfExtentAt(at));
    include(block, boxes.centerAt(at) - half, boxes.centerAt(at) + half);
}

void RestingBlocks::takeOut(uint32_t at) {
    const uint32_t place = mPlaces[at], block = place / kMembers;
    const uint32_t last = block * kMembers + --mCounts[block];
    mMembers[place] = mMembers[last];
    mPlaces[mMembers[place]] = place;
    mPlaces[at] = kNone;
    --mSettled;
    loosen(block);
    if (mCounts[block] == 0)
        dropLeaf(mLeaves[block]);
    else if (mCounts[block] <= kFewMembers / 2)
        joinNeighbor(mLeaves[block]);
}

void RestingBlocks::dropLeaf(uint32_t leaf) {
    mFreeBlocks.push_back(mNodes[leaf].first);
    const uint32_t parent = mNodes[leaf].parent;
    if (parent == kNone) {
        mRoot = kNone;
    } else {
        replace(parent, mNodes[parent].first == leaf ? mNodes[parent].second : mNodes[parent].first);
        mFreeNodes.push_back(parent);
    }
    mFreeNodes.push_back(leaf);
}

/// If both are leaves with few members.
void RestingBlocks::joinNeighbor(uint32_t leaf) {
    const uint32_t parent = mNodes[leaf].parent;
    if (parent == kNone) return;
    const uint32_t other = mNodes[parent].first == leaf ? mNodes[parent].second : mNodes[parent].first;
    const uint32_t from = mNodes[leaf].first, to = mNodes[other].first;
    if (mNodes[other].axis != Leaf || mCounts[from] + mCounts[to] > kFewMembers) return;
    for (const uint32_t member : members(from)) {
        const uint32_t slot = to * kMembers + mCounts[to]++;
        mMembers[slot] = member;
        mPlaces[member] = slot;
    }
    mCounts[from] = 0;
    mLoosened[to] = std::max(mLoosened[to], kMostLoosened); // fitted by whatever settles next
    const double3 center = mBounds.centerAt(from), half(mBounds.halfExtentAt(from));
    include(to, center - half, center + half);
    dropLeaf(leaf);
}

void RestingBlocks::replace(uint32_t node, uint32_t by) {
    const uint32_t parent = mNodes[node].parent;
    mNodes[by].parent = parent;
    if (parent == kNone)
        mRoot = by;
    else
        (mNodes[parent].first == node ? mNodes[parent].first : mNodes[parent].second) = by;
}

/// Rounded outwards.
void RestingBlocks::include(uint32_t block, double3 const& low, double3 const& high) {
    const double3 center = mBounds.centerAt(block), half(mBounds.halfExtentAt(block));
    const bool isEmpty = half.x < 0;
    const double3 least = isEmpty ? low : glm::min(low, center - half);
    const double3 most = isEmpty ? high : glm::max(high, center + half);
    const double3 middle = (least + most) * 0.5;
    const double3 reach = glm::max(most - middle, middle - least) * (1 + 0x1p-22) +
                          (glm::abs(least) + glm::abs(most)) * 0x1p-50 + 0x1p-120;
    mBounds.set(block, middle, float3(reach));
}

void RestingBlocks::fitBounds(BoundsColumns const& boxes, uint32_t block) {
    mLoosened[block] = 0;
    double3 low(kLargest), high(-kLargest);
    for (const uint32_t member : members(block)) {
        if (isUnsettled(member)) continue;
        const double3 center = boxes.centerAt(member), half(boxes.halfExtentAt(member));
        low = glm::min(low, center - half);
        high = glm::max(high, center + half);
    }
    mBounds.set(block, double3(0), float3(-1));
    if (low.x <= high.x) include(block, low, high);
}

/// Memory for another block and its nodes, so that split() cannot fail half-way.
void RestingBlocks::reserveBlock() {
    if (!mFreeBlocks.empty() && mFreeNodes.size() >= 2) return;
    if (mLimit + 1 <= mCounts.size() && mNodes.size() + 3 <= mNodes.capacity()) return;
    const size_t blocks = std::max<size_t>(64, mLimit + mLimit / 4 + 1);
    mBounds.resize(blocks);
    mMembers.resize(blocks * kMembers);
    mCounts.resize(blocks);
    mLoosened.resize(blocks);
    mLeaves.resize(blocks);
    mFreeBlocks.reserve(blocks);
    mNodes.reserve(2 * blocks + 3);
    mFreeNodes.reserve(2 * blocks + 3);
}

uint32_t RestingBlocks::newBlock() {
    uint32_t block = mLimit;
    if (mFreeBlocks.empty()) {
        ++mLimit;
    } else {
        block = mFreeBlocks.back();
        mFreeBlocks.pop_back();
    }
    mCounts[block] = mLoosened[block] = 0;
    mBounds.set(block, double3(0), float3(-1));
    return block;
}

uint32_t RestingBlocks::newNode() {
    if (mFreeNodes.empty()) {
        mNodes.emplace_back();
        return static_cast<uint32_t>(mNodes.size() - 1);
    }
    const uint32_t node = mFreeNodes.back();
    mFreeNodes.pop_back();
    mNodes[node] = {};
    return node;
}

uint32_t RestingBlocks::depth() const {
    uint32_t deepest = 0;
    for (uint32_t block = 0; block < mLimit; ++block) {
        if (mCounts[block] == 0) continue;
        uint32_t depth = 0;
        for (uint32_t node = mLeaves[block]; mNodes[node].parent != kNone; node = mNodes[node].parent) ++depth;
        deepest = std::max(deepest, depth);
    }
    return deepest;
}

/// Another tree over the same blocks. Members need not lie on the side of a split that their keys say.
void RestingBlocks::rebalance() {
    mOrder.clear();
    mOrder.reserve(mLimit);
    for (uint32_t block = 0; block < mLimit; ++block) {
        if (mCounts[block] > 0) mOrder.push_back(block);
    }
    mNodes.clear();
    mFreeNodes.clear();
    mDeepest = 0;
    mRoot = mOrder.empty() ? kNone : build(mOrder, kNone);
}

uint32_t RestingBlocks::build(std::span<uint32_t> blocks, uint32_t parent) {
    const uint32_t node = newNode();
    if (blocks.size() == 1) {
        mNodes[node] = { .first = blocks[0], .parent = parent };
        mLeaves[blocks[0]] = node;
        return node;
    }
    double3 low(kLargest), high(-kLargest);
    for (const uint32_t block : blocks) {
        low = glm::min(low, mBounds.centerAt(block));
        high = glm::max(high, mBounds.centerAt(block));
    }
    const double3 extent = high - low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? X : extent.y >= extent.z ? Y : Z;
    const auto middle = blocks.begin() + static_cast<std::ptrdiff_t>(blocks.size() / 2);
    std::ranges::nth_element(blocks, middle, {}, [&](uint32_t block) { return mBounds.centerAt(block)[axis]; });
    const double split = mBounds.centerAt(*middle)[axis];
    const auto half = static_cast<size_t>(middle - blocks.begin());
    const uint32_t first = build(blocks.first(half), node), second = build(blocks.subspan(half), node);
    mNodes[node] = {
        .split = split, .first = first, .second = second, .parent = parent, .axis = static_cast<Axis>(axis)
    };
    return node;
}

} // namespace filament_core::scene
