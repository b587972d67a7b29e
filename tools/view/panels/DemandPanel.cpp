// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/DemandRows.h"
#include "tools/view/panels/PanelFrame.h"
#include "tools/view/panels/PanelText.h"

#include <fmt/format.h>

namespace filament_core::view {
namespace {

void drawDecision(EffectDecision const& decision) {
    const ImVec4 color = isActive(decision) ? ImGui::GetStyleColorVec4(ImGuiCol_Text) : kQuietColor;
    ImGui::PushStyleColor(ImGuiCol_Text, color);
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(decision.name.c_str());
    tooltip(fmt::format("{}: {}\n{}", decision.name, toString(decision.state), decision.reason));
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(isActive(decision) ? isPass(decision) ? "ran" : "needed" : "-");
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(millisecondsText(decision.gpuMilliseconds).c_str());
    ImGui::TableNextColumn();
    if (isPass(decision)) ImGui::TextUnformatted(bytesText(decision.attachmentBytes).c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(decision.reason.c_str());
    ImGui::PopStyleColor();
}

} // namespace

void drawDemandPanel(PanelFrame& frame) {
    PanelState& state = frame.state;
    const std::vector<EffectDecision> decisions = frame.stage.renderer().decisions();
    const DemandTotals totals = totalsOf(decisions);
    ImGui::Text("%u of %u effects, %u of %u passes  %s", totals.needed, totals.effects, totals.ran, totals.passes,
                millisecondsText(totals.milliseconds).c_str());
    ImGui::Checkbox("what runs", &state.onlyActiveDemand);
    ImGui::SameLine();
    ImGui::Checkbox("passes", &state.onlyPasses);
    filterField("##demand filter", state.demandFilter);
    constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollX | ImGuiTableFlags_ScrollY |
                                       ImGuiTableFlags_SizingFixedFit | ImGuiTableFlags_Resizable;
    if (!ImGui::BeginTable("demand", 5, kFlags)) return;
    ImGui::TableSetupScrollFreeze(1, 1);
    for (const char* column : { "effect or pass", "state", "device", "draws to", "why" })
        ImGui::TableSetupColumn(column);
    ImGui::TableHeadersRow();
    const DemandFilter filter{ state.demandFilter, state.onlyActiveDemand, state.onlyPasses };
    for (EffectDecision const* decision : demandRows(decisions, filter)) drawDecision(*decision);
    ImGui::EndTable();
}

} // namespace filament_core::view
