// SPDX-License-Identifier: Apache-2.0
/// Window: a window of GLFW, without a graphics API of its own, and what happens to it as InputEvents.
///   Thread  the main thread.
///   Life    one at a time; the engine that presents to it ends before it.
///   Fails   open(): DeviceUnavailable without a display, in one line that says how to get one.
#pragma once

#include "base/Result.h"
#include "tools/view/app/InputEvent.h"
#include "tools/view/app/UiInput.h"

#include <filament_core/NativeWindow.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

struct GLFWwindow;

namespace filament_core::view {

class Window {
public:
    static Result<std::unique_ptr<Window>> open(std::string const& title, uint2 size);
    ~Window();
    Window(Window const&) = delete;
    Window& operator=(Window const&) = delete;

    NativeDisplay display() const;
    NativeWindow native() const;
    uint2 pixels() const; ///< 0: minimised
    float scale() const;
    Clipboard clipboard() const; ///< of the display; as long as the window is there

    /// What happened since the last call, in order; waits for something to happen, but no longer than this.
    std::vector<InputEvent> takeEvents(double waitSeconds);

    void setFullScreen(bool isFullScreen);

private:
    Window() = default;
    void listen();
    void push(InputEvent event) { mEvents.push_back(std::move(event)); }
    float2 pixelsOfUnits() const; ///< cursor positions are in units of the screen

    GLFWwindow* mWindow = nullptr;
    std::vector<InputEvent> mEvents;
    int mBefore[4]{}; ///< place and size before it filled the screen
};

} // namespace filament_core::view
