// SPDX-License-Identifier: Apache-2.0
// Mouse and keys move a camera: what is grabbed stays under the pointer, clicks are not drags, and time does not
// matter.
#include "tools/view/app/CameraHands.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <random>

namespace filament_core::view {
namespace {

constexpr uint2 kSize{ 800, 600 };

Camera cameraAt(double3 eye) { return Camera::lookAt(eye, double3(0)); }

struct Hands {
    CameraHands hands{};
    Camera camera = cameraAt({ 1, 2, 5 });

    bool move(float2 pixel) { return hands.handle(MouseMoveEvent{ pixel }, kSize, camera); }
    bool press(MouseButton button, Modifiers modifiers = {}) {
        return hands.handle(MouseButtonEvent{ button, true, modifiers }, kSize, camera);
    }
    bool release(MouseButton button) { return hands.handle(MouseButtonEvent{ button, false, {} }, kSize, camera); }
    bool scroll(float lines) { return hands.handle(ScrollEvent{ { 0, lines }, {} }, kSize, camera); }
    bool key(int code, bool isDown) { return hands.handle(KeyEvent{ code, isDown, {} }, kSize, camera); }
    double distance() const { return glm::length(camera.position() - hands.targetWorld); }
};

double largestDifference(Camera const& a, Camera const& b) {
    double largest = 0;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            largest = std::max(largest, std::abs(a.worldFromView[i][j] - b.worldFromView[i][j]));
    return largest;
}

TEST(CameraHands, OrbitsKeepTheirDistanceAndTheirTarget) {
    Hands hands;
    const double before = hands.distance();
    std::mt19937 random(3);
    std::uniform_real_distribution<float> place(0, 600);
    hands.move({ 300, 300 });
    hands.press(MouseButton::Left);
    for (int i = 0; i < 50; ++i) hands.move({ place(random), place(random) });
    hands.release(MouseButton::Left);
    EXPECT_NEAR(hands.distance(), before, 1e-9);
    EXPECT_EQ(hands.hands.targetWorld, double3(0));
    EXPECT_GT(largestDifference(hands.camera, cameraAt({ 1, 2, 5 })), 0.1);
    EXPECT_FALSE(hands.hands.takeClick().has_value());
}

TEST(CameraHands, WithoutAButtonNothingMoves) {
    Hands hands;
    const Camera before = hands.camera;
    for (float x = 0; x < 800; x += 50) EXPECT_FALSE(hands.move({ x, x / 2 }));
    EXPECT_EQ(largestDifference(hands.camera, before), 0);
}

TEST(CameraHands, AClickThatTremblesIsAClick) {
    Hands hands;
    const Camera before = hands.camera;
    hands.move({ 200, 100 });
    hands.press(MouseButton::Left);
    hands.move({ 202, 101 });
    hands.release(MouseButton::Left);
    EXPECT_EQ(hands.hands.takeClick(), std::optional(uint2(202, 101)));
    EXPECT_FALSE(hands.hands.takeClick().has_value()) << "once";
    EXPECT_EQ(largestDifference(hands.camera, before), 0);
    hands.press(MouseButton::Right);
    hands.release(MouseButton::Right);
    EXPECT_FALSE(hands.hands.takeClick().has_value()) << "only the left button picks";
}

TEST(CameraHands, PansKeepThePointUnderThePointer) {
    for (MouseButton button : { MouseButton::Middle, MouseButton::Right }) {
        Hands hands;
        hands.move({ 400, 300 });
        const double distance = distanceTo(hands.camera, hands.hands.targetWorld);
        const double aspect = 800.0 / 600;
        const double3 grabbed = pointAt(hands.camera, pictureFromPixel({ 400, 300 }, kSize), distance, aspect);
        hands.press(button);
        hands.move({ 250, 420 });
        const double3 now = pointAt(hands.camera, pictureFromPixel({ 250, 420 }, kSize), distance, aspect);
        EXPECT_LT(glm::length(now - grabbed), 1e-9);
        EXPECT_GT(glm::length(hands.hands.targetWorld), 0.1) << "the target moves with the view";
        hands.release(button);
    }
}

TEST(CameraHands, WheelsZoomToThePointerAndStopBeforeTheTarget) {
    Hands hands;
    hands.hands.leastMeters = 0.05;
    hands.move({ 400, 300 });
    double last = hands.distance();
    for (int i = 0; i < 200; ++i) {
        EXPECT_TRUE(hands.scroll(1));
        EXPECT_LE(hands.distance(), last + 1e-12);
        last = hands.distance();
    }
    EXPECT_NEAR(last, 0.05, 1e-6);
    EXPECT_FALSE(hands.scroll(0));
}

TEST(CameraHands, FlyingDoesNotDependOnTheTimeStep) {
    Hands once, often;
    for (Hands* hands : { &once, &often }) {
        hands->key('W', true);
        hands->key('D', true);
    }
    once.hands.advance(1, once.camera);
    for (int i = 0; i < 1000; ++i) often.hands.advance(0.001, often.camera);
    EXPECT_LT(largestDifference(once.camera, often.camera), 1e-9);
    EXPECT_TRUE(once.hands.isMoving());
    once.hands.handle(FocusEvent{ false }, kSize, once.camera);
    EXPECT_FALSE(once.hands.isMoving()) << "keys are let go with the focus";
    const Camera before = once.camera;
    EXPECT_FALSE(once.hands.advance(1, once.camera));
    EXPECT_EQ(largestDifference(once.camera, before), 0);
}

TEST(CameraHands, OppositeKeysAndHeldControlsDoNotMove) {
    Hands hands;
    hands.key('A', true);
    hands.key('D', true);
    EXPECT_FALSE(hands.hands.isMoving());
    hands.key('D', false);
    EXPECT_TRUE(hands.hands.isMoving());
    hands.key('A', false);
    hands.hands.handle(KeyEvent{ 'S', true, { .control = true } }, kSize, hands.camera);
    EXPECT_FALSE(hands.hands.isMoving()) << "Ctrl S saves";
}

} // namespace
} // namespace filament_core::view
