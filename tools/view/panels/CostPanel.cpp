// SPDX-License-Identifier: Apache-2.0
// Error over time: a point for each setting of quality, measured in this scene, and the front that no other one beats.
#include "tools/view/panels/CostPlot.h"
#include "tools/view/panels/PanelFrame.h"
#include "tools/view/panels/PanelText.h"

#include <fmt/format.h>

#include <algorithm>

namespace filament_core::view {
namespace {

constexpr ImU32 kPointColor = IM_COL32(120, 170, 230, 255), kFrontColor = IM_COL32(255, 210, 120, 255),
                kCurrentColor = IM_COL32(120, 230, 140, 255), kAxisColor = IM_COL32(110, 110, 110, 255),
                kGridColor = IM_COL32(60, 60, 60, 255);
constexpr float kPointRadius = 3, kReach = 9; // pixels
constexpr uint32_t kTicks = 5;

void choose(PanelFrame& frame, QualitySetting const& setting) {
    if (hasSetting(frame.document.view, setting)) return;
    applySetting(frame.document.view, setting);
    frame.changes.changed("measured setting", "before", setting.name);
}

void drawAxes(ImDrawList& list, PlotScale const& scale) {
    const float2 end = scale.origin + scale.size;
    const ImU32 text = ImGui::GetColorU32(kQuietColor);
    for (const double x : ticksOf(scale.leastX, scale.mostX, kTicks)) {
        const float at = scale.place(x, scale.leastY).x;
        list.AddLine({ at, scale.origin.y }, { at, end.y }, kGridColor);
        list.AddText({ at + 2, end.y + 1 }, text, fmt::format("{:g}", x).c_str());
    }
    for (const double y : ticksOf(scale.leastY, scale.mostY, kTicks)) {
        const float at = scale.place(scale.leastX, y).y;
        list.AddLine({ scale.origin.x, at }, { end.x, at }, kGridColor);
        list.AddText({ scale.origin.x + 2, at - ImGui::GetFontSize() }, text, fmt::format("{:g} %", y * 100).c_str());
    }
    list.AddRect({ scale.origin.x, scale.origin.y }, { end.x, end.y }, kAxisColor);
}

/// Steps: what is right of and above a corner is beaten.
void drawFront(ImDrawList& list, PlotScale const& scale, std::span<const MeasuredSetting> points,
               std::span<const size_t> front) {
    for (size_t i = 0; i + 1 < front.size(); ++i) {
        MeasuredSetting const& from = points[front[i]];
        MeasuredSetting const& to = points[front[i + 1]];
        const float2 a = scale.place(from.milliseconds, *from.error), b = scale.place(to.milliseconds, *from.error),
                     c = scale.place(to.milliseconds, *to.error);
        list.AddLine({ a.x, a.y }, { b.x, b.y }, kFrontColor, 1.5f);
        list.AddLine({ b.x, b.y }, { c.x, c.y }, kFrontColor, 1.5f);
    }
}

void drawPoints(ImDrawList& list, PlotScale const& scale, PanelFrame const& frame, std::span<const size_t> front) {
    std::vector<MeasuredSetting> const& points = frame.inputs.costs.points;
    for (size_t i = 0; i < points.size(); ++i) {
        if (!points[i].isMeasured()) continue;
        const float2 place = scale.place(points[i].milliseconds, *points[i].error);
        const bool isBest = std::ranges::find(front, i) != front.end();
        list.AddCircleFilled({ place.x, place.y }, kPointRadius, isBest ? kFrontColor : kPointColor);
        if (hasSetting(frame.document.view, points[i].setting))
            list.AddCircle({ place.x, place.y }, 2 * kPointRadius, kCurrentColor, 0, 2);
    }
}

void drawPlot(PanelFrame& frame, std::span<const size_t> front) {
    const float line = ImGui::GetFontSize(), width = std::max(ImGui::GetContentRegionAvail().x, 1.0f);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    std::span<const MeasuredSetting> points = frame.inputs.costs.points;
    const PlotScale scale = scaleOf(points, { corner.x, corner.y }, { width, line * 16 });
    const bool isClicked = ImGui::InvisibleButton("plot", { width, scale.size.y + line * 1.3f });
    const bool isHovered = ImGui::IsItemHovered();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(corner, { corner.x + width, corner.y + scale.size.y + line * 1.3f }, true);
    drawAxes(list, scale);
    drawFront(list, scale, points, front);
    drawPoints(list, scale, frame, front);
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    if (const auto near = isHovered ? nearestPoint(points, scale, { mouse.x, mouse.y }, kReach) : std::nullopt) {
        const float2 place = scale.place(points[*near].milliseconds, *points[*near].error);
        list.AddCircle({ place.x, place.y }, 2 * kPointRadius, IM_COL32_WHITE, 0, 1.5f);
        ImGui::SetTooltip("%s\nclick: makes this the setting", describe(points, *near).c_str());
        if (isClicked) choose(frame, points[*near].setting);
    }
    list.PopClipRect();
}

void drawBestList(PanelFrame& frame, std::span<const size_t> front) {
    quietText("settings that no other one beats:");
    if (!ImGui::BeginTable("best", 3, ImGuiTableFlags_RowBg | ImGuiTableFlags_ScrollY)) return;
    for (const size_t i : front) {
        MeasuredSetting const& point = frame.inputs.costs.points[i];
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        const bool isCurrent = hasSetting(frame.document.view, point.setting);
        if (ImGui::Selectable(point.setting.name.c_str(), isCurrent, ImGuiSelectableFlags_SpanAllColumns))
            choose(frame, point.setting);
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(millisecondsText(point.milliseconds).c_str());
        ImGui::TableNextColumn();
        ImGui::TextUnformatted(fmt::format("{:.3g} %", *point.error * 100).c_str());
    }
    ImGui::EndTable();
}

void drawMeasurement(PanelFrame& frame) {
    CostPlot const& costs = frame.inputs.costs;
    if (costs.isBusy()) {
        if (ImGui::Button("cancel")) frame.requests.cancelsCosts = true;
        ImGui::SameLine();
        const float share = costs.total ? static_cast<float>(costs.done) / static_cast<float>(costs.total) : 0.0f;
        ImGui::ProgressBar(share, { -FLT_MIN, 0 });
        return quietText(costs.doing);
    }
    if (ImGui::Button("measure this scene")) frame.requests.measuresCosts = true;
    tooltip("every setting of quality, one after the other, on an engine of its own:\nthe time of a frame, and the "
            "error "
            "of its picture");
    if (costs.state == CostPlot::State::Cancelled) ImGui::SameLine(), quietText("cancelled");
    if (costs.state == CostPlot::State::Failed) ImGui::TextWrapped("%s", costs.error.c_str());
    if (frame.inputs.isCostOfOther && !costs.points.empty())
        ImGui::TextColored(kEditedColor, "measured before the scene or the camera changed");
}

} // namespace

void drawCostPanel(PanelFrame& frame) {
    CostPlot const& costs = frame.inputs.costs;
    drawMeasurement(frame);
    const std::vector<size_t> front = paretoFront(costs.points);
    if (front.empty()) return;
    ImGui::PushTextWrapPos(0);
    quietText(fmt::format("{}, {}", costs.device, costs.clock));
    quietText(fmt::format("error: RMS as displayed, from {}", costs.reference));
    drawPlot(frame, front);
    quietText("milliseconds of a frame; upwards: the error. Green: as it is now.");
    ImGui::PopTextWrapPos();
    drawBestList(frame, front);
}

} // namespace filament_core::view
