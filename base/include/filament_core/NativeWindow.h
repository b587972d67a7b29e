// SPDX-License-Identifier: Apache-2.0
/// NativeWindow, NativeDisplay: windows opened by other libraries, to which the engine presents. docs/windows.md.
///   In      handles of the window system, as window libraries return them: nothing here includes its headers.
///   Life    the display outlives the engine, the window the swap chain.
///   Thread  the driver thread uses the display, too. X11: call XInitThreads() before the first call of Xlib (GLFW and
///           SDL do). Wayland needs nothing.
#pragma once

#include <cstdint>

namespace filament_core {

enum class WindowSystem : uint8_t { None, X11, Wayland };
constexpr const char* toString(WindowSystem system) {
    return system == WindowSystem::X11 ? "X11" : system == WindowSystem::Wayland ? "Wayland" : "no window system";
}

/// The connection to a window system.
struct NativeDisplay {
    WindowSystem system = WindowSystem::None;
    void* handle = nullptr; ///< Display* of Xlib; wl_display*

    /// `display`: a Display* of Xlib.
    static NativeDisplay x11(void* display) { return { WindowSystem::X11, display }; }
    /// `display`: a wl_display*.
    static NativeDisplay wayland(void* display) { return { WindowSystem::Wayland, display }; }
    friend bool operator==(NativeDisplay const&, NativeDisplay const&) = default;
};

/// A window of that display.
struct NativeWindow {
    WindowSystem system = WindowSystem::None;
    uint64_t handle = 0; ///< Window of Xlib, a number; wl_surface*

    static NativeWindow x11(unsigned long window) { return { WindowSystem::X11, window }; }
    /// `surface`: a wl_surface*.
    static NativeWindow wayland(void* surface) {
        return { WindowSystem::Wayland, static_cast<uint64_t>(reinterpret_cast<uintptr_t>(surface)) };
    }
    explicit operator bool() const { return handle != 0; }
    friend bool operator==(NativeWindow const&, NativeWindow const&) = default;
};

/// When a presented image replaces the one that the window shows.
enum class PresentMode : uint8_t {
    Fifo,      ///< at the next refresh of the display, in order: vsync. Every window has it
    Mailbox,   ///< at the next refresh; images that are overtaken are never shown
    Immediate, ///< at once: images may tear
};

} // namespace filament_core
