// SPDX-License-Identifier: Apache-2.0
// Polygons under a cosine, against sums over their points; and under transformed cosines.
#include "shaders/lib/LibCppDouble.h"
#include "tests/shaders/lib/Numeric.h"

#include <gtest/gtest.h>

#include <random>

namespace filament_core::shader::lib {
namespace {

struct Area {
    double3 center, halfX, halfY;
    bool isDisc = false;
};

/// Sum over the area of weight(direction) cos / distance^2, for points above the horizon. Signed as areaIntegral().
template <class Weight>
auto bruteForce(Area const& area, Weight&& weight, int steps = 600) {
    const double3 normal = glm::cross(area.halfX, area.halfY);
    decltype(weight(normal)) sum{};
    for (int i = 0; i < steps; ++i) {
        for (int j = 0; j < steps; ++j) {
            double x = 2 * (i + 0.5) / steps - 1, y = 2 * (j + 0.5) / steps - 1, measure = 4.0 / (steps * steps);
            if (area.isDisc) {
                const double radius = std::sqrt((x + 1) / 2), angle = kPiExact * (y + 1);
                x = radius * std::cos(angle), y = radius * std::sin(angle), measure *= kPiExact / 4;
            }
            const double3 p = area.center + x * area.halfX + y * area.halfY;
            if (p.z <= 0) continue;
            const double square = glm::dot(p, p), distance = std::sqrt(square);
            sum += weight(p / distance) * (glm::dot(p / distance, normal) * measure / square);
        }
    }
    return sum;
}

vec3 integralOf(Area const& area) {
    return areaIntegral(vec3(area.center), vec3(area.halfX), vec3(area.halfY), area.isDisc);
}

class RandomAreas {
public:
    Area next(double nearest = 0.3) {
        Area area;
        do {
            area.center = double3(number(-2, 2), number(-2, 2), number(-1, 2));
            area.halfX = double3(number(-1, 1), number(-1, 1), number(-1, 1));
            area.halfY = double3(number(-1, 1), number(-1, 1), number(-1, 1));
        } while (distance(area) < nearest);
        area.isDisc = number(0, 1) > 0.5;
        return area;
    }
    double number(double low, double high) { return std::uniform_real_distribution(low, high)(mSource); }

private:
    static double distance(Area const& area) { // of the plane
        const double3 n = glm::cross(area.halfX, area.halfY);
        return std::abs(glm::dot(area.center, n)) / std::max(glm::length(n), 1e-9);
    }
    std::mt19937 mSource{ 7 };
};

TEST(Ltc, TheAngleOverItsSineIsThatOfTheLibrary) {
    for (int i = 0; i <= 10000; ++i) {
        const double x = i / 10000.0;
        const double expected = x == 1 ? 1 : std::acos(x) / std::sqrt(1 - x * x);
        EXPECT_NEAR(angleOverSine(static_cast<float>(x)), expected, 1e-6) << x;
    }
}

TEST(Ltc, AnEdgeAddsItsAngle) {
    for (const double degrees : { 0.001, 0.1, 1.0, 30.0, 89.0, 90.0, 91.0, 120.0, 170.0, 179.0, 179.9 }) {
        const double angle = glm::radians(degrees);
        const vec3 edge = edgeIntegral(vec3(3, 0, 0), vec3(2 * std::cos(angle), 2 * std::sin(angle), 0));
        EXPECT_NEAR(edge.z, angle, std::max(2e-6, degrees > 179 ? 2e-3 : 0.0)) << degrees;
        EXPECT_EQ(edge.x, 0);
        EXPECT_EQ(edge.y, 0);
    }
    EXPECT_EQ(edgeIntegral(vec3(0), vec3(0, 0, 1)), vec3(0));
    EXPECT_EQ(edgeIntegral(vec3(0, 2, 0), vec3(0, 1, 0)), vec3(0));
}

TEST(Ltc, AreasShineAsTheSumOfTheirPoints) {
    RandomAreas areas;
    double worstRect = 0, worstDisc = 0;
    for (int i = 0; i < 120; ++i) {
        const Area area = areas.next();
        const double3 expected = bruteForce(area, [](double3 d) { return d; });
        const double3 found(integralOf(area));
        double& worst = area.isDisc ? worstDisc : worstRect;
        worst = std::max(worst, std::abs(found.z - expected.z));
        EXPECT_NEAR(found.z, expected.z, area.isDisc ? 0.01 : 0.003) << i; // points at the horizon count or do not
        EXPECT_LT(glm::distance(found, expected), area.isDisc ? 0.03 : 0.01) << i;
    }
    std::printf("largest error of an irradiance: rectangle %.5f, disc %.5f of pi\n", worstRect / kPiExact,
                worstDisc / kPiExact);
}

// Above the horizon there is a closed form for a disc that faces the surface: pi sin^2 of the angle of its rim.
TEST(Ltc, AFacingDiscHasAClosedForm) {
    for (const double radius : { 0.001, 0.01, 0.1, 0.5, 1.0, 3.0, 30.0 }) {
        const Area disc{ { 0, 0, 2 }, { radius, 0, 0 }, { 0, radius, 0 }, true };
        const double expected = kPiExact * radius * radius / (radius * radius + 4);
        EXPECT_NEAR(integralOf(disc).z / expected, 1, 0.005) << radius;
    }
}

TEST(Ltc, AHugeRectangleOverAPlaneGivesPi) {
    for (const double half : { 1e4, 1e6, 1e12, 1e30 }) {
        EXPECT_NEAR(integralOf({ { 0.3, 0, 1 }, { half, 0, 0 }, { 0, half, 0 } }).z, kPiExact, 1e-3) << half;
        EXPECT_NEAR(integralOf({ { 0.3, 0, 1 }, { -half, 0, 0 }, { 0, half, 0 } }).z, -kPiExact, 1e-3) << half;
    }
}

TEST(Ltc, ABoxAroundAPointGivesPi) {
    double sum = 0;
    const std::array<double3, 3> axes{ double3(1, 0, 0), double3(0, 1, 0), double3(0, 0, 1) };
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : { -1.0, 1.0 }) {
            const double3 n = axes[axis] * side, x = axes[(axis + 1) % 3], y = glm::cross(n, x);
            sum += integralOf({ n * 2.0 + double3(0.5, -0.3, 0.7), x * 2.0, y * 2.0 }).z;
        }
    }
    EXPECT_NEAR(sum, kPiExact, 2e-5);
}

TEST(Ltc, WhatIsBelowTheHorizonGivesNothing) {
    EXPECT_EQ(integralOf({ { 0, 0, -1 }, { 0.5, 0, 0 }, { 0, 0.5, 0.5 } }), vec3(0));
    EXPECT_EQ(integralOf({ { 0, 0, -1 }, { 0.5, 0, 0 }, { 0, 0.5, 0.5 }, true }), vec3(0));
    EXPECT_EQ(integralOf({ { 0, 0, -1 }, { 1e-4, 0, 0 }, { 0, 1e-4, 0 } }), vec3(0));
}

TEST(Ltc, SmallAreasBecomePointsWithoutAStep) {
    double last = 0;
    for (double half = 1e-6; half < 0.1; half *= 1.2) {
        for (const bool isDisc : { false, true }) {
            const Area area{ { 0.4, 0, 1 }, { half, 0, 0 }, { 0, half, 0 }, isDisc };
            const double size = (isDisc ? kPiExact : 4) * half * half, square = 1.16;
            EXPECT_NEAR(integralOf(area).z / (size / (square * square)), 1, std::max(2e-4, 3 * half * half)) << half;
        }
        last = half;
    }
    EXPECT_GT(last, 0.05);
}

TEST(Ltc, TransformedAreasShineAsTheSumOfTheirPoints) {
    RandomAreas areas;
    for (int i = 0; i < 60; ++i) {
        const Area area = areas.next();
        const lib64::vec3 terms(areas.number(0.2, 1), areas.number(0, 0.5), areas.number(0.1, 1.2));
        const double expected = bruteForce(
                area, [&](double3 d) { return lib64::ltcLobe(terms, d); }, 400);
        const auto apply = [&](double3 v) { return ltcApply(vec3(terms), vec3(v)); };
        const vec3 found = areaIntegral(apply(area.center), apply(area.halfX), apply(area.halfY), area.isDisc);
        EXPECT_NEAR(found.z * kInversePi, expected, area.isDisc ? 0.01 : 0.004) << i;
    }
}

TEST(Ltc, ATransformedCosineHasNormOne) {
    for (const float d : { 0.2f, 0.7f, 1.3f }) {
        for (const float b : { 0.0f, 0.4f }) {
            EXPECT_NEAR(integrateHemisphere([&](vec3 l) { return ltcLobe(vec3(0.6f, b, d), l); }, 800, 200), 1, 1e-3);
        }
    }
}

TEST(Ltc, NoAreaGivesWhatIsNotANumberOrMoreThanPi) {
    constexpr std::array kSizes{ 0.0, 1e-30, 1e-10, 1e-4, 0.3, 1.0, 50.0, 1e9, 1e30 };
    constexpr std::array kHeights{ 0.0, 1e-30, 1e-7, -1e-7, 1e-3, 0.3, -0.3, 1.0, 1e5, 1e30 };
    for (const double width : kSizes) {
        for (const double height : kSizes) {
            for (const double z : kHeights) {
                for (const double tilt : { 0.0, 1e-7, 0.5, 1.0 }) { // 1: perpendicular to the surface
                    for (const bool isDisc : { false, true }) {
                        const double3 y = double3(0, 1 - tilt, tilt) * height;
                        const vec3 f = integralOf({ { 0.0, 0.2 * tilt, z }, { width, 0, 0 }, y, isDisc });
                        ASSERT_TRUE(isFinite(f)) << width << ' ' << height << ' ' << z << ' ' << tilt;
                        ASSERT_LE(std::abs(f.z), kPi * 1.001f) << width << ' ' << height << ' ' << z << ' ' << tilt;
                    }
                }
            }
        }
    }
}

TEST(Ltc, CoordinatesReachTheCornersOfTheTable) {
    EXPECT_EQ(ltcCoordinates(1, 0.045f), vec2(0, 0));
    EXPECT_EQ(ltcCoordinates(0, 1), vec2(31, 31));
    EXPECT_EQ(ltcCoordinates(1.1f, 0), vec2(0, 0)) << "clamped";
}

TEST(Ltc, AMirrorsLobeIsAroundTheMirroredView) {
    for (const float nov : { 0.1f, 0.5f, 0.9f, 1.0f }) {
        const vec3 terms = ltcTransformation(vec3(0, 0, 1), nov, 0.002f);
        const float sine = std::sqrt(1 - nov * nov);
        const vec3 center = ltcApply(terms, vec3(-sine, 0, nov));
        EXPECT_NEAR(center.x, 0, 1e-6);
        EXPECT_GT(center.z, 0);
        EXPECT_GT(ltcLobe(terms, vec3(-sine, 0, nov)), 1000);
    }
}

} // namespace
} // namespace filament_core::shader::lib
