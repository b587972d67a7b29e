// SPDX-License-Identifier: Apache-2.0
#include "filament_core/scene/RestingBlocks.h"

#include "filament_core/scene/Renderables.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace filament_core::scene {
namespace {

constexpr uint32_t kMembers = RestingBlocks::kMembers;

/// Boxes without renderables behind them.
struct RestingBlocksTest : testing::Test {
    RestingBlocks blocks;
    BoundsColumns boxes;
    std::vector<uint8_t> flags;
    uint32_t random = 1;

    uint32_t next() { return (random = random * 1664525u + 1013904223u) >> 8; }
    double within(double low, double high) { return low + (high - low) * next() / 16777216.0; }
    double3 somewhere(double far = 100) { return { within(-far, far), within(-far, far), within(-far, far) }; }

    void add(double3 const& center, float3 half = float3(0.5f), uint8_t flag = kCulled) {
        boxes.add();
        flags.push_back(flag);
        boxes.set(flags.size() - 1, center, half);
        blocks.add();
    }
    void move(uint32_t at, double3 const& center, float3 half = float3(0.5f)) {
        boxes.set(at, center, half);
        blocks.noteMoved(at);
    }
    void remove(uint32_t at) {
        boxes.remove(at);
        closeGap(flags, at);
        blocks.remove(at);
    }
    void settle(uint32_t calls) {
        for (uint32_t i = 0; i < calls; ++i) blocks.settle(boxes, flags);
    }

    bool isUnsettled(uint32_t at) const { return blocks.words()[at / 64].unsettled >> at % 64 & 1; }
    uint32_t unsettled() const {
        uint32_t count = 0;
        for (RestingBlocks::Word const& word : blocks.words()) count += std::popcount(word.unsettled);
        return count;
    }

    /// The contract of the class.
    void expectSound() {
        ASSERT_EQ(blocks.words().size(), (flags.size() + 63) / 64);
        std::set<uint32_t> members;
        for (uint32_t block = 0; block < blocks.limit(); ++block) {
            const Box box = blocks.bounds().at(block);
            for (const uint32_t at : blocks.members(block)) {
                ASSERT_LT(at, flags.size());
                ASSERT_TRUE(members.insert(at).second) << "in two blocks: " << at;
                if (isUnsettled(at)) continue;
                const Box own = boxes.at(at);
                for (int axis = 0; axis < 3; ++axis) {
                    ASSERT_LE(box.min[axis], own.min[axis]) << at;
                    ASSERT_GE(box.max[axis], own.max[axis]) << at;
                }
            }
        }
        ASSERT_EQ(members.size(), blocks.settled());
        for (uint32_t at = 0; at < flags.size(); ++at)
            ASSERT_TRUE(isUnsettled(at) || members.contains(at)) << "lost: " << at;
    }
};

TEST_F(RestingBlocksTest, HoldsAllThatRestsAfterRandomAddsMovesAndRemoves) {
    for (uint32_t i = 0; i < 9000; ++i) add(somewhere(), float3(static_cast<float>(within(0, 2))));
    for (int round = 0; round < 300; ++round) {
        for (int i = 0; i < 40; ++i) move(next() % static_cast<uint32_t>(flags.size()), somewhere(round % 3 ? 100 : 5));
        for (int i = 0; i < 20; ++i) remove(next() % static_cast<uint32_t>(flags.size()));
        for (int i = 0; i < 20; ++i) add(somewhere(), float3(0.1f));
        settle(round % 4 ? 1 : 70);
        if (round % 10 == 0) expectSound();
    }
    EXPECT_GT(blocks.settled(), 6000u);
    while (flags.size() > 1) remove(next() % static_cast<uint32_t>(flags.size()));
    expectSound();
}

TEST_F(RestingBlocksTest, TakesWhatWasAddedAtOnceAndWhatMovedOnceItRested) {
    for (uint32_t i = 0; i < RestingBlocks::kFewest; ++i) add(somewhere());
    settle(1);
    EXPECT_EQ(unsettled(), 0u);
    move(77, somewhere());
    settle(RestingBlocks::kRestFrames - 2);
    EXPECT_TRUE(isUnsettled(77));
    settle(2 * RestingBlocks::kRestFrames + 2);
    EXPECT_FALSE(isUnsettled(77));
    expectSound();
    for (uint32_t frame = 0; frame < 4 * RestingBlocks::kRestFrames; ++frame) {
        move(77, somewhere());
        settle(1);
        ASSERT_TRUE(isUnsettled(77)) << "it moves in every frame";
    }
    EXPECT_EQ(unsettled(), 1u);
}

TEST_F(RestingBlocksTest, LeavesSmallScenesAlone) {
    for (uint32_t i = 0; i + 1 < RestingBlocks::kFewest; ++i) add(somewhere());
    settle(200);
    EXPECT_EQ(blocks.settled(), 0u);
    EXPECT_EQ(blocks.limit(), 0u);
}

TEST_F(RestingBlocksTest, LeavesWhatHasNoUsableBoxOut) {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInfinity = std::numeric_limits<float>::infinity();
    for (uint32_t i = 0; i < 2 * RestingBlocks::kFewest; ++i) {
        switch (i % 8) {
        case 0:
            add(somewhere(), float3(1, kNaN, 1));
            break;
        case 1:
            add({ 0, static_cast<double>(kNaN), 0 });
            break;
        case 2:
            add(somewhere(), float3(kInfinity));
            break;
        case 3:
            add(somewhere(), float3(1), 0);
            break; // never culled
        default:
            add(somewhere());
        }
    }
    settle(200);
    for (uint32_t i = 0; i < flags.size(); ++i) ASSERT_EQ(isUnsettled(i), i % 8 < 4) << i;
    expectSound();
    for (uint32_t i = 0; i < flags.size(); i += 8) move(i, somewhere());
    settle(200);
    for (uint32_t i = 0; i < flags.size(); ++i) ASSERT_EQ(isUnsettled(i), i % 8 < 4 && i % 8 != 0) << i;
    expectSound();
}

TEST_F(RestingBlocksTest, AreSmallBesideTheScene) {
    for (uint32_t i = 0; i < 40'000; ++i) {
        // A grid in order, and one of a hundred reaches far.
        const double x = i % 200, z = i / 200;
        add({ x, 0, z }, float3(next() % 100 == 0 ? 60.0f : 0.4f));
    }
    settle(20);
    EXPECT_EQ(unsettled(), 0u);
    expectSound();
    uint32_t used = 0, small = 0;
    for (uint32_t block = 0; block < blocks.limit(); ++block) {
        used += !blocks.members(block).empty();
        const float3 half = blocks.bounds().halfExtentAt(block);
        if (half.x < 16 && half.z < 16) small += static_cast<uint32_t>(blocks.members(block).size());
    }
    EXPECT_LT(used * kMembers, 40'000u * 5 / 2) << "two fifths full, at least";
    EXPECT_GT(small, 36'000u) << "the large ones have blocks of their own";
}

TEST_F(RestingBlocksTest, StaysFlatWhateverTheOrder) {
    for (uint32_t i = 0; i < 30'000; ++i) {
        add({ i * 1.0, 0, 0 });
        if (i % 64 == 0 && i > RestingBlocks::kFewest) settle(65); // each of them at the right end of all
    }
    settle(200);
    expectSound();
    EXPECT_EQ(unsettled(), 0u);
    EXPECT_LT(blocks.depth(), 40u);
}

TEST_F(RestingBlocksTest, ManyAtOnePointShareBlocksOfItsSize) {
    for (uint32_t i = 0; i < 20'000; ++i) add({ 1, 2, 3 });
    settle(10);
    expectSound();
    EXPECT_EQ(unsettled(), 0u);
    EXPECT_LT(blocks.depth(), 30u);
    for (uint32_t block = 0; block < blocks.limit(); ++block) EXPECT_LE(blocks.bounds().halfExtentAt(block).x, 0.51f);
}

TEST_F(RestingBlocksTest, GivesBlocksBackWhenEverythingLeaves) {
    for (uint32_t i = 0; i < 20'000; ++i) add(somewhere());
    settle(10);
    const uint32_t limit = blocks.limit();
    for (int round = 0; round < 5; ++round) {
        for (uint32_t i = 0; i < flags.size(); ++i) move(i, somewhere() + double3(1000 * (round + 1), 0, 0));
        settle(3 * RestingBlocks::kRestFrames);
        ASSERT_EQ(unsettled(), 0u);
    }
    expectSound();
    EXPECT_LT(blocks.limit(), limit * 2);
    for (uint32_t block = 0; block < blocks.limit(); ++block)
        EXPECT_TRUE(blocks.members(block).empty() || blocks.bounds().halfExtentAt(block).x < 150)
                << "its box still reaches where members were";
}

TEST_F(RestingBlocksTest, JoinsBlocksThatAreNearlyEmpty) {
    for (uint32_t i = 0; i < 40'000; ++i) add(somewhere());
    settle(10);
    while (flags.size() > 5000) remove(next() % static_cast<uint32_t>(flags.size()));
    expectSound();
    uint32_t used = 0;
    for (uint32_t block = 0; block < blocks.limit(); ++block) used += !blocks.members(block).empty();
    EXPECT_LT(used * 10, 5000u);
}

} // namespace
} // namespace filament_core::scene
