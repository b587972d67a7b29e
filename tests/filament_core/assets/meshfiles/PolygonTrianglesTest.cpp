// SPDX-License-Identifier: Apache-2.0
#include "filament_core/assets/meshfiles/PolygonTriangles.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <random>

namespace filament_core::assets {
namespace {

double areaOf(double2 a, double2 b, double2 c) { return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2; }

double areaOf(std::vector<double2> const& polygon) {
    double sum = 0;
    for (size_t i = 2; i < polygon.size(); ++i) sum += areaOf(polygon[0], polygon[i - 1], polygon[i]);
    return sum;
}

/// In a tilted plane, far from the origin if `away` is large.
std::vector<float3> placed(std::vector<double2> const& polygon, double3 u, double3 v, double away = 0) {
    std::vector<float3> corners;
    for (double2 const& point : polygon) corners.emplace_back(u * point.x + v * point.y + double3(away));
    return corners;
}

/// The triangles cover as much as the polygon, and none of them faces the other way: none is outside.
void expectCovered(std::vector<double2> const& polygon, std::vector<float3> const& corners) {
    PolygonTriangles triangles;
    const double whole = areaOf(polygon);
    double sum = 0;
    size_t count = 0;
    for (std::array<uint32_t, 3> const& t : triangles.of(corners)) {
        const double area = areaOf(polygon.at(t[0]), polygon.at(t[1]), polygon.at(t[2])) * (whole < 0 ? -1 : 1);
        EXPECT_GE(area, -1e-6 * std::abs(whole));
        sum += area;
        ++count;
    }
    EXPECT_EQ(count, polygon.size() - 2);
    EXPECT_NEAR(sum, std::abs(whole), 1e-6 * std::abs(whole));
}

void expectCovered(std::vector<double2> polygon) {
    for (const bool isTurned : { false, true }) {
        if (isTurned) std::ranges::reverse(polygon);
        expectCovered(polygon, placed(polygon, { 1, 0, 0 }, { 0, 1, 0 }));
        expectCovered(polygon, placed(polygon, { 0, 0, 1 }, { 1, 0, 0 }));
        expectCovered(polygon, placed(polygon, { 0, 1, 0 }, { 0, 0, 1 }));
        expectCovered(polygon, placed(polygon, { 0.36, 0.48, -0.8 }, { -0.8, 0.6, 0 }));
    }
}

TEST(PolygonTriangles, ConvexOnesAreFans) {
    PolygonTriangles triangles;
    const std::vector<float3> square{ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 } };
    const auto made = triangles.of(square);
    ASSERT_EQ(made.size(), 2u);
    EXPECT_EQ(made[0], (std::array<uint32_t, 3>{ 0, 1, 2 }));
    EXPECT_EQ(made[1], (std::array<uint32_t, 3>{ 0, 2, 3 }));
}

TEST(PolygonTriangles, ConcaveOnesAreCoveredOnce) {
    expectCovered({ { 0, 0 }, { 4, 0 }, { 4, 4 }, { 3, 1 } });                                         // an arrow head
    expectCovered({ { 0, 0 }, { 3, 0 }, { 3, 1 }, { 1, 1 }, { 1, 3 }, { 0, 3 } });                     // an L
    expectCovered({ { 0, 3 }, { 0, 0 }, { 3, 0 }, { 3, 3 }, { 2, 3 }, { 2, 1 }, { 1, 1 }, { 1, 3 } }); // a U
    std::vector<double2> comb{ { 20, 5 }, { 20, -1 }, { 0, -1 } };
    for (int tooth = 0; tooth < 20; ++tooth) comb.insert(comb.end(), { { tooth, 5.0 }, { tooth + 0.5, 0.0 } });
    std::ranges::reverse(comb);
    expectCovered(comb);
    // a square with a square hole, joined by a bridge that is walked twice
    expectCovered(
            { { 0, 0 }, { 4, 0 }, { 4, 4 }, { 0, 4 }, { 0, 0 }, { 1, 1 }, { 1, 3 }, { 3, 3 }, { 3, 1 }, { 1, 1 } });
}

TEST(PolygonTriangles, RandomStarsAndSpiralsAreCoveredOnce) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> radius(0.05, 1.0);
    for (int round = 0; round < 300; ++round) {
        const size_t count = 4 + round % 40;
        std::vector<double2> star;
        for (size_t i = 0; i < count; ++i) {
            const double angle = 2 * std::numbers::pi * double(i) / double(count), r = radius(random);
            star.emplace_back(r * std::cos(angle), r * std::sin(angle));
        }
        expectCovered(star);
    }
    std::vector<double2> spiral;
    for (int i = 0; i <= 60; ++i) spiral.emplace_back(double2(std::cos(i * 0.3), std::sin(i * 0.3)) * (1 + i * 0.1));
    for (int i = 60; i >= 0; --i) spiral.emplace_back(double2(std::cos(i * 0.3), std::sin(i * 0.3)) * (0.9 + i * 0.1));
    expectCovered(spiral);
}

TEST(PolygonTriangles, PolygonsThatCrossOrHaveNoAreaEndWithAsManyTriangles) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> place(-1, 1);
    PolygonTriangles triangles;
    for (int round = 0; round < 200; ++round) {
        std::vector<float3> corners(3 + round % 60);
        for (float3& corner : corners) corner = { place(random), place(random), round % 3 ? place(random) : 0.0f };
        if (round % 5 == 0) std::ranges::fill(corners, float3(1.0f));
        EXPECT_EQ(triangles.of(corners).size(), corners.size() - 2);
    }
}

TEST(PolygonTriangles, AFaceOfManyCornersDoesNotTakeForever) {
    std::vector<float3> zigzag;
    for (int i = 0; i < 4'000; ++i) zigzag.emplace_back(float(i), i % 2 ? 1e-3f * float(i) : 0.0f, 0.0f);
    zigzag.emplace_back(4'000.0f, 1e6f, 0.0f);
    PolygonTriangles triangles;
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(triangles.of(zigzag).size(), zigzag.size() - 2);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

} // namespace
} // namespace filament_core::assets
