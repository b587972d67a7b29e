// SPDX-License-Identifier: Apache-2.0
#include "tests/tools/view/camera/RandomCameras.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace filament_core::view {
namespace {

constexpr int kRounds = 2000;

double elevationOf(Camera const& camera) { return std::asin(-camera.worldFromView[2].y); }

TEST(CameraControl, PictureFromPixelIsTheEdgesOfThePicture) {
    EXPECT_EQ(pictureFromPixel({ 0, 0 }, { 640, 360 }), double2(-1, -1));
    EXPECT_EQ(pictureFromPixel({ 640, 360 }, { 640, 360 }), double2(1, 1));
    EXPECT_EQ(pictureFromPixel({ 320, 90 }, { 640, 360 }), double2(0, -0.5));
}

TEST(CameraControl, PointAtIsSeenAtItsPlaceAndDistance) {
    Draw draw(1);
    for (int round = 0; round < kRounds; ++round) {
        const Camera camera = draw.rolled();
        const double2 picture = draw.picture();
        const double aspect = draw.aspect(), distance = draw.logarithmic(0.1, 100);
        const double3 point = pointAt(camera, picture, distance, aspect);
        EXPECT_NEAR(distanceTo(camera, point), distance, 1e-9);
        EXPECT_LT(glm::length(pictureOf(camera, point, aspect) - picture), 1e-9);
    }
    EXPECT_EQ(distanceTo(Camera{}, double3(0, 0, 5), 0.25), 0.25) << "behind the camera";
}

TEST(CameraControl, OrbitKeepsTheTargetInItsPlaceOfThePicture) {
    Draw draw(2);
    for (int round = 0; round < kRounds; ++round) {
        const Camera before = draw.rolled();
        const double aspect = draw.aspect();
        const double3 target = pointAt(before, draw.picture(), draw.logarithmic(0.1, 50), aspect);
        const Camera after = orbited(before, target, draw.number(-7, 7), draw.number(-4, 4));
        EXPECT_LT(glm::length(pictureOf(after, target, aspect) - pictureOf(before, target, aspect)), 1e-8);
        EXPECT_NEAR(glm::length(after.position() - target), glm::length(before.position() - target), 1e-9);
        EXPECT_LT(turnError(after), 1e-12);
    }
}

TEST(CameraControl, OrbitGoesToTheRightAndUpAndStopsAtThePoles) {
    const Camera front = Camera::lookAt({ 0, 0, 2 }, double3(0));
    EXPECT_LT(glm::length(orbited(front, double3(0), std::numbers::pi / 2, 0).position() - double3(2, 0, 0)), 1e-12);
    const Camera above = orbited(front, double3(0), 0, 10), below = orbited(front, double3(0), 0, -10);
    EXPECT_NEAR(above.position().y, 2 * std::cos(kPoleMargin), 1e-12);
    EXPECT_NEAR(below.position().y, -2 * std::cos(kPoleMargin), 1e-12);
    EXPECT_GT(above.worldFromView[1].y, 0) << "its up is still up";
    EXPECT_LT(apart(orbited(above, double3(0), 0, 5), above), 1e-12);
}

TEST(CameraControl, OrbitStepsMakeWhatOneStepMakes) {
    Draw draw(3);
    for (int round = 0; round < kRounds; ++round) {
        const Camera before = draw.rolled();
        const double3 target = draw.point(10);
        const double yaw = draw.number(-3, 3), pitch = draw.number(-4, 4);
        Camera stepped = before;
        for (int i = 0; i < 25; ++i) stepped = orbited(stepped, target, yaw / 25, pitch / 25);
        EXPECT_LT(apart(stepped, orbited(before, target, yaw, pitch)), 1e-9);
    }
}

TEST(CameraControl, PanBringsThePointUnderTheCursorAlong) {
    Draw draw(4);
    for (int round = 0; round < kRounds; ++round) {
        const Camera before = draw.rolled();
        const double aspect = draw.aspect(), distance = draw.logarithmic(0.1, 100);
        const double2 from = draw.picture(), to = draw.picture();
        const double3 held = pointAt(before, from, distance, aspect);
        const Camera after = panned(before, from, to, distance, aspect);
        EXPECT_LT(glm::length(pictureOf(after, held, aspect) - to), 1e-8);
        EXPECT_NEAR(distanceTo(after, held), distance, 1e-9);
        EXPECT_LT(apart(panned(after, to, from, distance, aspect), before), 1e-9);
    }
}

TEST(CameraControl, ZoomKeepsThePointUnderTheCursorAndScalesItsSize) {
    Draw draw(5);
    for (int round = 0; round < kRounds; ++round) {
        const Camera before = draw.rolled();
        const double aspect = draw.aspect(), distance = draw.logarithmic(0.1, 100), factor = draw.logarithmic(0.1, 10);
        const double2 picture = draw.picture();
        const double3 held = pointAt(before, picture, distance, aspect);
        const Camera after = zoomed(before, picture, factor, distance, aspect);
        EXPECT_LT(glm::length(pictureOf(after, held, aspect) - picture), 1e-6);
        const double3 beside = held + 1e-3 * distance * double3(before.worldFromView[0]);
        const double size = glm::length(pictureOf(before, beside, aspect) - picture);
        EXPECT_NEAR(glm::length(pictureOf(after, beside, aspect) - picture) / size, 1 / factor, 1e-3 / factor);
        if (!before.lens.isOrthographic()) {
            EXPECT_NEAR(distanceTo(after, held, 0), distance * factor, 1e-9);
        }
    }
}

TEST(CameraControl, ZoomStepsMakeWhatOneStepMakes) {
    Draw draw(6);
    for (int round = 0; round < kRounds; ++round) {
        const Camera before = draw.rolled();
        const double aspect = draw.aspect(), factor = draw.logarithmic(0.3, 3);
        const double2 picture = draw.picture();
        double distance = draw.logarithmic(0.1, 10);
        const Camera once = zoomed(before, picture, factor, distance, aspect);
        Camera stepped = before;
        for (int i = 0; i < 8; ++i) {
            const double step = std::pow(factor, 1.0 / 8);
            stepped = zoomed(stepped, picture, step, distance, aspect);
            if (!before.lens.isOrthographic()) distance *= step;
        }
        EXPECT_LT(apart(stepped, once), 1e-4 * static_cast<double>(std::max(1.0f, before.lens.orthographicHeight)));
        EXPECT_NEAR(stepped.lens.orthographicHeight, once.lens.orthographicHeight,
                    1e-5f * once.lens.orthographicHeight);
    }
}

FlyKeys keysOf(Draw& draw) {
    return { .right = draw.number(-1, 1),
             .up = draw.number(-1, 1),
             .forward = draw.number(-1, 1),
             .turnRight = draw.coin() ? 0 : draw.number(-1, 1),
             .turnUp = draw.coin() ? 0 : draw.number(-1, 1) };
}

TEST(CameraControl, FlightDoesNotDependOnTheStepsOfTime) {
    Draw draw(7);
    for (int round = 0; round < kRounds; ++round) {
        const Camera before = draw.rolled();
        const FlyKeys keys = keysOf(draw);
        const FlySpeed speed{ .metersPerSecond = draw.logarithmic(0.1, 10), .turnRadiansPerSecond = draw.number(0, 3) };
        const double seconds = draw.logarithmic(1e-3, 3);
        const int steps = 1 + static_cast<int>(draw.number(0, 60));
        Camera stepped = before;
        for (int i = 0; i < steps; ++i) stepped = flown(stepped, keys, speed, seconds / steps);
        const Camera once = flown(before, keys, speed, seconds);
        EXPECT_LT(apart(stepped, once), 1e-9) << round;
        EXPECT_LT(turnError(once), 1e-12);
    }
}

TEST(CameraControl, FlightIsTheIntegralOfItsVelocity) {
    Draw draw(8);
    for (int round = 0; round < 50; ++round) {
        const Camera before = draw.rolled();
        const FlyKeys keys = keysOf(draw);
        const FlySpeed speed{ .metersPerSecond = 2, .turnRadiansPerSecond = 1 };
        constexpr int kSteps = 20'000; // the midpoint rule: an error of (1 / 20000)^2
        Camera turning = before;
        double3 position = before.position();
        const double dt = 1.0 / kSteps;
        for (int i = 0; i < kSteps; ++i) {
            turning = turned(turning, keys.turnRight * dt / 2, keys.turnUp * dt / 2);
            const glm::dmat3 axes(turning.worldFromView);
            position += axes * double3(keys.right, keys.up, -keys.forward) * (2 * dt);
            turning = turned(turning, keys.turnRight * dt / 2, keys.turnUp * dt / 2);
        }
        const Camera once = flown(before, keys, speed, 1);
        EXPECT_LT(glm::length(once.position() - position), 1e-6);
        EXPECT_LT(glm::length(once.worldFromView[2] - turning.worldFromView[2]), 1e-6);
    }
}

TEST(CameraControl, FlightGoesWhereTheKeysSay) {
    const Camera front = Camera::lookAt({ 0, 0, 2 }, double3(0));
    const FlySpeed speed{ .metersPerSecond = 3 };
    EXPECT_LT(glm::length(flown(front, { .forward = 1 }, speed, 0.5).position() - double3(0, 0, 0.5)), 1e-12);
    EXPECT_LT(glm::length(flown(front, { .right = 1 }, speed, 1).position() - double3(3, 0, 2)), 1e-12);
    EXPECT_LT(glm::length(flown(front, { .up = -1 }, speed, 1).position() - double3(0, -3, 2)), 1e-12);
    EXPECT_LT(apart(flown(front, {}, speed, 9), front), 1e-15);
    const double3 forward = -double3(turned(front, 0.1, 0.2).worldFromView[2]);
    EXPECT_GT(forward.x, 0);
    EXPECT_NEAR(forward.y, std::sin(0.2), 1e-12);
    EXPECT_NEAR(elevationOf(turned(front, 0, 9)), std::numbers::pi / 2 - kPoleMargin, 1e-9);
}

Box boxOf(Draw& draw) {
    const double3 middle = draw.point(10),
                  half{ draw.logarithmic(0.01, 5), draw.logarithmic(0.01, 5), draw.logarithmic(0.01, 5) };
    return { middle - half, middle + half };
}

/// The part of the image that the box covers: the least and the most of each axis.
struct Covered {
    double2 low{ 1e300 }, high{ -1e300 };
    double nearest = 1e300, farthest = -1e300;
};

Covered coveredBy(Camera const& camera, Box const& box, double aspect) {
    Covered covered;
    for (int i = 0; i < 8; ++i) {
        const double3 corner(i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
                             i & 4 ? box.max.z : box.min.z);
        const double2 at = pictureOf(camera, corner, aspect);
        const double distance = distanceTo(camera, corner, -1e300);
        covered.low = glm::min(covered.low, at);
        covered.high = glm::max(covered.high, at);
        covered.nearest = std::min(covered.nearest, distance);
        covered.farthest = std::max(covered.farthest, distance);
    }
    return covered;
}

TEST(CameraControl, FramedBoxFillsThePictureInAnyAspect) {
    Draw draw(9);
    int atTheBox = 0;
    for (int round = 0; round < kRounds; ++round) {
        const Camera before = draw.rolled();
        const Box box = boxOf(draw);
        const double aspect = draw.aspect(), margin = draw.number(0, 0.4);
        const Camera after = framed(before, box, aspect, margin);
        const Covered covered = coveredBy(after, box, aspect);
        const double tolerance = 2e-6; // orthographicHeight is a float
        const double most = std::max({ covered.high.x, covered.high.y, -covered.low.x, -covered.low.y });
        ASSERT_GT(covered.nearest, 0);
        EXPECT_LE(most, 1 - margin + tolerance);
        const bool fillsX = covered.high.x > 1 - margin - tolerance && covered.low.x < margin - 1 + tolerance;
        const bool fillsY = covered.high.y > 1 - margin - tolerance && covered.low.y < margin - 1 + tolerance;
        const bool isAtTheBox =
                !after.lens.isOrthographic() && covered.nearest < 0.0101 * glm::length(box.max - box.min);
        EXPECT_TRUE(fillsX || fillsY || isAtTheBox) << "touches two opposite edges";
        atTheBox += isAtTheBox;
        EXPECT_GE(covered.nearest, static_cast<double>(after.lens.nearMeters));
        if (after.lens.isOrthographic()) {
            EXPECT_LE(covered.farthest, static_cast<double>(after.lens.farMeters));
        }
        EXPECT_EQ(after.worldFromView[2], before.worldFromView[2]) << "it looks in the same direction";
    }
    EXPECT_LT(atTheBox, kRounds / 50);
}

TEST(CameraControl, FramingAnEmptyBoxChangesNothingAndAPointIsSeen) {
    Draw draw(10);
    for (int round = 0; round < 200; ++round) {
        const Camera before = draw.rolled();
        EXPECT_LT(apart(framed(before, Box{}, 1.5), before), 1e-15);
        const double3 point = draw.point(5);
        const Camera after = framed(before, { point, point }, 1.5);
        const double2 at = pictureOf(after, point, 1.5);
        EXPECT_LE(std::max(std::abs(at.x), std::abs(at.y)), 1.0);
        EXPECT_GT(distanceTo(after, point, -1), static_cast<double>(after.lens.nearMeters));
    }
}

TEST(CameraControl, FramedAlongAnAxisLooksAlongIt) {
    Draw draw(11);
    for (const double3 direction : { double3(1, 0, 0), double3(-1, 0, 0), double3(0, 1, 0), double3(0, -1, 0),
                                     double3(0, 0, 1), double3(0, 0, -1) }) {
        const Camera camera = framedAlong(draw.rolled(), direction, boxOf(draw), 1.3);
        EXPECT_LT(glm::length(double3(camera.worldFromView[2]) + direction), 1e-12);
        if (direction.y == 0) {
            EXPECT_NEAR(camera.worldFromView[1].y, 1, 1e-12);
        }
    }
    const Camera above = framedAlong(Camera{}, { 0, -1, 0 }, { double3(-1), double3(1) }, 1);
    EXPECT_LT(glm::length(double3(above.worldFromView[1]) - double3(0, 0, -1)), 1e-12);
}

TEST(CameraControl, TheOtherLensShowsWhatIsAtTheDistanceAsLarge) {
    Draw draw(12);
    for (int round = 0; round < kRounds; ++round) {
        const Camera before = draw.rolled();
        const double aspect = draw.aspect(), distance = draw.logarithmic(0.1, 100);
        const Camera after = before.lens.isOrthographic() ? asPerspective(before, draw.number(5, 120), distance)
                                                          : asParallel(before, distance);
        EXPECT_NE(after.lens.isOrthographic(), before.lens.isOrthographic());
        for (const double2 picture : { double2(0), double2(-0.7, 0.3), double2(1, -1) }) {
            const double3 point = pointAt(before, picture, distance, aspect);
            EXPECT_LT(glm::length(pictureOf(after, point, aspect) - picture), 2e-5); // fields of view are floats
        }
    }
}

TEST(CameraControl, AnotherPlaceKeepsTheExposure) {
    Draw draw(13);
    const Camera current = draw.camera(), other = draw.camera();
    const Camera camera = withPlaceOf(current, other);
    EXPECT_EQ(camera.exposure, current.exposure);
    EXPECT_EQ(apart(camera, other), 0);
    EXPECT_EQ(camera.lens.verticalFovDegrees, other.lens.verticalFovDegrees);
}

} // namespace
} // namespace filament_core::view
