// SPDX-License-Identifier: Apache-2.0
// screen_occlusion.glsl: planes from inverse distances, arcs compared with counted directions, and the open part of
// closed forms by many slices.
#include "tests/shaders/lib/Furnace.h"

#include <gtest/gtest.h>

namespace filament_core::shader::lib64 {
namespace {

constexpr int kSteps = 20'000;

/// The integral of sin t cos(t - n) f(t) from 0 to h, by the midpoint rule; counts what lies below the surface, too.
template <class F>
double arc(double h, double n, F const& of) {
    double sum = 0;
    for (int i = 0; i < kSteps; ++i) {
        const double t = h * (i + 0.5) / kSteps;
        sum += std::sin(t) * std::cos(t - n) * of(t) * h / kSteps;
    }
    return sum;
}

TEST(ScreenOcclusionPlane, ANormalIsThatOfThePlaneUpToTheCamera) {
    for (const vec3 n : { vec3(0, 0, 1), vec3(0.6, 0, 0.8), vec3(-0.48, 0.6, 0.64), vec3(0.8, 0.6, 0.05) }) {
        const vec3 unit = n / std::sqrt(dot(n, n));
        const auto inverse = [&](vec2 ray) { return (unit.z - unit.x * ray.x - unit.y * ray.y) / 3; }; // n . p = -3
        for (const vec2 ray : { vec2(0, 0), vec2(0.2, -0.3) }) {
            const double here = inverse(ray);
            if (here <= 0) continue; // behind the camera
            const vec2 slope((inverse(ray + vec2(0.01, 0)) - here) / 0.01,
                             (inverse(ray + vec2(0, 0.01)) - here) / 0.01);
            const vec3 found = normalOfPlane(slope, ray, here);
            EXPECT_NEAR(dot(found, unit), 1, 1e-9);
            EXPECT_NEAR(missOfLine(here, here + slope.x, here + 2 * slope.x), 0, 1e-12);
        }
    }
    const vec3 nothing = normalOfPlane(vec2(0, 0), vec2(0, 0), 0.0);
    EXPECT_EQ(nothing.z, 1) << "no surface at all";
}

TEST(ScreenOcclusionPlane, ANeighbourCountsAsFarAsItLiesOnThePlane) {
    EXPECT_EQ(weightOfNeighbor(0.5, 0.5, 0.1), 1);
    EXPECT_NEAR(weightOfNeighbor(0.55, 0.5, 0.1), 0.5, 1e-12);
    EXPECT_EQ(weightOfNeighbor(0.7, 0.5, 0.1), 0);
}

TEST(ScreenOcclusionArc, TheArcCosineIsAsExactAsItsSourceSays) {
    for (int i = -1000; i <= 1000; ++i) EXPECT_NEAR(arcCosine(i / 1000.0), std::acos(i / 1000.0), 7e-5);
}

TEST(ScreenOcclusionArc, HalfSlicesAreTheIntegralsOfTheirDirections) {
    for (const double n : { -1.2, -0.4, 0.0, 0.7, 1.5 }) {
        for (const double h : { 0.0, 0.3, 1.0, 1.6, 2.5 }) {
            if (h > n + kPiOfTests / 2) continue; // below the surface
            const vec2 normal(std::cos(n), std::sin(n));
            EXPECT_NEAR(openOfHalfSlice(std::cos(h), normal), arc(h, n, [](double) { return 1.0; }), 1e-4);
            const vec2 direction = directionOfHalfSlice(std::cos(h), normal);
            EXPECT_NEAR(direction.x, arc(h, n, [](double t) { return std::sin(t); }), 1e-6);
            EXPECT_NEAR(direction.y, arc(h, n, [](double t) { return std::cos(t); }), 1e-6);
        }
    }
}

/// Mean over slices of what a half slice leaves open, for horizons that `cosine` gives by azimuth, seen along the
/// normal.
template <class F>
double openOf(F const& cosine) {
    double sum = 0;
    constexpr int kSlices = 720;
    for (int i = 0; i < kSlices; ++i) sum += openOfHalfSlice(cosine(2 * kPiOfTests * (i + 0.5) / kSlices), vec2(1, 0));
    return 2 * sum / kSlices;
}

TEST(ScreenOcclusionArc, APlaneIsOpenAndAnInnerEdgeIsHalfOpen) {
    EXPECT_NEAR(openOf([](double) { return 0.0; }), 1, 1e-4) << "a plane";
    EXPECT_NEAR(openOf([](double azimuth) { return std::cos(azimuth) > 0 ? 1.0 : 0.0; }), 0.5, 1e-4) << "in the edge";
    // A wall of height 1 at distance 1: the cosine-weighted part that it hides is (1 - d / sqrt(d^2 + h^2)) / 2.
    const auto wall = [](double azimuth) {
        return std::max(std::cos(azimuth), 0.0) / std::hypot(1.0, std::cos(azimuth));
    };
    EXPECT_NEAR(openOf(wall), 1 - (1 - std::sqrt(0.5)) / 2, 1e-4);
}

TEST(ScreenOcclusionArc, TiltedSlicesOfAPlaneAddUpToOne) {
    for (const double tilt : { 0.0, 0.5, 1.2 }) {
        double sum = 0;
        constexpr int kSlices = 720;
        for (int i = 0; i < kSlices; ++i) {
            const double azimuth = kPiOfTests * (i + 0.5) / kSlices; // the normal leans by `tilt` along azimuth 0
            const vec2 projected(std::cos(tilt), std::sin(tilt) * std::cos(azimuth));
            const double weight = std::hypot(projected.x, projected.y);
            const vec2 normal = projected / weight;
            sum += weight * (openOfHalfSlice(-normal.y, normal) + openOfHalfSlice(normal.y, vec2(normal.x, -normal.y)));
        }
        EXPECT_NEAR(sum / kSlices, 1, 1e-4) << tilt;
    }
}

TEST(ScreenOcclusionSample, WhatASampleHidesGrowsWithItsElevationAndEndsAtTheRadius) {
    EXPECT_EQ(hiddenBySample(vec3(0.5, 0, 0), 0.0), 0) << "on the plane";
    EXPECT_EQ(hiddenBySample(vec3(0.5, 0, -0.2), -0.2), 0) << "below it";
    EXPECT_NEAR(hiddenBySample(vec3(0.2, 0, 0.2), 0.2), 0.5, 1e-9);
    EXPECT_NEAR(hiddenBySample(vec3(0, 0, 0.3), 0.3), 1, 1e-9);
    EXPECT_EQ(hiddenBySample(vec3(0, 0, 1.0), 1.0), 0) << "at the radius";
    EXPECT_EQ(hiddenBySample(vec3(3, 0, 4), 4.0), 0);
    EXPECT_EQ(hiddenBySample(vec3(0, 0, 0), 0.0), 0) << "the point itself";
}

TEST(ScreenOcclusionSample, AWedgesMeanDirectionIsThatOfItsIntegral) {
    for (const double sine : { 0.1, 0.5, 0.9, 1.0 }) {
        const double top = std::asin(sine);
        double along = 0, up = 0, weight = 0;
        for (int i = 0; i < kSteps; ++i) {
            const double e = top * (i + 0.5) / kSteps, w = std::sin(e) * std::cos(e);
            along += w * std::cos(e), up += w * std::sin(e), weight += w;
        }
        EXPECT_NEAR(directionOfWedge(sine).x, 1.5 * along / weight, 1e-6);
        EXPECT_NEAR(directionOfWedge(sine).y, 1.5 * up / weight, 1e-6);
    }
}

TEST(ScreenOcclusionLean, TexelsOfEightBitsKeepZeroExactAndTheRestToHalfAStep) {
    const auto stored = [](vec3 lean) { return decodeLean(glm::round(encodeLean(lean) * 255.0) / 255.0); };
    EXPECT_LT(glm::length(stored(vec3(0, 0, 0))), 1e-15);
    for (const double x : { -1.0, -0.3, 0.01, 0.77, 1.0 }) EXPECT_NEAR(stored(vec3(x, 0, -x)).x, x, 0.5 / 127 + 1e-12);
    EXPECT_NEAR(stored(vec3(7, -7, 0)).x, 1, 1e-12) << "clamped";
}

} // namespace
} // namespace filament_core::shader::lib64
