// SPDX-License-Identifier: Apache-2.0
#include "backend/vulkan/RangeAllocator.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace filament_core::backend::vulkan {
namespace {

constexpr uint64_t kBlock = uint64_t{ 1 } << 20;

TEST(RangeAllocator, GivesOutTheWholeBlockAtOnce) {
    RangeAllocator ranges(kBlock);
    const auto all = ranges.allocate(kBlock, 1);
    ASSERT_TRUE(all);
    EXPECT_EQ(all->offset, 0u);
    EXPECT_EQ(ranges.freeBytes(), 0u);
    EXPECT_FALSE(ranges.allocate(1, 1));
    ranges.free(all->node);
    EXPECT_TRUE(ranges.isEmpty());
}

TEST(RangeAllocator, RefusesMoreThanTheBlockHolds) {
    RangeAllocator ranges(kBlock);
    EXPECT_FALSE(ranges.allocate(kBlock + 1, 1));
    EXPECT_FALSE(ranges.allocate(~uint64_t{ 0 }, 1));
    EXPECT_FALSE(ranges.allocate(1, uint64_t{ 1 } << 62));
    EXPECT_TRUE(ranges.isEmpty());
}

TEST(RangeAllocator, KeepsTheAlignmentAndReusesThePaddingInFront) {
    RangeAllocator ranges(kBlock);
    const auto first = ranges.allocate(100, 1);
    const auto aligned = ranges.allocate(4096, 65536);
    ASSERT_TRUE(first && aligned);
    EXPECT_EQ(aligned->offset, 65536u);
    const auto between = ranges.allocate(60000, 256);
    ASSERT_TRUE(between);
    EXPECT_GE(between->offset, 256u);
    EXPECT_LE(between->offset + 60000, aligned->offset);
}

TEST(RangeAllocator, MergesWithBothNeighboursWhenTheMiddleIsFreedLast) {
    RangeAllocator ranges(kBlock);
    const auto a = ranges.allocate(1000, 1), b = ranges.allocate(1000, 1), c = ranges.allocate(1000, 1);
    ranges.free(a->node);
    ranges.free(c->node);
    EXPECT_EQ(ranges.freeRangeCount(), 2u); // a, and c joined to the rest of the block
    ranges.free(b->node);
    EXPECT_EQ(ranges.freeRangeCount(), 1u);
    EXPECT_TRUE(ranges.isEmpty());
}

TEST(RangeAllocator, NeverOverlapsLiveRangesInARandomHistory) {
    struct Live {
        uint64_t begin, end;
        uint32_t node;
    };
    RangeAllocator ranges(kBlock);
    std::mt19937 random(7);
    std::vector<Live> live;
    uint32_t refused = 0;
    for (int step = 0; step < 20'000; ++step) {
        if (!live.empty() && random() % 5 < 2) {
            const size_t victim = random() % live.size();
            ranges.free(live[victim].node);
            live[victim] = live.back();
            live.pop_back();
            continue;
        }
        const uint64_t bytes = 1 + random() % (1u << (random() % 15));
        const uint64_t alignment = uint64_t{ 1 } << (random() % 13);
        const auto range = ranges.allocate(bytes, alignment);
        if (!range) {
            ++refused;
            continue;
        }
        ASSERT_EQ(range->offset % alignment, 0u);
        ASSERT_LE(range->offset + bytes, kBlock);
        for (Live const& other : live) ASSERT_TRUE(range->offset >= other.end || range->offset + bytes <= other.begin);
        live.push_back({ range->offset, range->offset + bytes, range->node });
    }
    EXPECT_GT(refused, 0u) << "the history never filled the block, so it proves little";
    for (Live const& each : live) ranges.free(each.node);
    EXPECT_TRUE(ranges.isEmpty());
    EXPECT_EQ(ranges.freeRangeCount(), 1u);
}

TEST(RangeAllocator, RefusesOnlyWhenNoRangeIsAnEighthLargerThanTheRequest) {
    RangeAllocator ranges(kBlock);
    std::vector<RangeAllocator::Range> quarters;
    for (int i = 0; i < 4; ++i) quarters.push_back(*ranges.allocate(kBlock / 4, 1));
    ranges.free(quarters[1].node); // one hole of 256 KiB
    EXPECT_FALSE(ranges.allocate(kBlock / 4 + 1, 1));
    EXPECT_TRUE(ranges.allocate(kBlock / 4, 1)) << "sizes on a bin boundary fit exactly";
}

TEST(RangeAllocatorDeathTest, ARangeIsFreedOnce) {
    RangeAllocator ranges(kBlock);
    const auto range = ranges.allocate(1000, 1);
    ranges.free(range->node);
    EXPECT_DEATH(ranges.free(range->node), "a range is freed once");
}

} // namespace
} // namespace filament_core::backend::vulkan
