// SPDX-License-Identifier: Apache-2.0
/// UiInput: passes InputEvents to Dear ImGui's current context.
///   Order    ImGui looks at the mouse and the keys once a frame (ImGuiVersions.h). Events that one look would confuse
///            wait for the next frame: a button or a key that was pressed and released in one, or a pointer that moved
///            on after a click.
///   Out      pass(): the interface wants the event for itself: the pointer is over a panel, or a text is being edited,
///            as of the last frame.
///   Thread   that of the context.
#pragma once

#include "tools/view/app/InputEvent.h"

#include <deque>
#include <functional>
#include <string>

namespace filament_core::view {

/// The clipboard of a window system. Empty functions: one of this program alone.
struct Clipboard {
    std::function<void(std::string const&)> set;
    std::function<std::string()> get;
};

class UiInput {
public:
    /// Tells the current context which keys edit texts, and where texts are copied to. It must not be used after this
    /// ends.
    explicit UiInput(Clipboard clipboard = {});
    UiInput(UiInput const&) = delete;
    UiInput& operator=(UiInput const&) = delete;

    bool pass(InputEvent const& event);
    /// Before ImGui's NewFrame(): gives it what one frame can take. True: there is more for the next one.
    bool beginFrame();

    void copy(std::string const& text);
    std::string pasted() const;

private:
    void followPointer() const;

    std::deque<InputEvent> mWaiting;
    Clipboard mClipboard;
    std::string mOwnText;          ///< without a window system
    mutable std::string mForImGui; ///< until it asks again
};

} // namespace filament_core::view
