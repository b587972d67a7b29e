// SPDX-License-Identifier: Apache-2.0
// What lies over the image: how far loading is, and the list of shortcuts.
#include "tools/view/panels/PanelFrame.h"
#include "tools/view/panels/Shortcuts.h"

#include <fmt/format.h>

namespace filament_core::view {
namespace {

void drawShortcutRow(std::string const& keys, std::string_view help) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextColored(kEditedColor, "%s", keys.c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(help.data(), help.data() + help.size());
}

void drawSection(std::string_view section) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    quietText(std::string(section));
}

} // namespace

void drawShortcutList(PanelState& state) {
    if (!state.showsShortcuts) return;
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    ImGui::SetNextWindowPos({ display.x / 2, display.y / 2 }, ImGuiCond_Always, { 0.5f, 0.5f });
    constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse;
    if (ImGui::Begin("Keys and mouse", &state.showsShortcuts, kFlags) &&
        ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        std::string_view section;
        for (Shortcut const& shortcut : shortcuts()) {
            if (shortcut.section != section) drawSection(section = shortcut.section);
            drawShortcutRow(labelOf(shortcut), shortcut.help);
        }
        drawSection("mouse");
        for (MouseHelp const& help : mouseHelp()) drawShortcutRow(std::string(help.what), help.help);
        ImGui::EndTable();
    }
    ImGui::End();
}

void drawLoadProgress(PanelFrame& frame, PanelRect const& picture) {
    const StageProgress progress = frame.stage.progress();
    if (!progress.isLoading || !picture.isThere()) return;
    const float2 place = picture.position + picture.size * float2(0.5f, 0.9f);
    ImGui::SetNextWindowPos({ place.x, place.y }, ImGuiCond_Always, { 0.5f, 1 });
    constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                                        ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoFocusOnAppearing;
    if (ImGui::Begin("loading", nullptr, kFlags)) {
        ImGui::TextUnformatted(progress.what.c_str());
        const float share =
                progress.total > 0 ? static_cast<float>(progress.done) / static_cast<float>(progress.total) : 0.0f;
        ImGui::ProgressBar(share, { ImGui::GetFontSize() * 18, 0 });
        ImGui::SameLine();
        if (ImGui::Button("cancel")) frame.requests.cancelsLoading = true;
    }
    ImGui::End();
}

} // namespace filament_core::view
