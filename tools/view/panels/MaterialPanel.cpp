// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/MaterialRows.h"
#include "tools/view/panels/PanelFrame.h"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <algorithm>

namespace filament_core::view {
namespace {

void drawMaterialList(PanelFrame& frame, std::vector<MaterialRow> const& rows) {
    const float height = ImGui::GetContentRegionAvail().y * 0.35f;
    if (ImGui::BeginChild("materials", { 0, height }, true)) {
        for (MaterialRow const& row : rows) {
            const std::string label = fmt::format("{}{}##{}", row.name, row.edits > 0 ? " *" : "", row.name);
            if (ImGui::Selectable(label.c_str(), frame.state.selectedMaterial == row.name))
                frame.state.selectedMaterial = row.name;
            tooltip(fmt::format("{}: {} parts, {} edits", row.name, row.renderables, row.edits));
        }
        if (rows.empty()) quietText("no material");
    }
    ImGui::EndChild();
}

/// True: the value was changed.
bool drawComponents(ParameterRow const& row, ParameterValue& value) {
    std::vector<double> numbers = componentsOf(value);
    const auto count = static_cast<int>(numbers.size());
    bool isChanged = false;
    if (row.kind == ParameterKind::Switch) {
        for (int i = 0; i < count; ++i) {
            bool isOn = numbers[static_cast<size_t>(i)] != 0;
            ImGui::PushID(i);
            if (i > 0) ImGui::SameLine();
            if (ImGui::Checkbox("##on", &isOn)) isChanged = true;
            numbers[static_cast<size_t>(i)] = isOn;
            ImGui::PopID();
        }
    } else if (row.kind == ParameterKind::Color) {
        std::vector<float> color(numbers.begin(), numbers.end());
        constexpr ImGuiColorEditFlags kFlags = ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR;
        isChanged = count == 4 ? ImGui::ColorEdit4("##value", color.data(), kFlags)
                               : ImGui::ColorEdit3("##value", color.data(), kFlags);
        numbers.assign(color.begin(), color.end());
    } else if (count > 0) {
        const float step = std::holds_alternative<float>(value) ? 0.005f : 0.01f;
        isChanged = ImGui::DragScalarN("##value", ImGuiDataType_Double, numbers.data(), count, step, nullptr, nullptr,
                                       "%.4g");
    }
    if (isChanged) value = withComponents(value, numbers);
    return isChanged;
}

/// The file of an image; images that are dropped on the window go to the row that is chosen.
void drawPicture(PanelFrame& frame, MaterialRow const& material, ParameterRow const& row) {
    std::string const& parameter = row.description.name;
    const TextureTarget target{ material.name, parameter };
    if (ImGui::RadioButton("##drop", frame.state.textureTarget == target)) frame.state.textureTarget = target;
    tooltip("a picture that is dropped on the window comes here");
    ImGui::SameLine();
    bool isData = row.texture ? row.texture->isData : holdsData(parameter);
    std::string file = row.texture ? row.texture->file.string() : std::string();
    const bool toggles = row.texture && ImGui::Checkbox("##data", &isData);
    if (row.texture) {
        tooltip("the numbers themselves (normals, roughness), not colours");
        ImGui::SameLine();
    }
    ImGui::SetNextItemWidth(-FLT_MIN);
    const bool isEntered =
            ImGui::InputTextWithHint("##file", "picture file, Enter", &file, ImGuiInputTextFlags_EnterReturnsTrue);
    if (isEntered && file.empty())
        resetTexture(frame.document, material.name, parameter);
    else if (isEntered || toggles)
        setTexture(frame.document, material.name, parameter, file, isData);
}

void drawParameter(PanelFrame& frame, MaterialRow const& material, ParameterRow const& row) {
    ParameterDescription const& parameter = row.description;
    ImGui::PushID(parameter.name.c_str());
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    if (row.isEdited)
        ImGui::TextColored(kEditedColor, "%s", parameter.name.c_str());
    else
        ImGui::TextUnformatted(parameter.name.c_str());
    tooltip(fmt::format("{} {}", toString(parameter.type), parameter.name));
    ImGui::TableNextColumn();
    if (row.isEdited) {
        if (ImGui::SmallButton("x")) {
            resetParameter(frame.document, material.name, parameter.name);
            resetTexture(frame.document, material.name, parameter.name);
        }
        tooltip("as in the file");
        ImGui::SameLine();
    }
    ImGui::SetNextItemWidth(-FLT_MIN);
    if (row.value && row.kind != ParameterKind::Other) {
        ParameterValue value = *row.value;
        if (drawComponents(row, value)) setParameter(frame.document, material.name, parameter.name, value);
    } else if (takesPicture(parameter)) {
        drawPicture(frame, material, row);
    } else {
        quietText(parameter.arraySize > 0 ? fmt::format("{}[{}]", toString(parameter.type), parameter.arraySize)
                                          : std::string(toString(parameter.type)));
    }
    ImGui::PopID();
}

/// Of a .mat file: folded, because it is a table of many lines. Compiled when it is seen: that takes a second or two.
void drawMaterialCost(PanelFrame& frame) {
    if (!MaterialCost::has(frame.stage.shownFile()) || !ImGui::CollapsingHeader("cost, as matc --cost")) return;
    frame.materialCost.follow(frame.stage.shownFile());
    MaterialCost const& cost = frame.materialCost;
    if (ImGui::BeginChild("cost", { 0, ImGui::GetFontSize() * 12 }, true, ImGuiWindowFlags_HorizontalScrollbar))
        ImGui::TextUnformatted(cost.text().empty() && cost.isCompiling() ? "compiling" : cost.text().c_str());
    ImGui::EndChild();
}

} // namespace

void drawMaterialPanel(PanelFrame& frame) {
    filterField("##material filter", frame.state.materialFilter);
    const std::vector<MaterialRow> rows = materialRows(frame.stage, frame.document, frame.state.materialFilter);
    drawMaterialList(frame, rows);
    const auto selected = std::ranges::find(rows, frame.state.selectedMaterial, &MaterialRow::name);
    if (selected == rows.end()) {
        quietText("select a material");
        return;
    }
    ImGui::PushStyleColor(ImGuiCol_Text, kQuietColor);
    ImGui::TextWrapped("%s", describeMaterial(frame.stage.engine().describe(selected->material)).c_str());
    ImGui::PopStyleColor();
    drawMaterialCost(frame);
    if (ImGui::BeginTable("parameters", 2, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg)) {
        ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 1);
        ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 1.3f);
        for (ParameterRow const& row : parameterRows(frame.stage, *selected, frame.document))
            drawParameter(frame, *selected, row);
        ImGui::EndTable();
    }
}

} // namespace filament_core::view
