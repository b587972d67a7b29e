// SPDX-License-Identifier: Apache-2.0
/// Shortcuts: what keys do, for the program and for the list on F1.
///   Keys     by their place on a US keyboard, as GLFW's tokens count them: on other layouts the same place
///            does the same. Labels are those of a US keyboard.
///   Thread   any; constant.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace filament_core::view {

/// The values of printable keys are their ASCII codes in upper case, as those of GLFW's tokens.
enum class Key : uint16_t {
    Space = 32,
    Zero = '0',
    One,
    Two,
    Three,
    A = 'A',
    B,
    C,
    D,
    E,
    F,
    G,
    H,
    I,
    J,
    K,
    L,
    M,
    N,
    O,
    P,
    Q,
    R,
    S,
    T,
    U,
    V,
    W,
    X,
    Y,
    Z,
    Escape = 256,
    Enter = 257,
    Tab = 258,
    Delete = 261,
    Home = 268,
    F1 = 290,
    F2,
    F3,
    F4,
    F5,
    F6,
    F7,
    F8,
    F9,
    F10,
    F11,
    F12,
};

enum class KeyModifiers : uint8_t { None, Control, Shift, ControlShift };

enum class Action : uint8_t {
    ShowShortcuts,
    Open,
    SaveDocument,
    SaveGltf,
    CopyDocument,
    CopyCamera,
    Paste,
    Reload,
    CancelLoading,
    Quit,
    Undo,
    Redo,
    FrameSelection,
    FrameAll,
    ResetCamera,
    ToggleParallel,
    AddBookmark,
    AddPathKey,
    PlayPath,
    HideSelection,
    IsolateSelection,
    ShowAll,
    PlayPause,
    MoveHandles,
    RotateHandles,
    ScaleHandles,
    NoHandles,
    HandleAxes,
    TogglePanels,
    ToggleFullScreen,
    NextDebugView,
    LockPixel,
    Compare,
    CompareWith,
    ChangeBackend,
    SavePicture,
    SavePictureAs,
    SaveFrame,
    Count,
};

struct Shortcut {
    Action action = Action::Count;
    Key key = Key::Escape;
    KeyModifiers modifiers = KeyModifiers::None;
    std::string_view section{}, help{};
};

/// In the order of the list; one of each action.
std::span<const Shortcut> shortcuts();
std::optional<Action> actionOf(Key key, KeyModifiers modifiers);
std::string labelOf(Shortcut const& shortcut); ///< "Ctrl+Shift+Z"

/// What the mouse does, for the list.
struct MouseHelp {
    std::string_view what{}, help{};
};
std::span<const MouseHelp> mouseHelp();

} // namespace filament_core::view
