// SPDX-License-Identifier: Apache-2.0
/// FrameCallbacks: when a compositor of Wayland wants the next image of a surface, told to a WindowGate. Drivers that
/// wait for this themselves (Fifo of Vulkan, swap intervals of EGL) wait for ever while a surface is hidden, and with
/// them the driver thread; so they present without waiting, and the app thread waits for the gate.
///   Thread  request(), allowAnother(): the driver thread. A thread of its own reads the events of its own queue,
///           beside all other readers of the display.
///   Library libwayland-client, opened at run time.
///   Memory  a thread, a queue, and a callback while one is awaited.
///   Fails   create(): null, without the library or a thread.
#pragma once

#include "backend/api/WindowGate.h"

#include <memory>

namespace filament_core::backend {

class FrameCallbacks {
public:
    /// `display`: a wl_display*; `surface`: a wl_surface*, which lives longer.
    static std::unique_ptr<FrameCallbacks> create(void* display, void* surface, std::shared_ptr<WindowGate> gate);
    ~FrameCallbacks();
    FrameCallbacks(FrameCallbacks const&) = delete;
    FrameCallbacks& operator=(FrameCallbacks const&) = delete;

    /// Before an image is committed: one present more is allowed when the compositor wants the next.
    void request();
    /// Nothing was committed: the next present may come at once.
    void allowAnother();

private:
    struct State;
    explicit FrameCallbacks(std::unique_ptr<State> state);
    std::unique_ptr<State> mState;
};

} // namespace filament_core::backend
