// SPDX-License-Identifier: Apache-2.0
// Rays agree with what cameras show, for every lens, and no ray misses what hands drag along.
#include "tests/tools/view/gizmo/RandomGizmos.h"

#include <gtest/gtest.h>

namespace filament_core::view {
namespace {

double2 pixelIn(PictureView const& view, Draw& draw) {
    return { draw.number(0, view.size.x), draw.number(0, view.size.y) };
}

TEST(PictureRays, ThePointsOfARayAreSeenAtItsPixel) {
    Draw draw(1);
    for (int round = 0; round < kRounds; ++round) {
        const RandomGizmo random(draw);
        const double2 pixel = pixelIn(random.view, draw);
        const PictureRay ray = rayThrough(random.view, pixel);
        EXPECT_NEAR(glm::length(ray.direction), 1, 1e-12);
        const double3 point = ray.originWorld + ray.direction * draw.logarithmic(0.1, 100);
        const auto seen = pixelOf(random.view, point);
        ASSERT_TRUE(seen.has_value());
        EXPECT_LT(glm::length(*seen - pixel), 1e-6);
    }
}

TEST(PictureRays, NothingBehindAnEyeIsSeen) {
    const PictureView view{ .camera = Camera::lookAt({ 0, 0, 2 }, double3(0)), .size = { 640, 360 } };
    EXPECT_FALSE(pixelOf(view, { 0, 0, 3 }).has_value());
    EXPECT_FALSE(pixelOf(view, { 0, 0, 2 }).has_value());
    EXPECT_EQ(pixelOf(view, { 0, 0, 0 }), double2(320, 180));
}

TEST(PictureRays, APixelIsAsHighAsTheCameraShowsIt) {
    Draw draw(2);
    for (int round = 0; round < kRounds; ++round) {
        const RandomGizmo random(draw);
        const double3 origin = random.frame.originWorld, up = double3(random.view.camera.worldFromView[1]);
        const double meters = metersPerPixel(random.view, origin);
        const auto here = pixelOf(random.view, origin), above = pixelOf(random.view, origin + up * meters);
        ASSERT_TRUE(here && above);
        EXPECT_LT(glm::length(*here - *above - double2(0, 1)), 1e-6);
    }
}

TEST(PictureRays, LinesAndPlanesAreMetWhereTheyAreSeen) {
    Draw draw(3);
    int lines = 0, planes = 0;
    for (int round = 0; round < kRounds; ++round) {
        const RandomGizmo random(draw);
        const double3 origin = random.frame.originWorld, axis = random.frame.axes[0];
        const double along = draw.number(-2, 2) * random.length(), across = draw.number(-2, 2) * random.length();
        if (const auto pixel = pixelOf(random.view, origin + axis * along); pixel && random.cosineOfView(axis) < 0.95) {
            EXPECT_NEAR(alongLine(rayThrough(random.view, *pixel), origin, axis), along, 1e-6 * random.length());
            ++lines;
        }
        const double3 point = origin + axis * along + random.frame.axes[1] * across;
        const auto pixel = pixelOf(random.view, point);
        const PictureRay ray = rayThrough(random.view, pixel.value_or(double2(0)));
        if (pixel && std::abs(glm::dot(ray.direction, random.frame.axes[2])) > 0.1) {
            EXPECT_LT(glm::length(onPlane(ray, origin, random.frame.axes[2]) - point), 1e-6 * random.length());
            ++planes;
        }
    }
    EXPECT_GT(lines, kRounds / 2);
    EXPECT_GT(planes, kRounds / 2);
}

TEST(PictureRays, SpheresAreMetOnTheSideThatIsAskedFor) {
    Draw draw(4);
    for (int round = 0; round < kRounds; ++round) {
        const RandomGizmo random(draw);
        const double3 center = random.frame.originWorld;
        const double radius = random.length() * draw.number(0.2, 1);
        const double2 pixel = pixelOf(random.view, center).value_or(double2(0)) + draw.picture() * 300.0;
        const PictureRay ray = rayThrough(random.view, pixel);
        const double3 towards = center - ray.originWorld;
        const double beside = glm::length(towards - ray.direction * glm::dot(towards, ray.direction));
        const bool isInFront = glm::dot(towards, ray.direction) > 0;
        for (const bool isNearSide : { true, false }) {
            const double3 at = onSphere(ray, center, radius, isNearSide);
            EXPECT_NEAR(glm::length(at - center), radius, 1e-9 * radius);
            if (!isInFront || beside > radius) continue;
            const double3 way = at - ray.originWorld;
            EXPECT_LT(glm::length(way - ray.direction * glm::dot(way, ray.direction)), 1e-6 * radius) << "on the ray";
            EXPECT_EQ(glm::dot(at - center, ray.direction) <= 1e-9 * radius,
                      isNearSide || beside > radius * (1 - 1e-9));
        }
    }
}

TEST(PictureRays, BeyondTheVanishingPointALineIsFarAndNotOnTheOtherSide) {
    const PictureView view{ .camera = Camera::lookAt({ 0, 1, 0 }, { 0, 1, -1 }), .size = { 600, 600 } };
    const double3 onFloor(0, 0, -4), away(0, 0, -1);
    double last = -1e9;
    for (double y = 590; y >= 0; y -= 10) { // up the image, over the horizon at 300
        const double t = alongLine(rayThrough(view, { 300, y }), onFloor, away);
        EXPECT_GE(t, last) << y;
        last = t;
    }
    EXPECT_DOUBLE_EQ(last, kFarthest * glm::length(double3(0, 1, 4)));
    EXPECT_EQ(alongLine(rayThrough(view, { 300, 100 }), onFloor, -away), -last);
}

TEST(PictureRays, BeyondTheHorizonAPlaneIsFarAndNotOnTheOtherSide) {
    const PictureView view{ .camera = Camera::lookAt({ 0, 1, 0 }, { 0, 1, -1 }), .size = { 600, 600 } };
    double last = 1e9;
    for (double y = 590; y >= 0; y -= 10) {
        const double3 point = onPlane(rayThrough(view, { 300, y }), double3(0, 0, -4), double3(0, 1, 0));
        EXPECT_NEAR(point.y, 0, 1e-9);
        EXPECT_LE(point.z, last + 1e-9) << y;
        last = point.z;
    }
    EXPECT_LT(last, -300);
}

} // namespace
} // namespace filament_core::view
