// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/NodeTransform.h"
#include "tools/view/panels/PanelFrame.h"

#include <fmt/format.h>

namespace filament_core::view {
namespace {

std::string contentsOf(SceneNode const& node) {
    std::string text;
    if (node.renderables > 0) text += fmt::format(", parts: {}", node.renderables);
    if (node.lights > 0) text += fmt::format(", lights: {}", node.lights);
    if (node.hasCamera) text += ", a camera";
    return text;
}

void drawTreeRow(PanelFrame& frame, TreeRow const& row) {
    ImGui::PushID(static_cast<int>(row.node));
    bool isVisible = row.isVisible;
    if (ImGui::Checkbox("##visible", &isVisible)) toggleVisible(frame.document, row.node);
    tooltip("seen");
    ImGui::SameLine();
    const float indent = static_cast<float>(row.depth) * ImGui::GetStyle().IndentSpacing * 0.6f;
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + indent);
    if (row.hasChildren) {
        if (ImGui::ArrowButton("##open", row.isOpen ? ImGuiDir_Down : ImGuiDir_Right))
            frame.state.tree.toggle(row.node);
    } else {
        ImGui::Dummy({ ImGui::GetFrameHeight(), 0 });
    }
    ImGui::SameLine();
    const bool isQuiet = row.isHidden || !row.isVisible;
    ImGui::PushStyleColor(ImGuiCol_Text, isQuiet        ? kQuietColor
                                         : row.isEdited ? kEditedColor
                                                        : ImGui::GetStyleColorVec4(ImGuiCol_Text));
    if (ImGui::Selectable(nodeLabel(frame.nodes, row.node).c_str(), frame.state.selectedNode == row.node))
        frame.state.selectedNode = row.node;
    ImGui::PopStyleColor();
    tooltip(nodeLabel(frame.nodes, row.node) + contentsOf(frame.nodes[row.node]));
    ImGui::PopID();
}

void drawTree(PanelFrame& frame) {
    filterField("##tree filter", frame.state.treeFilter);
    const float height = ImGui::GetContentRegionAvail().y * kLeftShare;
    if (ImGui::BeginChild("tree", { 0, height }, true)) {
        const std::vector<TreeRow> rows =
                treeRows(frame.nodes, frame.document, frame.state.tree, frame.state.treeFilter);
        ImGuiListClipper clipper;
        clipper.Begin(static_cast<int>(rows.size()));
        while (clipper.Step())
            for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i)
                drawTreeRow(frame, rows[static_cast<size_t>(i)]);
        if (rows.empty()) quietText(frame.nodes.empty() ? "no model" : "no node has such a name");
    }
    ImGui::EndChild();
}

void drawTransform(PanelFrame& frame, uint32_t node) {
    const std::vector<Node> handles = frame.stage.nodes();
    if (node >= handles.size()) return;
    const double4x4 matrix = frame.stage.scene().parentFromNode(handles[node]);
    NodeTransform shown = transformOf(matrix);
    if (vectorField("position", shown.translation, 0.01f))
        setNodeTransform(frame.document, node, moved(matrix, shown.translation));
    if (vectorField("degrees", shown.degrees, 0.5f))
        setNodeTransform(frame.document, node, turned(matrix, shown.degrees));
    if (vectorField("scale", shown.scale, 0.005f)) setNodeTransform(frame.document, node, scaled(matrix, shown.scale));
    if (ImGui::Button("as in the file")) resetNodeTransform(frame.document, node);
}

} // namespace

void drawScenePanel(PanelFrame& frame) {
    drawTree(frame);
    if (ImGui::Button("show all")) showAll(frame.document);
    if (!frame.state.selectedNode || *frame.state.selectedNode >= frame.nodes.size()) {
        quietText("select a node");
        return;
    }
    const uint32_t node = *frame.state.selectedNode;
    ImGui::SameLine();
    if (ImGui::Button("isolate")) isolate(frame.document, frame.nodes, node);
    ImGui::SameLine();
    if (ImGui::Button("look at it")) frame.requests.framesSelection = true;
    ImGui::Separator();
    ImGui::TextUnformatted(nodeLabel(frame.nodes, node).c_str());
    quietText(fmt::format("node {}{}", node, contentsOf(frame.nodes[node])));
    ImGui::PushItemWidth(-ImGui::GetFontSize() * 5);
    drawTransform(frame, node);
    ImGui::PopItemWidth();
}

} // namespace filament_core::view
