// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/SortItems.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace filament_core::prepare {
namespace {

/// Keys are random in the bits of `mask`, constant elsewhere.
std::vector<SortItem> randomItems(size_t count, uint64_t mask) {
    std::mt19937_64 random(count);
    std::vector<SortItem> items(count);
    for (uint32_t i = 0; i < count; ++i) items[i] = { (random() & mask) | (0x5A5A5A5A5A5A5A5Aull & ~mask), i, i * 7 };
    return items;
}

void expectSortedAsByStableSort(std::vector<SortItem> items, int workers) {
    std::vector<SortItem> expected = items;
    std::ranges::stable_sort(expected, {}, &SortItem::key);
    jobs::JobSystem jobs({ .workers = workers });
    Arena arena;
    const std::span<const SortItem> sorted = sortItems(jobs, arena, items);
    ASSERT_EQ(sorted.size(), expected.size());
    for (size_t i = 0; i < expected.size(); ++i) {
        ASSERT_EQ(sorted[i].key, expected[i].key) << "of " << items.size() << " items, at " << i;
        ASSERT_EQ(sorted[i].renderable, expected[i].renderable) << "of " << items.size() << " items, at " << i;
        ASSERT_EQ(sorted[i].draw, expected[i].renderable * 7);
    }
}

constexpr uint64_t kAllBits = ~0ull;

TEST(SortItems, IsAStableSortForEverySizeAroundItsThresholds) {
    for (size_t count : { 0, 1, 2, 3, 17, 95, 96, 97, 255, 256, 257, 2047, 2048, 16'383, 16'384, 16'385, 50'000 }) {
        expectSortedAsByStableSort(randomItems(count, kAllBits), 0);
        expectSortedAsByStableSort(randomItems(count, 0x3FF), 0); // many equal keys, one digit
    }
}

TEST(SortItems, IsTheSameForAnyNumberOfWorkers) {
    for (int workers : { 0, 1, 2, 3, 16 }) {
        expectSortedAsByStableSort(randomItems(150'000, 0x1F80'0FFF'F000'03FFull), workers);
    }
}

TEST(SortItems, FindsTheDigitsWhereverTheKeysDiffer) {
    for (uint32_t bit = 0; bit < 64; ++bit) expectSortedAsByStableSort(randomItems(3000, 1ull << bit), 0);
    expectSortedAsByStableSort(randomItems(3000, 1ull << 63 | 1), 0);
    expectSortedAsByStableSort(randomItems(3000, 0x8001'0002'0004'0008ull), 0);
    expectSortedAsByStableSort(randomItems(3000, 0), 0);
}

TEST(SortItems, AcceptsWhatIsSortedAlreadyOrBackwards) {
    std::vector<SortItem> items(20'000);
    for (uint32_t i = 0; i < items.size(); ++i) items[i] = { i, i, i * 7 };
    expectSortedAsByStableSort(items, 1);
    for (SortItem& item : items) item.key = ~item.key;
    expectSortedAsByStableSort(items, 1);
}

} // namespace
} // namespace filament_core::prepare
