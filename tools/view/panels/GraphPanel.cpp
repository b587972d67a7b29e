// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/DemandRows.h"
#include "tools/view/panels/GraphModel.h"
#include "tools/view/panels/PanelFrame.h"
#include "tools/view/panels/PanelText.h"

#include <fmt/format.h>

#include <algorithm>

namespace filament_core::view {
namespace {

/// The frame goes from top to bottom: columns of the model are rows of the panel.
struct GraphScale {
    ImVec2 origin{};
    float width = 0, height = 0, gapX = 0, gapY = 0;

    ImVec2 corner(GraphBox const& box) const {
        return { origin.x + static_cast<float>(box.row) * (width + gapX),
                 origin.y + static_cast<float>(box.column) * (height + gapY) };
    }
    ImVec2 below(GraphBox const& box) const { return { corner(box).x + width / 2, corner(box).y + height }; }
    ImVec2 above(GraphBox const& box) const { return { corner(box).x + width / 2, corner(box).y }; }
};

/// From blue, which costs nothing, to red, which is the whole frame.
ImU32 heatColor(double share) {
    const float x = std::clamp(static_cast<float>(share), 0.0f, 1.0f);
    return ImGui::GetColorU32(ImVec4(0.15f + 0.55f * x, 0.25f - 0.05f * x, 0.45f - 0.3f * x, 1));
}

void drawArrow(ImDrawList& list, GraphScale const& scale, FrameGraphModel const& graph, GraphArrow const& arrow,
               bool isBright) {
    const ImVec2 from = scale.below(graph.boxes[arrow.from]), to = scale.above(graph.boxes[arrow.to]);
    const ImU32 color = isBright ? IM_COL32(255, 210, 120, 255) : IM_COL32(150, 150, 150, 140);
    const float bend = std::max(scale.gapY, (to.y - from.y) / 3);
    list.AddBezierCubic(from, { from.x, from.y + bend }, { to.x, to.y - bend }, to, color, isBright ? 2.0f : 1.0f);
    const float size = scale.gapY * 0.25f;
    list.AddTriangleFilled(to, { to.x - size, to.y - 2 * size }, { to.x + size, to.y - 2 * size }, color);
}

void drawBox(ImDrawList& list, GraphScale const& scale, GraphBox const& box, double frameMilliseconds, bool isBright) {
    const ImVec2 least = scale.corner(box), most(least.x + scale.width, least.y + scale.height);
    const ImU32 fill = box.runs ? heatColor(frameMilliseconds > 0 ? box.milliseconds / frameMilliseconds : 0)
                                : IM_COL32(40, 40, 40, 255);
    list.AddRectFilled(least, most, fill, 3);
    list.AddRect(least, most, isBright ? IM_COL32(255, 210, 120, 255) : IM_COL32(110, 110, 110, 255), 3);
    list.PushClipRect(least, most, true);
    const float pad = scale.gapX / 3, line = ImGui::GetFontSize();
    const ImU32 text = ImGui::GetColorU32(box.runs ? ImGuiCol_Text : ImGuiCol_TextDisabled);
    list.AddText({ least.x + pad, least.y + pad / 2 }, text, box.name.c_str());
    const std::string time = millisecondsText(box.milliseconds), bytes = bytesText(box.attachmentBytes);
    const std::string numbers = !box.runs ? "culled" : time.empty() ? bytes : fmt::format("{}, {}", time, bytes);
    list.AddText({ least.x + pad, least.y + pad / 2 + line }, text, numbers.c_str());
    list.PopClipRect();
}

std::string helpOfBox(FrameGraphModel const& graph, uint32_t index) {
    GraphBox const& box = graph.boxes[index];
    std::string text = fmt::format("{}: {}", box.name, box.reason);
    for (GraphArrow const& arrow : graph.arrows)
        if (arrow.to == index) text += fmt::format("\nreads {} of '{}'", arrow.resource, graph.boxes[arrow.from].name);
    for (GraphArrow const& arrow : graph.arrows)
        if (arrow.from == index) text += fmt::format("\n{} goes to '{}'", arrow.resource, graph.boxes[arrow.to].name);
    return text;
}

int hoveredBox(GraphScale const& scale, FrameGraphModel const& graph) {
    for (size_t i = 0; i < graph.boxes.size(); ++i) {
        const ImVec2 least = scale.corner(graph.boxes[i]);
        if (ImGui::IsMouseHoveringRect(least, { least.x + scale.width, least.y + scale.height }))
            return static_cast<int>(i);
    }
    return -1;
}

void drawGraph(FrameGraphModel const& graph) {
    const float line = ImGui::GetFontSize();
    GraphScale scale{ .origin = ImGui::GetCursorScreenPos(),
                      .width = line * 12,
                      .height = line * 2.6f,
                      .gapX = line,
                      .gapY = line * 1.4f };
    const float columns = static_cast<float>(std::max(graph.rows, 1u));
    if (columns == 1) // one after the other: in the middle
        scale.origin.x += std::max(0.0f, (ImGui::GetContentRegionAvail().x - scale.width) / 2);
    double frameMilliseconds = 0;
    for (GraphBox const& box : graph.boxes) frameMilliseconds += box.milliseconds;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const int hovered = ImGui::IsWindowHovered() ? hoveredBox(scale, graph) : -1;
    const auto isOf = [&](uint32_t box) { return static_cast<int>(box) == hovered; };
    for (GraphArrow const& arrow : graph.arrows)
        drawArrow(list, scale, graph, arrow, isOf(arrow.from) || isOf(arrow.to));
    for (uint32_t i = 0; i < graph.boxes.size(); ++i) drawBox(list, scale, graph.boxes[i], frameMilliseconds, isOf(i));
    ImGui::Dummy(
            { columns * (scale.width + scale.gapX), static_cast<float>(graph.columns) * (scale.height + scale.gapY) });
    if (hovered >= 0) ImGui::SetTooltip("%s", helpOfBox(graph, static_cast<uint32_t>(hovered)).c_str());
}

} // namespace

void drawGraphPanel(PanelFrame& frame) {
    const std::vector<EffectDecision> decisions = frame.stage.renderer().decisions();
    const FrameGraphModel graph = graphOf(frame.stage.renderer().graphviz(), decisions);
    const DemandTotals totals = totalsOf(decisions);
    const std::string time = millisecondsText(totals.milliseconds);
    quietText(fmt::format("{} of {} passes ran, {}{}{} drawn to; warm colours take most of the frame", totals.ran,
                          graph.boxes.size(), time, time.empty() ? "" : ", ", bytesText(totals.attachmentBytes)));
    if (ImGui::BeginChild("graph", { 0, 0 }, true, ImGuiWindowFlags_HorizontalScrollbar)) drawGraph(graph);
    ImGui::EndChild();
}

} // namespace filament_core::view
