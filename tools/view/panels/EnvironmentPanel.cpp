// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/PanelFrame.h"

#include <fmt/format.h>

#include <imgui_stdlib.h>

namespace filament_core::view {
namespace {

constexpr float kDegreesOfRadian = 57.29577951f, kMostLux = 1e6f;

/// How the file's sun is handled; a change loads the file again.
void drawSun(PanelFrame& frame) {
    EnvironmentLoadOptions& options = frame.document.environment.options;
    auto sun = static_cast<int>(options.sun);
    if (ImGui::Combo("sun", &sun, "keep\0extract\0fit\0")) options.sun = static_cast<EnvironmentSun>(sun);
    tooltip("extract: a compact sun becomes a light that casts shadows; fit: the brightest regions do");
    if (options.sun == EnvironmentSun::Fit) {
        auto lights = static_cast<int>(options.lights);
        if (ImGui::SliderInt("lights", &lights, 1, static_cast<int>(EnvironmentLights::kMost), "%d",
                             ImGuiSliderFlags_AlwaysClamp))
            options.lights = static_cast<uint32_t>(lights);
    }
    const std::string lights = frame.stage.environmentLights();
    if (!lights.empty()) ImGui::TextWrapped("%s", lights.c_str());
}

} // namespace

void drawEnvironmentPanel(PanelFrame& frame) {
    DocumentEnvironment& environment = frame.document.environment;
    ImGui::TextWrapped("%s", environment.file.empty() ? "no file: drop a .hdr, .exr or .ktx2 into the window"
                                                      : environment.file.filename().c_str());
    tooltip(environment.file.string());
    if (frame.stage.hasModelEnvironment()) quietText("the model's own lights it");
    ImGui::Checkbox("the model's own comes first", &environment.prefersModels);
    if (!environment.file.empty() && ImGui::Button("remove")) environment.file.clear();
    ImGui::PushItemWidth(-ImGui::GetFontSize() * 9);
    float degrees = environment.settings.rotationRadians * kDegreesOfRadian;
    if (ImGui::SliderFloat("rotation, degrees", &degrees, -180, 180, "%.1f"))
        environment.settings.rotationRadians = degrees / kDegreesOfRadian;
    numberField("illuminance, lx", environment.settings.illuminance.value, 0, kMostLux, true);
    tooltip("what radiance 1 of the picture stands for");
    ImGui::Checkbox("background", &environment.settings.skybox);
    if (!environment.settings.skybox || environment.file.empty())
        ImGui::ColorEdit3("colour", &frame.document.view.clearColor.x,
                          ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR);
    drawSun(frame);
    ImGui::PopItemWidth();
}

} // namespace filament_core::view
