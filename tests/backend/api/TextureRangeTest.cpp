// SPDX-License-Identifier: Apache-2.0
// Ranges compared with the sets of levels and layers that they stand for, for every range of a small texture.
#include "backend/api/TextureRange.h"

#include <gtest/gtest.h>

#include <bitset>
#include <vector>

namespace filament_core::backend {
namespace {

constexpr uint8_t kLevels = 3;
constexpr uint16_t kLayers = 4;
using Parts = std::bitset<kLevels * kLayers>;

std::vector<TextureRange> everyRange() {
    std::vector<TextureRange> ranges;
    for (uint8_t level = 0; level < kLevels; ++level) {
        for (uint8_t levels = 1; level + levels <= kLevels; ++levels) {
            for (uint16_t layer = 0; layer < kLayers; ++layer) {
                for (uint16_t layers = 1; layer + layers <= kLayers; ++layers) {
                    ranges.push_back({ level, levels, layer, layers });
                }
            }
        }
    }
    return ranges;
}

Parts partsOf(TextureRange const& range) {
    Parts parts;
    for (int level = range.level; level < range.level + range.levelCount; ++level) {
        for (int layer = range.layer; layer < range.layer + range.layerCount; ++layer) {
            parts.set(static_cast<size_t>(level * kLayers + layer));
        }
    }
    return parts;
}

TEST(TextureRange, OverlapAndContainsAgreeWithSets) {
    const std::vector<TextureRange> ranges = everyRange();
    ASSERT_EQ(ranges.size(), 6u * 10u);
    for (TextureRange const& a : ranges) {
        for (TextureRange const& b : ranges) {
            const Parts inA = partsOf(a), inB = partsOf(b);
            EXPECT_EQ(overlap(a, b), (inA & inB).any());
            EXPECT_EQ(contains(a, b), (inB & ~inA).none());
        }
    }
}

TEST(TextureRange, OnlyRangesThatEndInsideExist) {
    for (uint8_t level = 0; level < kLevels + 2; ++level) {
        for (uint8_t levels = 0; levels < kLevels + 2; ++levels) {
            EXPECT_EQ(exists({ level, levels, 0, 1 }, kLevels, kLayers), levels > 0 && level + levels <= kLevels);
        }
    }
    for (uint16_t layer = 0; layer < kLayers + 2; ++layer) {
        for (uint16_t layers = 0; layers < kLayers + 2; ++layers) {
            EXPECT_EQ(exists({ 0, 1, layer, layers }, kLevels, kLayers), layers > 0 && layer + layers <= kLayers);
        }
    }
}

TEST(TextureRange, CountsOfZeroReachToTheEndAndNeverBeyond) {
    EXPECT_EQ(withCounts({}, kLevels, kLayers), (TextureRange{ 0, kLevels, 0, kLayers }));
    EXPECT_EQ(withCounts(oneLevel(2), kLevels, kLayers), (TextureRange{ 2, 1, 0, kLayers }));
    EXPECT_EQ(withCounts(oneLayer(3), kLevels, kLayers), (TextureRange{ 0, kLevels, 3, 1 }));
    EXPECT_EQ(withCounts({ .level = 1, .layer = 2 }, kLevels, kLayers), (TextureRange{ 1, 2, 2, 2 }));
    for (TextureRange const& range : everyRange()) EXPECT_EQ(withCounts(range, kLevels, kLayers), range);
    EXPECT_FALSE(exists(withCounts({ .level = kLevels }, kLevels, kLayers), kLevels, kLayers));
    EXPECT_FALSE(exists(withCounts({ .layer = kLayers }, kLevels, kLayers), kLevels, kLayers));
}

} // namespace
} // namespace filament_core::backend
