// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/CameraHands.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>

namespace filament_core::view {
namespace {

constexpr double kRadiansPerView = glm::radians(270.0); ///< of an orbit from one edge of the window to the other
constexpr double kLookRadiansPerView = glm::radians(90.0);
constexpr double kFactorPerLine = 0.87; ///< of the distance, for each line of the wheel
constexpr float kClickPixels = 3;       ///< that a hand shakes
constexpr double kFastFactor = 10;

double aspectOf(uint2 pixels) { return static_cast<double>(pixels.x) / std::max(pixels.y, 1u); }

} // namespace

CameraHands::Drag CameraHands::dragOf(MouseButton button, Modifiers const& modifiers) {
    if (button == MouseButton::Left) return modifiers.shift ? Drag::Pan : modifiers.control ? Drag::Look : Drag::Orbit;
    return button == MouseButton::Right && modifiers.alt ? Drag::Look : Drag::Pan;
}

void CameraHands::press(MouseButtonEvent const& event) {
    if (event.isDown && !mDrag) {
        mDrag = dragOf(event.button, event.modifiers);
        mButton = event.button;
        mPressed = mPointer;
        mHasMoved = false;
    } else if (!event.isDown && mDrag && event.button == mButton) {
        if (!mHasMoved && mButton == MouseButton::Left && mPointer.x >= 0 && mPointer.y >= 0) mClick = uint2(mPointer);
        mDrag.reset();
    }
}

bool CameraHands::drag(float2 pixel, uint2 viewPixels, Camera& camera) {
    const float2 from = std::exchange(mPointer, pixel);
    if (!mDrag) return false;
    mHasMoved |= std::max(std::abs(pixel.x - mPressed.x), std::abs(pixel.y - mPressed.y)) > kClickPixels;
    if (!mHasMoved) return false;
    const double2 moved = double2(pixel - from) / double2(max(viewPixels, uint2(1)));
    switch (*mDrag) {
    case Drag::Orbit:
        camera = orbited(camera, targetWorld, -moved.x * kRadiansPerView, moved.y * kRadiansPerView);
        break;
    case Drag::Look:
        camera = turned(camera, moved.x * kLookRadiansPerView, -moved.y * kLookRadiansPerView);
        break;
    case Drag::Pan: {
        const double distance = distanceTo(camera, targetWorld, leastMeters);
        const double aspect = aspectOf(viewPixels);
        const double3 before = camera.position();
        camera = panned(camera, pictureFromPixel(double2(from), viewPixels),
                        pictureFromPixel(double2(pixel), viewPixels), distance, aspect);
        targetWorld += camera.position() - before;
        break;
    }
    }
    return true;
}

bool CameraHands::zoom(ScrollEvent const& event, uint2 viewPixels, Camera& camera) const {
    const double distance = distanceTo(camera, targetWorld, leastMeters);
    double factor = std::pow(kFactorPerLine, static_cast<double>(std::clamp(event.lines.y, -20.0f, 20.0f)));
    factor = std::max(factor, leastMeters / distance);
    const double2 picture = pictureFromPixel(double2(mPointer), viewPixels);
    camera = zoomed(camera, picture, factor, distance, aspectOf(viewPixels));
    return event.lines.y != 0;
}

void CameraHands::hold(KeyEvent const& event) {
    const double speed = event.isDown ? 1 : 0;
    mIsFast = event.modifiers.shift;
    if (event.isDown && (event.modifiers.control || event.modifiers.alt)) return;
    switch (event.key) {
    case 'W':
        mForward = speed;
        break;
    case 'S':
        mBack = speed;
        break;
    case 'D':
        mRight = speed;
        break;
    case 'A':
        mLeft = speed;
        break;
    case 'E':
        mUp = speed;
        break;
    case 'Q':
        mDown = speed;
        break;
    default:
        break;
    }
}

FlyKeys CameraHands::keys() const {
    return { .right = mRight - mLeft, .up = mUp - mDown, .forward = mForward - mBack };
}

bool CameraHands::isMoving() const {
    const FlyKeys held = keys();
    return held.right != 0 || held.up != 0 || held.forward != 0;
}

bool CameraHands::advance(double seconds, Camera& camera) {
    if (!isMoving()) return false;
    const double3 before = camera.position();
    camera = flown(camera, keys(), { .metersPerSecond = metersPerSecond * (mIsFast ? kFastFactor : 1) }, seconds);
    targetWorld += camera.position() - before;
    return true;
}

bool CameraHands::handle(InputEvent const& event, uint2 viewPixels, Camera& camera) {
    if (auto const* button = std::get_if<MouseButtonEvent>(&event)) press(*button);
    if (auto const* key = std::get_if<KeyEvent>(&event)) hold(*key);
    if (auto const* focus = std::get_if<FocusEvent>(&event); focus && !focus->hasFocus) letGo();
    if (auto const* move = std::get_if<MouseMoveEvent>(&event)) return drag(move->pixel, viewPixels, camera);
    if (auto const* scroll = std::get_if<ScrollEvent>(&event)) return zoom(*scroll, viewPixels, camera);
    return false;
}

std::optional<uint2> CameraHands::takeClick() { return std::exchange(mClick, std::nullopt); }

void CameraHands::letGo() {
    mDrag.reset();
    mRight = mLeft = mUp = mDown = mForward = mBack = 0;
}

} // namespace filament_core::view
