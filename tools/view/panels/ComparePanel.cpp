// SPDX-License-Identifier: Apache-2.0
// What the image is compared with, and defects that may be injected into the other API's commands.
#include "tools/view/panels/PanelFrame.h"
#include "tools/view/panels/PanelText.h"

#include <fmt/format.h>

namespace filament_core::view {
namespace {

void drawState(PanelFrame& frame) {
    PanelInputs const& inputs = frame.inputs;
    if (ImGui::Button("view")) frame.requests.actions.push_back(Action::Compare);
    tooltip("off, wipe, differences, FLIP");
    ImGui::SameLine();
    ImGui::TextUnformatted(inputs.compareMode.empty() ? "off" : inputs.compareMode.c_str());
    if (ImGui::Button("with")) frame.requests.actions.push_back(Action::CompareWith);
    tooltip("the other API, or the path tracer");
    ImGui::SameLine();
    ImGui::TextUnformatted(inputs.comparedWith.empty() ? "-" : inputs.comparedWith.c_str());
    if (!inputs.identical.empty()) ImGui::Text("%s of the pixels are identical", inputs.identical.c_str());
}

void drawInjected(PanelFrame& frame) {
    PanelState& state = frame.state;
    if (state.injectedDefect.empty()) return quietText("none injected: the two APIs draw the same bits");
    ImGui::TextColored(kDefectColor, "INJECTED into the other API: %s", state.injectedDefect.c_str());
    if (!frame.inputs.isDefectActive) quietText("waits for a comparison with the other API");
    if (ImGui::Button("remove the defect")) state.injectedDefect.clear();
}

void drawOffered(PanelFrame& frame) {
    PanelState& state = frame.state;
    filterField("##defect filter", state.defectFilter);
    if (!ImGui::BeginChild("defects", { 0, 0 }, true)) return ImGui::EndChild();
    for (OfferedDefect const& defect : frame.inputs.defects) {
        if (!matchesFilter(defect.name + ' ' + defect.what, state.defectFilter)) continue;
        const bool isInjected = state.injectedDefect == defect.name;
        const std::string label = fmt::format("{}##{}", defect.what, defect.name);
        if (ImGui::Selectable(label.c_str(), isInjected)) state.injectedDefect = isInjected ? "" : defect.name;
        tooltip(defect.name);
    }
    ImGui::EndChild();
}

} // namespace

void drawComparePanel(PanelFrame& frame) {
    drawState(frame);
    ImGui::Separator();
    ImGui::TextWrapped("Defects of the conformance suite, to see that a comparison finds them and where. Documents do "
                       "not keep them.");
    drawInjected(frame);
    drawOffered(frame);
}

} // namespace filament_core::view
