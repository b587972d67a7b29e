// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/Shortcuts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace filament_core::view {
namespace {

using enum KeyModifiers;

constexpr std::array kShortcuts{
    Shortcut{ Action::ShowShortcuts, Key::F1, None, "window", "this list" },
    Shortcut{ Action::TogglePanels, Key::Tab, None, "window", "panels on and off" },
    Shortcut{ Action::ToggleFullScreen, Key::F11, None, "window", "full screen" },
    Shortcut{ Action::Quit, Key::Q, Control, "window", "end" },
    Shortcut{ Action::Open, Key::O, Control, "files", "open a model, a material, an environment or a document" },
    Shortcut{ Action::SaveDocument, Key::S, Control, "files", "save everything that is set" },
    Shortcut{ Action::SaveGltf, Key::S, ControlShift, "files", "save the scene as glTF, for other programs" },
    Shortcut{ Action::CopyDocument, Key::C, Control, "files", "copy everything that is set, as text" },
    Shortcut{ Action::CopyCamera, Key::C, ControlShift, "files", "copy the camera, as text" },
    Shortcut{ Action::Paste, Key::V, Control, "files", "paste a document, a camera or a camera path" },
    Shortcut{ Action::Reload, Key::F5, None, "files", "load all files again" },
    Shortcut{ Action::CancelLoading, Key::Escape, None, "files", "stop loading, select nothing" },
    Shortcut{ Action::Undo, Key::Z, Control, "edit", "undo" },
    Shortcut{ Action::Redo, Key::Z, ControlShift, "edit", "redo" },
    Shortcut{ Action::HideSelection, Key::H, None, "edit", "hide or show what is selected" },
    Shortcut{ Action::IsolateSelection, Key::I, None, "edit", "show only what is selected, or everything" },
    Shortcut{ Action::ShowAll, Key::H, Shift, "edit", "show everything" },
    Shortcut{ Action::MoveHandles, Key::One, None, "edit", "handles that move what is selected" },
    Shortcut{ Action::RotateHandles, Key::Two, None, "edit", "handles that turn it" },
    Shortcut{ Action::ScaleHandles, Key::Three, None, "edit", "handles that scale it" },
    Shortcut{ Action::NoHandles, Key::Zero, None, "edit", "no handles" },
    Shortcut{ Action::HandleAxes, Key::X, None, "edit", "handles along its own axes, or those of the world" },
    Shortcut{ Action::PlayPause, Key::Space, None, "edit", "play or stop the animation" },
    Shortcut{ Action::PlayPath, Key::Space, Shift, "camera", "play or stop the camera path" },
    Shortcut{ Action::AddPathKey, Key::K, None, "camera", "add this view to the camera path" },
    Shortcut{ Action::FrameSelection, Key::F, None, "camera", "look at what is selected" },
    Shortcut{ Action::FrameAll, Key::F, Shift, "camera", "look at everything" },
    Shortcut{ Action::ResetCamera, Key::Home, None, "camera", "back to the beginning" },
    Shortcut{ Action::ToggleParallel, Key::P, None, "camera", "perspective or parallel" },
    Shortcut{ Action::AddBookmark, Key::B, Control, "camera", "keep this view" },
    Shortcut{ Action::NextDebugView, Key::V, None, "picture", "next debug view" },
    Shortcut{ Action::LockPixel, Key::L, None, "picture", "the inspected pixel stays, or follows the pointer" },
    Shortcut{ Action::Compare, Key::C, None, "picture", "compare with the other API: wipe, difference, FLIP" },
    Shortcut{ Action::CompareWith, Key::C, Shift, "picture", "compare with the path tracer, or with the other API" },
    Shortcut{ Action::ChangeBackend, Key::B, None, "picture", "draw with the other API" },
    Shortcut{ Action::SavePicture, Key::F12, None, "picture", "save the picture" },
    Shortcut{ Action::SavePictureAs, Key::F12, Control, "picture", "save the picture as ..." },
    Shortcut{ Action::SaveFrame, Key::F12, Shift, "picture", "save a frame that can be replayed" },
};
static_assert(kShortcuts.size() == static_cast<size_t>(Action::Count), "every action has a key");

constexpr std::array kMouseHelp{
    MouseHelp{ "left button", "turn around what was selected last" },
    MouseHelp{ "right or middle button, Shift left", "move the point under the cursor" },
    MouseHelp{ "Ctrl left or Alt right button", "look around" },
    MouseHelp{ "wheel", "nearer to the point under the cursor, or farther" },
    MouseHelp{ "click", "select what is under the cursor" },
    MouseHelp{ "left button on a handle", "drag it; with Ctrl in whole steps, Esc: as before" },
    MouseHelp{ "W A S D, E, Q", "fly; with Shift ten times as fast" },
};

std::string keyLabel(Key key) {
    const auto code = static_cast<unsigned>(key);
    if (key >= Key::F1 && key <= Key::F12) return fmt::format("F{}", code - static_cast<unsigned>(Key::F1) + 1);
    switch (key) {
    case Key::Space:
        return "Space";
    case Key::Escape:
        return "Esc";
    case Key::Enter:
        return "Enter";
    case Key::Tab:
        return "Tab";
    case Key::Delete:
        return "Del";
    case Key::Home:
        return "Home";
    default:
        return std::string(1, static_cast<char>(code));
    }
}

} // namespace

std::span<const Shortcut> shortcuts() { return kShortcuts; }
std::span<const MouseHelp> mouseHelp() { return kMouseHelp; }

std::optional<Action> actionOf(Key key, KeyModifiers modifiers) {
    const auto found = std::ranges::find_if(
            kShortcuts, [&](Shortcut const& each) { return each.key == key && each.modifiers == modifiers; });
    return found == kShortcuts.end() ? std::nullopt : std::optional(found->action);
}

std::string labelOf(Shortcut const& shortcut) {
    std::string label;
    if (shortcut.modifiers == Control || shortcut.modifiers == ControlShift) label += "Ctrl+";
    if (shortcut.modifiers == Shift || shortcut.modifiers == ControlShift) label += "Shift+";
    return label + keyLabel(shortcut.key);
}

} // namespace filament_core::view
