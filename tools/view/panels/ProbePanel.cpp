// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/PanelFrame.h"

#include <fmt/format.h>

#include <imgui_stdlib.h>

namespace filament_core::view {
namespace {

void drawProbeList(PanelFrame& frame) {
    if (ImGui::BeginChild("probes", { 0, ImGui::GetFontSize() * 8 }, true)) {
        for (size_t i = 0; i < frame.document.probes.size(); ++i) {
            DocumentProbe& probe = frame.document.probes[i];
            ImGui::PushID(static_cast<int>(i));
            ImGui::Checkbox("##on", &probe.isOn);
            tooltip("lights what is in its box");
            ImGui::SameLine();
            const std::string label = probe.name + (probe.file.empty() ? " (not captured)" : "");
            if (ImGui::Selectable(label.c_str(), frame.state.selectedProbe == i)) frame.state.selectedProbe = i;
            ImGui::PopID();
        }
    }
    ImGui::EndChild();
}

void drawCapture(PanelFrame& frame, size_t index) {
    if (frame.inputs.isCapturing) return quietText("capturing ...");
    if (ImGui::Button("capture")) frame.requests.capturesProbe = index;
    tooltip("draws what is seen from its middle, on an engine of its own, while the window stays live");
}

void drawProbe(PanelFrame& frame, size_t index) {
    ImGui::SameLine();
    if (ImGui::Button("copy")) copyProbe(frame.document, index);
    ImGui::SameLine();
    if (ImGui::Button("remove")) {
        frame.document.probes.erase(frame.document.probes.begin() + static_cast<std::ptrdiff_t>(index));
        frame.state.selectedProbe.reset();
        return;
    }
    ImGui::SameLine();
    drawCapture(frame, index);
    DocumentProbe& probe = frame.document.probes[index];
    ImGui::PushItemWidth(-ImGui::GetFontSize() * 9);
    ImGui::InputText("name", &probe.name);
    vectorField("middle, m", probe.centerWorld, 0.01f);
    ImGui::DragFloat3("half sides, m", &probe.halfExtentMeters.x, 0.01f, 1e-3f, 1e5f, "%.3f",
                      ImGuiSliderFlags_AlwaysClamp);
    ImGui::DragFloat("blend, m", &probe.blendMeters, 0.005f, 0, 1e4f, "%.3f", ImGuiSliderFlags_AlwaysClamp);
    numberField("intensity", probe.intensity, 0, 1e6f, true);
    ImGui::Checkbox("diffuse light, too", &probe.lightsDiffuse);
    ImGui::PopItemWidth();
}

void drawGridList(PanelFrame& frame) {
    std::optional<size_t> removed;
    for (size_t i = 0; i < frame.document.grids.size(); ++i) {
        DocumentGrid& grid = frame.document.grids[i];
        ImGui::PushID(static_cast<int>(i) + 1'000'000);
        ImGui::Checkbox("##on", &grid.isOn);
        ImGui::SameLine();
        ImGui::TextUnformatted(grid.file.filename().c_str());
        tooltip(grid.file.string());
        ImGui::SameLine();
        if (ImGui::Button("remove")) removed = i;
        ImGui::PopID();
    }
    if (removed) frame.document.grids.erase(frame.document.grids.begin() + static_cast<std::ptrdiff_t>(*removed));
}

void drawUse(PanelFrame& frame) {
    bool isShown = frame.document.view.debugView == DebugView::Probes;
    if (ImGui::Checkbox("show which probe lights what", &isShown))
        frame.document.view.debugView = isShown ? DebugView::Probes : DebugView::None;
    for (std::string const& line : probeLines(frame.stage.renderer().explain())) ImGui::TextWrapped("%s", line.c_str());
}

void drawBakeProgress(PanelFrame& frame, BakeProgress const& progress) {
    ImGui::ProgressBar(static_cast<float>(progress.share), { -ImGui::GetFontSize() * 5, 0 });
    ImGui::SameLine();
    if (ImGui::Button("cancel")) frame.requests.cancelsBake = true;
    tooltip("the same settings continue a lightmap where it was cancelled");
    quietText(progress.line);
}

void drawBake(PanelFrame& frame) {
    BakeProgress const& progress = frame.inputs.bake;
    if (progress.isRunning) return drawBakeProgress(frame, progress);
    BakeSettings& settings = frame.state.bake;
    int kind = static_cast<int>(settings.kind);
    ImGui::PushItemWidth(-ImGui::GetFontSize() * 9);
    if (ImGui::Combo("bake", &kind, "lightmap\0irradiance grid\0")) settings.kind = static_cast<BakeKind>(kind);
    ImGui::DragInt("paths", &settings.paths, 8, 32, 65536, "%d", ImGuiSliderFlags_AlwaysClamp);
    if (settings.kind == BakeKind::Lightmap) {
        numberField("texels a metre", settings.texelsPerMeter, 0.1f, 256, true);
    } else {
        numberField("spacing, m", settings.spacingMeters, 0.01f, 100, true);
        numberField("error", settings.error, 0.001f, 1, true);
        tooltip("of the light at held-out points: probes are added until it is below this");
    }
    ImGui::PopItemWidth();
    if (ImGui::Button("bake")) frame.requests.startsBake = true;
    tooltip("filament-bake traces the model's file in the background; what it writes is shown when it has finished");
}

} // namespace

void drawProbePanel(PanelFrame& frame) {
    std::optional<size_t>& selected = frame.state.selectedProbe;
    if (selected && *selected >= frame.document.probes.size()) selected.reset();
    drawProbeList(frame);
    if (ImGui::Button("add")) {
        addProbe(frame.document, frame.stage.bounds());
        selected = frame.document.probes.size() - 1;
    }
    if (selected) drawProbe(frame, *selected);
    drawGridList(frame);
    ImGui::Separator();
    drawUse(frame);
    ImGui::Separator();
    drawBake(frame);
}

} // namespace filament_core::view
