// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/UiInput.h"

#include <imgui.h>

#include <array>
#include <limits>
#include <utility>

namespace filament::view {
namespace {

/// The numbers of GLFW for keys without a character.
namespace key {
constexpr int kSpace = 32, kEscape = 256, kEnter = 257, kTab = 258, kBackspace = 259, kInsert = 260, kDelete = 261,
              kRight = 262, kLeft = 263, kDown = 264, kUp = 265, kPageUp = 266, kPageDown = 267, kHome = 268,
              kEnd = 269, kKeypadEnter = 335;
} // namespace key

constexpr std::array<std::pair<ImGuiKey, int>, 22> kKeys{ {
        { ImGuiKey_Tab, key::kTab },
        { ImGuiKey_LeftArrow, key::kLeft },
        { ImGuiKey_RightArrow, key::kRight },
        { ImGuiKey_UpArrow, key::kUp },
        { ImGuiKey_DownArrow, key::kDown },
        { ImGuiKey_PageUp, key::kPageUp },
        { ImGuiKey_PageDown, key::kPageDown },
        { ImGuiKey_Home, key::kHome },
        { ImGuiKey_End, key::kEnd },
        { ImGuiKey_Insert, key::kInsert },
        { ImGuiKey_Delete, key::kDelete },
        { ImGuiKey_Backspace, key::kBackspace },
        { ImGuiKey_Space, key::kSpace },
        { ImGuiKey_Enter, key::kEnter },
        { ImGuiKey_Escape, key::kEscape },
        { ImGuiKey_KeyPadEnter, key::kKeypadEnter },
        { ImGuiKey_A, 'A' },
        { ImGuiKey_C, 'C' },
        { ImGuiKey_V, 'V' },
        { ImGuiKey_X, 'X' },
        { ImGuiKey_Y, 'Y' },
        { ImGuiKey_Z, 'Z' },
} };

void setModifiers(ImGuiIO& io, Modifiers const& modifiers) {
    io.KeyShift = modifiers.shift;
    io.KeyCtrl = modifiers.control;
    io.KeyAlt = modifiers.alt;
    io.KeySuper = modifiers.super;
}

struct Pass {
    ImGuiIO& io;

    bool operator()(KeyEvent const& event) const {
        if (event.key >= 0 && event.key < static_cast<int>(std::size(io.KeysDown)))
            io.KeysDown[event.key] = event.isDown;
        setModifiers(io, event.modifiers);
        return io.WantTextInput;
    }
    bool operator()(TextEvent const& event) const {
        io.AddInputCharacter(event.character);
        return io.WantTextInput;
    }
    bool operator()(MouseMoveEvent const& event) const {
        io.MousePos = ImVec2(event.pixel.x, event.pixel.y);
        return io.WantCaptureMouse;
    }
    bool operator()(MouseButtonEvent const& event) const {
        io.MouseDown[static_cast<size_t>(event.button)] = event.isDown; // in the order of ImGui
        setModifiers(io, event.modifiers);
        return io.WantCaptureMouse;
    }
    bool operator()(ScrollEvent const& event) const {
        io.MouseWheelH += event.lines.x;
        io.MouseWheel += event.lines.y;
        return io.WantCaptureMouse;
    }
    bool operator()(FocusEvent const& event) const {
        if (event.hasFocus) return false;
        std::fill(std::begin(io.KeysDown), std::end(io.KeysDown), false); // their releases go elsewhere
        std::fill(std::begin(io.MouseDown), std::end(io.MouseDown), false);
        io.MousePos = ImVec2(-std::numeric_limits<float>::max(), -std::numeric_limits<float>::max());
        return false;
    }
    template <class Other>
    bool operator()(Other const&) const {
        return false;
    }
};

} // namespace

void prepareUiInput() {
    ImGuiIO& io = ImGui::GetIO();
    for (auto const& [ours, theirs] : kKeys) io.KeyMap[ours] = theirs;
    io.ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
}

bool passToUi(InputEvent const& event) { return std::visit(Pass{ ImGui::GetIO() }, event); }

} // namespace filament::view
