// SPDX-License-Identifier: Apache-2.0
#include "filament_core/prepare/SortKey.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace filament_core::prepare {
namespace {

constexpr float kFarthest = std::numeric_limits<float>::infinity();

TEST(SortKey, DepthStepsGrowWithDepthSixteenAnOctave) {
    uint32_t last = 0;
    for (float depth = 1e-6f; depth < 1e20f; depth *= 1.01f) {
        const uint32_t step = depthStep(depthBits(depth));
        EXPECT_GE(step, last);
        EXPECT_LT(step, 1024u);
        last = step;
    }
    EXPECT_EQ(last, 1023u);
    EXPECT_EQ(depthStep(depthBits(2.0f)) - depthStep(depthBits(1.0f)), 16u);
    EXPECT_EQ(coarseStep(depthBits(2.0f)) - coarseStep(depthBits(1.0f)), 4u);
}

TEST(SortKey, WhatIsNotInFrontCountsAsNearestAndInfinityAsFarthest) {
    for (float depth : { 0.0f, -0.0f, -3.0f, -kFarthest, std::numeric_limits<float>::quiet_NaN(),
                         -std::numeric_limits<float>::quiet_NaN() }) {
        EXPECT_EQ(depthBits(depth), 0u);
    }
    EXPECT_EQ(depthStep(0), 0u);
    EXPECT_EQ(depthStep(depthBits(kFarthest)), 1023u);
    EXPECT_EQ(blendedKey(0) & kBlendedKey, kBlendedKey);
    EXPECT_LT(blendedKey(depthBits(kFarthest)), blendedKey(0));
}

TEST(SortKey, BlendedKeysFallWithDepthToTheLastBit) {
    EXPECT_GT(blendedKey(depthBits(1.0f)), blendedKey(depthBits(std::nextafter(1.0f, 2.0f))));
    EXPECT_EQ(blendedKey(depthBits(1.0f)) & 0x3FFu, 0u) << "equal depths keep the order of the scene";
}

/// Places, ascending.
std::vector<uint32_t> someOfAllPlaces() {
    std::vector<uint32_t> places;
    for (uint8_t priority = 0; priority <= DrawOrder::kLastPriority; ++priority)
        for (const uint32_t order : { 0u, 1u, 255u, 256u, 65535u })
            places.push_back(scene::placeOrder({ priority, static_cast<uint16_t>(order) }));
    return places;
}

TEST(SortKey, PlaceBeforeDepthForBlendedAndLateOnes) {
    const uint32_t far = depthBits(kFarthest), near = depthBits(1e-3f);
    const std::vector<uint32_t> places = someOfAllPlaces();
    for (size_t i = 1; i < places.size(); ++i) {
        EXPECT_LT(blendedKey(0, places[i - 1], Composed::InOrder), blendedKey(far, places[i])) << i;
        EXPECT_LT(lateKey(0, false, places[i - 1]), lateKey(far, false, places[i])) << i;
        EXPECT_LT(lateKey(0, true, places[i - 1]), lateKey(far, true, places[i])) << i;
    }
    EXPECT_LT(lateKey(0, false, places.back()), kPictureEndKey);
    EXPECT_GE(lateKey(far, true, places.front()), kRefractingEndKey);
    EXPECT_LT(lateKey(0, true, places.back()), blendedKey(far, places.front()));
    EXPECT_EQ(blendedKey(near), blendedKey(near, scene::placeOrder({})));
}

TEST(SortKey, WhatIsComposedIsBetweenWhatIsBehindItAndTheRestOfItsPlaceAlone) {
    const uint32_t far = depthBits(kFarthest), place = kDefaultPlace;
    const uint64_t keys[] = { blendedKey(0, place - 1, Composed::InOrder), blendedKey(far, place, Composed::Behind),
                              blendedKey(0, place, Composed::Behind),      kAnyOrderKey,
                              blendedKey(0, place, Composed::InAnyOrder),  kAnyOrderEndKey,
                              blendedKey(0, place, Composed::InOrder),     blendedKey(far, place + 1) };
    for (size_t i = 1; i < std::size(keys); ++i) EXPECT_LT(keys[i - 1], keys[i]) << i;
    EXPECT_EQ(blendedKey(0x7FFF'FFFFu, place, Composed::InAnyOrder), kAnyOrderKey);
    EXPECT_EQ(blendedKey(0x7FFF'FFFFu, place, Composed::InOrder), kAnyOrderEndKey);
}

TEST(SortKey, OpaqueBeforeBlendedWhateverElse) {
    EXPECT_LT(opaqueKey(~scene::Drawables::kBlendedOrder, drawOf(0xFFFFF, true), 255, ~0u), kLateKey);
}

TEST(SortKey, LateOnesBetweenOpaqueAndBlendedThoseThatRefractThenThoseWithoutTest) {
    const uint32_t far = depthBits(kFarthest), near = depthBits(1e-3f);
    const uint64_t keys[] = { kLateKey,           lateKey(far, false), lateKey(near, false),
                              refractingKey(0),   refractingKey(near), refractingKey(far),
                              lateKey(far, true), lateKey(near, true), blendedKey(far),
                              blendedKey(near) };
    for (size_t i = 1; i < std::size(keys); ++i) EXPECT_LT(keys[i - 1], keys[i]) << i;
    EXPECT_LT(lateKey(0, true), kBlendedKey);
    EXPECT_LT(lateKey(0, false), kPictureEndKey);
    EXPECT_EQ(refractingKey(0), kPictureEndKey);
    EXPECT_LT(refractingKey(0x7FFF'FFFFu), lateKey(0x7FFF'FFFFu, true));
    EXPECT_LT(layeredKey(far), layeredKey(near));
    EXPECT_LT(layeredKey(0), kRefractingEndKey);
    EXPECT_GE(layeredKey(0x7FFF'FFFFu), kPictureEndKey);
    EXPECT_GE(lateKey(0x7FFF'FFFFu, true), kRefractingEndKey);
    EXPECT_TRUE(isLayered(layeredKey(far)) && isLayered(layeredKey(0)));
    for (const uint64_t key : { refractingKey(far), lateKey(near, true), lateKey(near, false), blendedKey(near),
                                opaqueKey(7, drawOf(3, true), 9, near | 1u << 19) })
        EXPECT_FALSE(isLayered(key)) << key;
    EXPECT_GT(lateKey(depthBits(1.0f), false), lateKey(depthBits(std::nextafter(1.0f, 2.0f)), false));
}

TEST(SortKey, SliceThenMaterialThenSideThenInstanceThenDrawableThenDepth) {
    const auto order = [](uint32_t material, uint32_t instance) { return material << 12 | instance; };
    const uint32_t far = depthBits(1e10f), near = depthBits(1e-3f);
    const uint64_t keys[] = {
        opaqueKey(order(0, 0), drawOf(0, false), 0, near), opaqueKey(order(0, 0), drawOf(0, false), 0, far),
        opaqueKey(order(0, 0), drawOf(1, false), 0, near), opaqueKey(order(0, 1), drawOf(0, false), 0, near),
        opaqueKey(order(0, 0), drawOf(0, true), 0, near),  opaqueKey(order(1, 0), drawOf(0, false), 0, near),
        opaqueKey(order(0, 0), drawOf(0, false), 1, near),
    };
    for (size_t i = 1; i < std::size(keys); ++i) EXPECT_LT(keys[i - 1], keys[i]) << i;
}

TEST(SortKey, AFewMembersAreOneSliceHoweverFarApart) {
    for (uint32_t step : { 3u, 100u, 255u }) EXPECT_EQ(sliceStart({ 3, 255 }, 15, step), 3u);
    EXPECT_NE(sliceStart({ 3, 255 }, 16, 255), 3u);
    EXPECT_EQ(sliceStart({ 255, 255 }, 1, 255), 255u);
}

TEST(SortKey, ManyMembersGetASliceForEveryStep) {
    std::set<uint32_t> slices;
    for (uint32_t step = 10; step <= 40; ++step) slices.insert(sliceStart({ 10, 40 }, 100'000, step));
    EXPECT_EQ(slices.size(), 31u);
}

TEST(SortKey, SlicesHoldTheirStepRiseWithItAndAreFullOnTheAverage) {
    for (uint32_t members = 1; members < 5000; members = members * 3 / 2 + 1) {
        for (uint32_t span = 0; span < 256; ++span) {
            const uint32_t nearest = 255 - span;
            std::set<uint32_t> slices;
            uint32_t last = nearest;
            for (uint32_t step = nearest; step <= 255; ++step) {
                const uint32_t slice = sliceStart({ nearest, 255 }, members, step);
                ASSERT_GE(slice, last);
                ASSERT_LE(slice, step);
                slices.insert(last = slice);
            }
            if (slices.size() > 1) {
                ASSERT_GE(members / slices.size(), kSliceMembers) << members << " over " << span;
            }
        }
    }
}

} // namespace
} // namespace filament_core::prepare
