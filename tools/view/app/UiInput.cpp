// SPDX-License-Identifier: Apache-2.0
#include "tools/view/app/UiInput.h"

#include "tools/view/ui/ImGuiVersions.h"

#include <algorithm>
#include <array>
#include <limits>
#include <set>
#include <utility>

namespace filament_core::view {
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
        { kImGuiKeypadEnter, key::kKeypadEnter },
        { ImGuiKey_A, 'A' },
        { ImGuiKey_C, 'C' },
        { ImGuiKey_V, 'V' },
        { ImGuiKey_X, 'X' },
        { ImGuiKey_Y, 'Y' },
        { ImGuiKey_Z, 'Z' },
} };

void setModifiers(ImGuiIO& io, Modifiers const& modifiers) {
    setModifierKeys(io, modifiers.shift, modifiers.control, modifiers.alt, modifiers.super);
}

/// Gives an event to ImGui.
struct Apply {
    ImGuiIO& io;

    void operator()(KeyEvent const& event) const {
        const auto known = std::ranges::find(kKeys, event.key, &std::pair<ImGuiKey, int>::second);
        if (known != kKeys.end()) setKey(io, known->first, event.isDown);
        setModifiers(io, event.modifiers);
    }
    void operator()(TextEvent const& event) const { io.AddInputCharacter(event.character); }
    void operator()(MouseMoveEvent const& event) const { io.MousePos = ImVec2(event.pixel.x, event.pixel.y); }
    void operator()(MouseButtonEvent const& event) const {
        io.MouseDown[static_cast<size_t>(event.button)] = event.isDown; // in the order of ImGui
        setModifiers(io, event.modifiers);
    }
    void operator()(ScrollEvent const& event) const {
        io.MouseWheelH += event.lines.x;
        io.MouseWheel += event.lines.y;
    }
    void operator()(FocusEvent const& event) const {
        if (event.hasFocus) return;
        for (auto const& [key, number] : kKeys) setKey(io, key, false); // their releases go elsewhere
        std::fill(std::begin(io.MouseDown), std::end(io.MouseDown), false);
        io.MousePos = ImVec2(-std::numeric_limits<float>::max(), -std::numeric_limits<float>::max());
    }
    template <class Other>
    void operator()(Other const&) const {}
};

/// What one frame has got so far: whether it can take an event, too.
class FrameOfEvents {
public:
    bool canTake(InputEvent const& event) {
        if (auto const* button = std::get_if<MouseButtonEvent>(&event))
            return std::exchange(mButtons[static_cast<size_t>(button->button)], true) == false;
        if (std::holds_alternative<MouseMoveEvent>(event)) return !mButtons[0] && !mButtons[1] && !mButtons[2];
        if (auto const* key = std::get_if<KeyEvent>(&event)) return mKeys.insert(key->key).second;
        return true;
    }

private:
    bool mButtons[3]{}; ///< that have changed
    std::set<int> mKeys;
};

UiInput& inputOf(void* data) { return *static_cast<UiInput*>(data); }

} // namespace

UiInput::UiInput(Clipboard clipboard) : mClipboard(std::move(clipboard)) {
    ImGuiIO& io = ImGui::GetIO();
    prepareKeys(io);
    io.ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
    io.ClipboardUserData = this;
    io.SetClipboardTextFn = [](void* data, const char* text) { inputOf(data).copy(text); };
    io.GetClipboardTextFn = [](void* data) {
        UiInput const& input = inputOf(data);
        input.mForImGui = input.pasted();
        return input.mForImGui.c_str();
    };
}

/// A pointer that has moved since the last frame is over another window now: what it presses is that window's.
void UiInput::followPointer() const {
    const auto isButton = [](InputEvent const& event) { return std::holds_alternative<MouseButtonEvent>(event); };
    if (std::ranges::any_of(mWaiting, isButton)) return; // the pointer waits for it
    for (InputEvent const& event : mWaiting)
        if (auto const* move = std::get_if<MouseMoveEvent>(&event)) Apply{ ImGui::GetIO() }(*move);
    updateHovered();
}

bool UiInput::pass(InputEvent const& event) {
    ImGuiIO const& io = ImGui::GetIO();
    auto const* button = std::get_if<MouseButtonEvent>(&event);
    if (button && button->isDown) followPointer();
    mWaiting.push_back(event);
    if (std::holds_alternative<KeyEvent>(event) || std::holds_alternative<TextEvent>(event)) return io.WantTextInput;
    const bool isMouse = std::holds_alternative<MouseMoveEvent>(event) ||
                         std::holds_alternative<MouseButtonEvent>(event) || std::holds_alternative<ScrollEvent>(event);
    return isMouse && io.WantCaptureMouse;
}

bool UiInput::beginFrame() {
    FrameOfEvents frame;
    for (; !mWaiting.empty() && frame.canTake(mWaiting.front()); mWaiting.pop_front())
        std::visit(Apply{ ImGui::GetIO() }, mWaiting.front());
    return !mWaiting.empty();
}

void UiInput::copy(std::string const& text) {
    if (mClipboard.set) return mClipboard.set(text);
    mOwnText = text;
}

std::string UiInput::pasted() const { return mClipboard.get ? mClipboard.get() : mOwnText; }

} // namespace filament_core::view
