// SPDX-License-Identifier: Apache-2.0
#include "base/math/Frustum.h"

#include <filament_core/Camera.h>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace filament_core {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

struct Boxes {
    std::array<std::vector<float>, 3> center, halfExtent;

    void add(float3 at, float3 half) {
        for (int axis = 0; axis < 3; ++axis) {
            center[axis].push_back(at[axis]);
            halfExtent[axis].push_back(half[axis]);
        }
    }
    size_t size() const { return center[0].size(); }
    Box8 load(size_t i) const {
        Box8 boxes;
        for (int axis = 0; axis < 3; ++axis) {
            boxes.center[axis] = simd::load8(&center[axis][i]);
            boxes.halfExtent[axis] = simd::load8(&halfExtent[axis][i]);
        }
        return boxes;
    }
    bool intersectsOne(Frustum const& frustum, size_t i) const {
        return intersects(frustum, { center[0][i], center[1][i], center[2][i] },
                          { halfExtent[0][i], halfExtent[1][i], halfExtent[2][i] });
    }
};

/// Counts the boxes that are inside; both methods must agree on each.
uint32_t expectSameAsOneByOne(Frustum const& frustum, Boxes const& boxes) {
    const Frustum8 frustum8(frustum);
    uint32_t inside = 0;
    for (size_t i = 0; i + 8 <= boxes.size(); i += 8) {
        const uint32_t bits = frustum8.intersects(boxes.load(i));
        for (uint32_t lane = 0; lane < 8; ++lane) {
            const bool one = boxes.intersectsOne(frustum, i + lane);
            EXPECT_EQ((bits >> lane & 1) != 0, one) << "box " << i + lane;
            inside += one;
        }
        EXPECT_EQ(bits >> 8, 0u);
    }
    return inside;
}

Frustum frustum() { return frustumFromClip(Camera{ .lens = { 50, 0.1f } }.clipFromView(1.6f)); }

TEST(Frustum8, AgreesWithOneBoxAtATimeOnRandomBoxes) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> at(-30, 30), half(0, 4);
    Boxes boxes;
    for (int i = 0; i < 80'000; ++i) {
        boxes.add({ at(random), at(random), at(random) }, { half(random), half(random), half(random) });
    }
    const uint32_t inside = expectSameAsOneByOne(frustum(), boxes);
    EXPECT_GT(inside, boxes.size() / 20);
    EXPECT_LT(inside, boxes.size() / 2);
}

TEST(Frustum8, AgreesOnBoxesThatTouchAPlaneOrMissItByOneBit) {
    const Frustum planes = frustum();
    std::mt19937 random(2);
    std::uniform_real_distribution<float> at(-5, 5), half(0, 1);
    Boxes boxes;
    for (int i = 0; i < 20'000; ++i) {
        float4 const& plane = planes.planes[static_cast<size_t>(i) % planes.planes.size()];
        const float3 normal(plane), extent(half(random), half(random), half(random));
        float3 center(at(random), at(random), at(random));
        // onto the plane that the box touches from outside, up to rounding
        center -= normal * (glm::dot(normal, center) + plane.w + glm::dot(glm::abs(normal), extent));
        center.x = std::nextafter(center.x, i % 3 == 0 ? center.x : i % 3 == 1 ? kInfinity : -kInfinity);
        boxes.add(center, extent);
    }
    const uint32_t inside = expectSameAsOneByOne(planes, boxes);
    EXPECT_GT(inside, 1000u);
    EXPECT_LT(inside, 19'000u);
}

TEST(Frustum8, AgreesOnNaNInfinityAndHugeNumbersInEveryPlace) {
    constexpr std::array kOdd{ 0.0f, -0.0f, 1.0f, -1e30f, 3e38f, kInfinity, -kInfinity, kNaN };
    Boxes boxes;
    for (int place = 0; place < 6; ++place) {
        for (float first : kOdd) {
            for (float second : kOdd) {
                std::array<float, 6> values{ 0, 0, -5, 1, 1, 1 };
                values[static_cast<size_t>(place)] = first;
                values[static_cast<size_t>(place + 1) % 6] = second;
                boxes.add({ values[0], values[1], values[2] }, { values[3], values[4], values[5] });
            }
        }
    }
    ASSERT_EQ(boxes.size() % 8, 0u);
    EXPECT_GT(expectSameAsOneByOne(frustum(), boxes), 0u);
}

TEST(Frustum8, NeverDropsABoxThatIsNotANumber) {
    Boxes boxes;
    for (int i = 0; i < 8; ++i) boxes.add({ i % 2 ? kNaN : 100.0f, 0, 10 }, { i % 2 ? 1.0f : kNaN, 1, 1 });
    EXPECT_EQ(Frustum8(frustum()).intersects(boxes.load(0)), 0xFFu);
}

TEST(Simd, SubtractsInDoubleBeforeItRoundsOnce) {
    const std::array<double, 8> far{ 1e7 + 0.25, 1e7 - 0.5, 1e7, 1e7 + 1e-3, -1e7, 1e300, 1e7 + 3, 1e7 + 1e-9 };
    std::array<float, 8> lanes{};
    simd::store8(lanes, simd::loadRelative8(far.data(), 1e7));
    for (size_t i = 0; i < 8; ++i) EXPECT_EQ(lanes[i], static_cast<float>(far[i] - 1e7)) << i;
    EXPECT_EQ(lanes[0], 0.25f);
}

TEST(Simd, GathersAnyBitOfEightBytes) {
    std::mt19937_64 random(3);
    for (int round = 0; round < 1000; ++round) {
        const uint64_t bytes = random();
        for (uint32_t bit = 0; bit < 8; ++bit) {
            uint32_t expected = 0;
            for (uint32_t byte = 0; byte < 8; ++byte) expected |= (bytes >> (8 * byte + bit) & 1) << byte;
            ASSERT_EQ(simd::bitOfEachByte(bytes, bit), expected);
        }
    }
}

} // namespace
} // namespace filament_core
