// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/PanelFrame.h"

#include <fmt/format.h>

namespace filament_core::view {
namespace {

const ImVec4 kDifferingColor{ 1, 0.35f, 0.3f, 1 };

/// Numbers below each other if the column is too narrow for them.
std::string fitted(std::string text) {
    if (ImGui::CalcTextSize(text.c_str()).x <= ImGui::GetContentRegionAvail().x) return text;
    for (size_t at = text.find(", "); at != std::string::npos; at = text.find(", ", at)) text[at + 1] = '\n';
    return text;
}

void cell(std::string const& text, bool differs) {
    ImGui::TableNextColumn();
    if (differs) ImGui::PushStyleColor(ImGuiCol_Text, kDifferingColor);
    ImGui::TextUnformatted(fitted(text).c_str());
    if (differs) ImGui::PopStyleColor();
}

void drawRow(PixelRow const& row) {
    ImGui::TableNextRow();
    cell(row.differs ? "!= " + row.name : row.name, row.differs);
    tooltip(fmt::format("{}: {}", row.name, row.detail));
    for (std::string const& value : row.values) cell(value, row.differs);
}

void drawGroup(std::string const& group) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    quietText(group);
    tooltip(group);
}

void drawRows(PixelReport const& report) {
    constexpr ImGuiTableFlags kFlags = ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_Resizable;
    if (!ImGui::BeginTable("pixel", 3, kFlags)) return;
    ImGui::TableSetupScrollFreeze(0, 1);
    ImGui::TableSetupColumn("attachment", ImGuiTableColumnFlags_WidthStretch, 1);
    for (size_t i = 0; i < 2; ++i) { // "vulkan: llvmpipe ...": the API is enough
        std::string const& engine = report.engines[i];
        const std::string name =
                engine.empty() ? (i == 0 ? "this API" : "other API") : engine.substr(0, engine.find(':'));
        ImGui::TableSetupColumn(name.c_str(), ImGuiTableColumnFlags_WidthStretch, 1.4f);
    }
    ImGui::TableHeadersRow();
    std::string_view group;
    for (PixelRow const& row : report.rows) {
        if (row.group != group) drawGroup(row.group);
        group = row.group;
        drawRow(row);
    }
    ImGui::EndTable();
}

} // namespace

void drawPixelPanel(PanelFrame& frame) {
    frame.requests.inspectsPixel = true;
    PixelReport const& report = frame.pixel;
    ImGui::Text("pixel %u, %u", report.pixel.x, report.pixel.y);
    ImGui::SameLine();
    bool isLocked = report.isLocked;
    if (ImGui::Checkbox("stays (L)", &isLocked)) frame.requests.togglesPixelLock = true;
    ImGui::SameLine();
    bool isExplained = report.isExplained;
    if (ImGui::Checkbox("explained", &isExplained)) frame.requests.togglesPixelExplanation = true;
    tooltip("light by light and effect by effect, with the surface and its ids: a frame of both APIs for each term, "
            "during which the window waits. Of a pixel that stays");
    if (report.rows.empty()) return quietText("both APIs draw the frame ...");
    if (!report.isComplete)
        quietText("drawing ...");
    else if (report.differing() > 0)
        ImGui::TextColored(kDifferingColor, "%u of %zu values differ", report.differing(), report.rows.size());
    else
        quietText(fmt::format("all {} values have the same bits on both APIs", report.rows.size()));
    if (report.unseen > 0) quietText(fmt::format("{} attachments have no such pixel", report.unseen));
    drawRows(report);
}

} // namespace filament_core::view
