// SPDX-License-Identifier: Apache-2.0
/// InputEvent: what hands do to a window, as plain values: tests make them, Window passes on those of GLFW.
///   Keys     by their place on the keyboard, named as a US keyboard has them: shortcuts are where hands expect them,
///            whatever the layout writes. The numbers are those of GLFW (GLFW_KEY_A is 65).
///   Places   in pixels of the window's images, from the left and the top.
#pragma once

#include <filament_core/Math.h>

#include <cstdint>
#include <filesystem>
#include <variant>
#include <vector>

namespace filament_core::view {

enum class MouseButton : uint8_t { Left, Right, Middle };

struct Modifiers {
    bool shift = false, control = false, alt = false, super = false;
    friend bool operator==(Modifiers const&, Modifiers const&) = default;
};

struct KeyEvent {
    int key = 0;
    bool isDown = false;
    Modifiers modifiers{};
};
struct TextEvent {
    uint32_t character = 0; ///< Unicode
};
struct MouseMoveEvent {
    float2 pixel{ 0 };
};
struct MouseButtonEvent {
    MouseButton button = MouseButton::Left;
    bool isDown = false;
    Modifiers modifiers{};
};
struct ScrollEvent {
    float2 lines{ 0 }; ///< up and to the left are positive, as wheels report it
    Modifiers modifiers{};
};
struct DropEvent {
    std::vector<std::filesystem::path> files;
};
struct ResizeEvent {
    uint2 pixels{ 0 }; ///< 0: minimised
    float scale = 1;   ///< of the display: 2 for dense ones
};
struct FocusEvent {
    bool hasFocus = false;
};
struct CloseEvent {};

using InputEvent = std::variant<KeyEvent, TextEvent, MouseMoveEvent, MouseButtonEvent, ScrollEvent, DropEvent,
                                ResizeEvent, FocusEvent, CloseEvent>;

} // namespace filament_core::view
