// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/LightFields.h"
#include "tools/view/panels/PanelFrame.h"

#include <fmt/format.h>

#include <imgui_stdlib.h>

#include <algorithm>

namespace filament_core::view {
namespace {

bool drawChannels(LightChannels& channels) {
    bool isChanged = false;
    for (int bit = 0; bit < 8; ++bit) {
        bool isOn = channels >> bit & 1;
        ImGui::PushID(bit);
        if (bit > 0) ImGui::SameLine(0, 1);
        if (ImGui::Checkbox("##channel", &isOn)) {
            channels = static_cast<LightChannels>(channels ^ 1 << bit);
            isChanged = true;
        }
        tooltip(fmt::format("channel {}", bit));
        ImGui::PopID();
    }
    ImGui::SameLine();
    ImGui::TextUnformatted("channels");
    return isChanged;
}

bool drawDirection(const char* label, float3& direction) {
    const float3 before = direction;
    if (!ImGui::DragFloat3(label, &direction.x, 0.01f, -1, 1, "%.3f")) return false;
    if (direction == float3(0)) direction = before; // a direction has a length
    return direction != before;
}

bool drawLightField(LightField const& field) {
    const std::string label(field.name);
    switch (field.kind) {
    case LightFieldKind::Number:
        return numberField(label.c_str(), *std::get<float*>(field.value), field.least, field.most, field.isLogarithmic);
    case LightFieldKind::Switch:
        return ImGui::Checkbox(label.c_str(), std::get<bool*>(field.value));
    case LightFieldKind::Color:
        return ImGui::ColorEdit3(label.c_str(), &std::get<float3*>(field.value)->x,
                                 ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR);
    case LightFieldKind::Place:
        return vectorField(label.c_str(), *std::get<double3*>(field.value), 0.01f);
    case LightFieldKind::Direction:
        return drawDirection(label.c_str(), *std::get<float3*>(field.value));
    case LightFieldKind::Channels:
        return drawChannels(*std::get<LightChannels*>(field.value));
    }
    return false;
}

bool drawLightFields(LightDesc& light) {
    bool isChanged = false;
    ImGui::PushItemWidth(-ImGui::GetFontSize() * 11);
    for (LightField const& field : lightFields(light)) isChanged |= drawLightField(field);
    ImGui::PopItemWidth();
    return isChanged;
}

void drawLightRow(PanelFrame& frame, LightSelection which, std::string const& name, size_t kind, bool& isOn) {
    ImGui::PushID(static_cast<int>(which.light) * 2 + which.isModels);
    ImGui::Checkbox("##on", &isOn);
    tooltip("shines");
    ImGui::SameLine();
    const std::string label = fmt::format("{} ({})", name, lightKindName(kind));
    if (ImGui::Selectable(label.c_str(), frame.state.selectedLight == which)) frame.state.selectedLight = which;
    ImGui::PopID();
}

void drawLightList(PanelFrame& frame) {
    const float height = ImGui::GetContentRegionAvail().y * 0.35f;
    if (ImGui::BeginChild("lights", { 0, height }, true)) {
        for (uint32_t i = 0; i < frame.document.lights.size(); ++i) {
            DocumentLight& light = frame.document.lights[i];
            drawLightRow(frame, { false, i }, light.name, light.light.index(), light.isOn);
        }
        const std::vector<CopyLight> ofFile = frame.stage.modelLights();
        for (uint32_t i = 0; i < ofFile.size(); ++i) {
            const auto edit = std::ranges::find(frame.document.modelLights, i, &ModelLightEdit::light);
            const bool wasOn = edit == frame.document.modelLights.end() || edit->isOn;
            bool isOn = wasOn;
            drawLightRow(frame, { true, i }, ofFile[i].name + ", of the file", frame.stage.lightOfFile(i).index(),
                         isOn);
            if (isOn != wasOn) modelLightEdit(frame.document, i).isOn = isOn;
        }
    }
    ImGui::EndChild();
}

void drawAddLight(PanelFrame& frame) {
    if (ImGui::Button("add")) ImGui::OpenPopup("add light");
    if (!ImGui::BeginPopup("add light")) return;
    for (size_t kind = 0; kind < kLightKinds; ++kind) {
        if (!ImGui::MenuItem(std::string(lightKindName(kind)).c_str())) continue;
        addLight(frame.document, kind, frame.document.view.camera);
        frame.state.selectedLight = LightSelection{ false, static_cast<uint32_t>(frame.document.lights.size() - 1) };
    }
    ImGui::EndPopup();
}

void drawDocumentLight(PanelFrame& frame, uint32_t index) {
    ImGui::SameLine();
    if (ImGui::Button("copy")) copyLight(frame.document, index);
    ImGui::SameLine();
    if (ImGui::Button("remove")) {
        removeLight(frame.document, index);
        frame.state.selectedLight.reset();
        return;
    }
    DocumentLight& light = frame.document.lights[index];
    ImGui::InputText("name", &light.name);
    if (ImGui::BeginCombo("kind", std::string(lightKindName(light.light.index())).c_str())) {
        for (size_t kind = 0; kind < kLightKinds; ++kind) {
            const std::string name(lightKindName(kind));
            if (ImGui::Selectable(name.c_str(), kind == light.light.index())) light.light = withKind(light.light, kind);
        }
        ImGui::EndCombo();
    }
    drawLightFields(light.light);
}

void drawModelLight(PanelFrame& frame, uint32_t index) {
    const auto edit = std::ranges::find(frame.document.modelLights, index, &ModelLightEdit::light);
    const bool isEdited = edit != frame.document.modelLights.end() && edit->replacement;
    LightDesc light = isEdited ? *edit->replacement : frame.stage.lightOfFile(index);
    quietText("in the space of its node");
    if (drawLightFields(light)) modelLightEdit(frame.document, index).replacement = light;
    if (isEdited && ImGui::Button("as in the file")) {
        modelLightEdit(frame.document, index).replacement.reset();
        removeIdleEdits(frame.document);
    }
}

} // namespace

void drawLightPanel(PanelFrame& frame) {
    drawLightList(frame);
    drawAddLight(frame);
    if (!frame.state.selectedLight) return quietText("select a light");
    const LightSelection selected = *frame.state.selectedLight;
    if (!selected.isModels && selected.light < frame.document.lights.size())
        drawDocumentLight(frame, selected.light);
    else if (selected.isModels && selected.light < frame.stage.modelLights().size())
        drawModelLight(frame, selected.light);
    else
        frame.state.selectedLight.reset();
}

} // namespace filament_core::view
