// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/PlaceShadowMaps.h"

#include "tests/filament_core/prepare/BoxScene.h"

#include <gtest/gtest.h>

namespace filament_core::prepare {
namespace {

bool overlap(ShadowTile a, ShadowTile b) {
    return a.x < b.x + b.size && b.x < a.x + a.size && a.y < b.y + b.size && b.y < a.y + a.size;
}

void expectProper(PlacedShadowMaps const& placed, std::span<const ShadowMapRequest> requests, uint32_t largest) {
    ASSERT_EQ(placed.tiles.size(), requests.size());
    ASSERT_LE(placed.atlasSize, largest);
    for (size_t i = 0; i < placed.tiles.size(); ++i) {
        const ShadowTile tile = placed.tiles[i];
        if (tile.size == 0) continue;
        EXPECT_TRUE(std::has_single_bit(uint32_t{ tile.size }) && tile.size >= kSmallestShadowMap);
        EXPECT_LE(tile.size, requests[i].size);
        EXPECT_EQ(tile.x % tile.size, 0);
        EXPECT_EQ(tile.y % tile.size, 0);
        EXPECT_LE(uint32_t{ tile.x } + tile.size, placed.atlasSize);
        EXPECT_LE(uint32_t{ tile.y } + tile.size, placed.atlasSize);
        for (size_t j = 0; j < i; ++j) EXPECT_FALSE(placed.tiles[j].size && overlap(tile, placed.tiles[j])) << i << j;
    }
}

ShadowAtlas heldAfter(PlacedShadowMaps const& placed, std::span<const ShadowMapRequest> requests) {
    ShadowAtlas held{ .size = placed.atlasSize, .maps = {} };
    for (size_t i = 0; i < requests.size(); ++i) {
        if (placed.tiles[i].size) held.maps.push_back({ requests[i].owner, 1, placed.tiles[i] });
    }
    return held;
}

TEST(PlaceShadowMaps, RandomMapsNeverOverlapAndAllFitOfWhichTheTexelsFit) {
    Arena arena;
    Random random(11);
    for (int round = 0; round < 2000; ++round) {
        arena.reset();
        const uint32_t largest = kSmallestShadowMap << (random.next() % 6);
        std::vector<ShadowMapRequest> requests(1 + random.next() % 40);
        uint64_t texels = 0;
        bool tooLarge = false;
        for (size_t i = 0; i < requests.size(); ++i) {
            requests[i] = { i, kSmallestShadowMap << (random.next() % 5) };
            texels += uint64_t{ requests[i].size } * requests[i].size;
            tooLarge |= requests[i].size > largest;
        }
        const PlacedShadowMaps placed = placeShadowMaps(arena, requests, {}, largest);
        expectProper(placed, requests, largest);
        if (tooLarge || texels > uint64_t{ largest } * largest) continue;
        for (size_t i = 0; i < requests.size(); ++i) EXPECT_EQ(placed.tiles[i].size, requests[i].size);
    }
}

TEST(PlaceShadowMaps, MapsThatStayKeepTheirTilesWhileOthersComeAndGo) {
    Arena arena;
    Random random(5);
    std::vector<ShadowMapRequest> requests{ { 1, 512 }, { 2, 256 }, { 3, 256 }, { 4, 128 } };
    ShadowAtlas held = heldAfter(placeShadowMaps(arena, requests, {}, 1024), requests);
    uint32_t kept = 0, rounds = 0;
    for (uint64_t owner = 5; owner < 400; ++owner) {
        arena.reset();
        requests[random.next() % requests.size()] = { owner, 64u << (random.next() % 3) };
        const PlacedShadowMaps placed = placeShadowMaps(arena, requests, held, 1024);
        expectProper(placed, requests, 1024);
        for (size_t i = 0; i < requests.size(); ++i) {
            const auto before = std::ranges::find(held.maps, requests[i].owner, &HeldShadowMap::owner);
            if (before == held.maps.end()) continue;
            ++rounds;
            kept += before->tile == placed.tiles[i];
        }
        held = heldAfter(placed, requests);
    }
    EXPECT_EQ(kept, rounds) << "there is room around them";
}

TEST(PlaceShadowMaps, ShrinksTheLargestFirstAndOfThoseTheLeastImportant) {
    Arena arena;
    const ShadowMapRequest requests[] = { { 1, 1024 }, { 2, 1024 }, { 3, 512 }, { 4, 64 } };
    const PlacedShadowMaps placed = placeShadowMaps(arena, requests, {}, 1024);
    EXPECT_EQ(placed.tiles[0].size, 512);
    EXPECT_EQ(placed.tiles[1].size, 512);
    EXPECT_EQ(placed.tiles[2].size, 512);
    EXPECT_EQ(placed.tiles[3].size, 64);
}

TEST(PlaceShadowMaps, WithoutRoomTheLeastImportantGoFirst) {
    Arena arena;
    std::vector<ShadowMapRequest> requests(6);
    for (size_t i = 0; i < requests.size(); ++i) requests[i] = { i, 64 };
    const PlacedShadowMaps placed = placeShadowMaps(arena, requests, {}, 64);
    for (size_t i = 0; i < requests.size(); ++i) EXPECT_EQ(placed.tiles[i].size, i < 4 ? 32 : 0) << i;
}

TEST(PlaceShadowMaps, BudgetsOfAnyNumberOfBytesGiveAnAtlas) {
    const auto depths = [](uint64_t bytes) { return atlasSizeForBytes(bytes, ShadowMoments::None); };
    EXPECT_EQ(depths(0), kSmallestShadowMap);
    EXPECT_EQ(depths(uint64_t{ 1 } << 20), 512u);
    EXPECT_EQ(depths((uint64_t{ 64 } << 20) - 1), 2048u);
    EXPECT_EQ(depths(uint64_t{ 64 } << 20), 4096u);
    EXPECT_EQ(depths(~uint64_t{ 0 }), kLargestShadowMap);
    EXPECT_EQ(atlasBytes(32, ShadowMoments::Two), 4u * 1024 + 8 * (1024 + 256 + 64 + 16 + 4));
    for (const ShadowMoments moments : { ShadowMoments::Two, ShadowMoments::Four }) {
        for (uint32_t size = 64; size < kLargestShadowMap; size *= 2) {
            EXPECT_EQ(atlasSizeForBytes(atlasBytes(size, moments), moments), size);
            EXPECT_EQ(atlasSizeForBytes(atlasBytes(size, moments) - 1, moments), size / 2);
        }
    }
}

} // namespace
} // namespace filament_core::prepare
