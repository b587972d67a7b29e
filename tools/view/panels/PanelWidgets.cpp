// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/PanelFrame.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>

namespace filament_core::view {
namespace {

constexpr float kWidestSlider = 400; // of what can be aimed at with a slider
constexpr float kDragShare = 0.005f; // of the value, for a pixel

} // namespace

void quietText(std::string const& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, kQuietColor);
    ImGui::TextUnformatted(text.c_str());
    ImGui::PopStyleColor();
}

void filterField(const char* label, std::string& filter) {
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::InputTextWithHint(label, "filter", &filter);
}

bool numberField(const char* label, float& value, float least, float most, bool isLogarithmic) {
    if (!isLogarithmic && most - least <= kWidestSlider)
        return ImGui::SliderFloat(label, &value, least, most, "%.4g", ImGuiSliderFlags_AlwaysClamp);
    const float speed = std::max(std::abs(value) * kDragShare, 1e-4f);
    return ImGui::DragFloat(label, &value, speed, least, most, "%.6g", ImGuiSliderFlags_AlwaysClamp);
}

bool vectorField(const char* label, double3& value, float step) {
    return ImGui::DragScalarN(label, ImGuiDataType_Double, &value.x, 3, step, nullptr, nullptr, "%.4g");
}

void tooltip(std::string const& text) {
    if (!text.empty() && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text.c_str());
}

} // namespace filament_core::view
