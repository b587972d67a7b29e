// SPDX-License-Identifier: Apache-2.0
/// What differs between the versions of Dear ImGui that distributions have: 1.86 (Debian 12), 1.90 (13) and 1.92
/// (testing).
///   Keys      1.86 reads an array of keys once a frame; 1.89 and later get events, all of which count in the next
///             frame.
///   Lists     a pointer and a count; a vector since 1.89.8.
///   Textures  identifiers are pointers, and numbers since 1.91.4; 1.92 stores them in references.
///   Thread    that of the context.
#pragma once

#include <imgui.h>
#include <imgui_internal.h>

#include <cstdint>
#include <span>
#include <type_traits>

namespace filament_core::view {

#if IMGUI_VERSION_NUM >= 18900
inline constexpr ImGuiKey kImGuiKeypadEnter = ImGuiKey_KeypadEnter;

/// Once for a context.
inline void prepareKeys(ImGuiIO& io) { io.ConfigInputTrickleEventQueue = false; }
inline void setKey(ImGuiIO& io, ImGuiKey key, bool isDown) { io.AddKeyEvent(key, isDown); }
inline void setModifierKeys(ImGuiIO& io, bool shift, bool control, bool alt, bool super) {
    io.AddKeyEvent(ImGuiMod_Shift, shift);
    io.AddKeyEvent(ImGuiMod_Ctrl, control);
    io.AddKeyEvent(ImGuiMod_Alt, alt);
    io.AddKeyEvent(ImGuiMod_Super, super);
}
#else
inline constexpr ImGuiKey kImGuiKeypadEnter = ImGuiKey_KeyPadEnter;

inline void prepareKeys(ImGuiIO& io) {
    for (int key = 0; key < ImGuiKey_COUNT; ++key) io.KeyMap[key] = key;
}
inline void setKey(ImGuiIO& io, ImGuiKey key, bool isDown) { io.KeysDown[key] = isDown; }
inline void setModifierKeys(ImGuiIO& io, bool shift, bool control, bool alt, bool super) {
    io.KeyShift = shift;
    io.KeyCtrl = control;
    io.KeyAlt = alt;
    io.KeySuper = super;
}
#endif

inline bool isKeyPressed(ImGuiKey key) {
#if IMGUI_VERSION_NUM >= 18900
    return ImGui::IsKeyPressed(key);
#else
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key));
#endif
}

/// A row that a list draws even where it is not seen.
inline void alwaysDraw(ImGuiListClipper& clipper, int row) {
#if IMGUI_VERSION_NUM >= 18990
    clipper.IncludeItemByIndex(row);
#else
    clipper.ForceDisplayRangeByIndices(row, row + 1);
#endif
}

/// What the pointer is over, and whether the interface wants it.
inline void updateHovered() {
#if IMGUI_VERSION_NUM >= 19200
    ImGui::UpdateHoveredWindowAndCaptureFlags(ImGui::GetIO().MousePos);
#else
    ImGui::UpdateHoveredWindowAndCaptureFlags();
#endif
}

inline std::span<ImDrawList* const> drawLists(ImDrawData const& data) {
#if IMGUI_VERSION_NUM >= 18980
    return { data.CmdLists.Data, static_cast<size_t>(data.CmdLists.Size) };
#else
    return { data.CmdLists, data.CmdLists ? static_cast<size_t>(data.CmdListsCount) : 0 };
#endif
}

template <class Id = ImTextureID>
Id textureIdOf(uint64_t bits) {
    if constexpr (std::is_pointer_v<Id>)
        return reinterpret_cast<Id>(static_cast<uintptr_t>(bits));
    else
        return static_cast<Id>(bits);
}

template <class Id>
uint64_t bitsOfTexture(Id id) {
    if constexpr (std::is_pointer_v<Id>)
        return reinterpret_cast<uintptr_t>(id);
    else
        return id;
}

inline void setTexture(ImDrawCmd& command, ImTextureID texture) {
#if IMGUI_VERSION_NUM >= 19200
    command.TexRef = ImTextureRef(texture);
#else
    command.TextureId = texture;
#endif
}

inline ImTextureID textureOf(ImFontAtlas const& fonts) {
#if IMGUI_VERSION_NUM >= 19200
    return fonts.TexRef.GetTexID();
#else
    return fonts.TexID;
#endif
}

} // namespace filament_core::view
