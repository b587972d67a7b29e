// SPDX-License-Identifier: Apache-2.0
/// CameraHands: mouse and keys as movements of a camera.
///   Mouse    left: orbit; middle, right, or left with Shift: pan; right with Alt, or left with Control: look around;
///            wheel: zoom to the pointer. A left click that does not move is a click(): a pick.
///   Keys     W A S D E Q: fly, with Shift ten times as fast.
///   Distance what is grabbed is at the target: set it to what was picked.
///   Thread   any; a plain value.
#pragma once

#include "tools/view/app/InputEvent.h"
#include "tools/view/camera/CameraControl.h"

#include <optional>

namespace filament_core::view {

class CameraHands {
public:
    double3 targetWorld{ 0 };   ///< what orbits turn around
    double metersPerSecond = 1; ///< of flying
    double leastMeters = 1e-3;  ///< zooms do not come nearer than this to the target

    /// True: the camera is another one.
    bool handle(InputEvent const& event, uint2 viewPixels, Camera& camera);
    /// Keys that are held move the camera on.
    bool advance(double seconds, Camera& camera);
    bool isMoving() const; ///< keys are held
    bool isDragging() const { return mDrag.has_value(); }
    /// The pixel of a click since the last call.
    std::optional<uint2> takeClick();
    void letGo(); ///< of everything: the window has lost the focus

private:
    enum class Drag : uint8_t { Orbit, Pan, Look };
    static Drag dragOf(MouseButton button, Modifiers const& modifiers);
    void press(MouseButtonEvent const& event);
    bool drag(float2 pixel, uint2 viewPixels, Camera& camera);
    bool zoom(ScrollEvent const& event, uint2 viewPixels, Camera& camera) const;
    void hold(KeyEvent const& event);
    FlyKeys keys() const;

    std::optional<Drag> mDrag;
    MouseButton mButton = MouseButton::Left;
    float2 mPointer{ 0 }, mPressed{ 0 };
    bool mHasMoved = false, mIsFast = false;
    std::optional<uint2> mClick;
    double mRight = 0, mLeft = 0, mUp = 0, mDown = 0, mForward = 0, mBack = 0; ///< keys: 1 while they are held
};

} // namespace filament_core::view
