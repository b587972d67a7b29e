// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/CameraModel.h"
#include "tools/view/panels/PanelFrame.h"

#include <fmt/format.h>

#include <imgui_stdlib.h>

#include <cmath>

namespace filament_core::view {
namespace {

void drawLens(Camera& camera) {
    double3 position = camera.position();
    if (vectorField("position, m", position, 0.01f)) camera.worldFromView[3] = double4(position, 1);
    const CameraHeading heading = headingOf(camera);
    quietText(
            fmt::format("looks {:.1f} degrees to the right, {:.1f} upwards", heading.yawDegrees, heading.pitchDegrees));
    if (camera.lens.isOrthographic()) {
        numberField("height, m", camera.lens.orthographicHeight, 1e-3f, 1e4f, true);
        numberField("far plane, m", camera.lens.farMeters, camera.lens.nearMeters * 1.01f + 1e-3f, 1e6f, true);
    } else {
        numberField("view, degrees", camera.lens.verticalFovDegrees, 1, 170);
    }
    numberField("near plane, m", camera.lens.nearMeters, 1e-4f, 100, true);
    ImGui::SliderFloat2("shift", &camera.lens.shift.x, -1, 1, "%.3f");
}

void drawExposure(Exposure& exposure) {
    float ev = exposure.ev100();
    if (ImGui::SliderFloat("exposure value", &ev, -8, 24, "%.2f")) exposure = withEv100(exposure, ev);
    numberField("aperture, f", exposure.aperture, 0.5f, 64);
    float inverse = 1 / exposure.shutterSeconds;
    if (numberField("shutter, 1/s", inverse, 1e-3f, 1e5f, true)) exposure.shutterSeconds = 1 / inverse;
    numberField("sensitivity, ISO", exposure.iso, 1, 1e5f, true);
    quietText(fmt::format("a grey card is metered at {:.6g} lx, {:.4g} cd/m^2", std::round(Exposure::illuminance(ev)),
                          Exposure::luminance(ev)));
}

void drawBookmarks(PanelFrame& frame) {
    if (ImGui::Button("keep this view")) addBookmark(frame.document);
    for (size_t i = 0; i < frame.document.bookmarks.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Button("go")) goToBookmark(frame.document, i);
        ImGui::SameLine();
        if (ImGui::Button("x")) {
            removeBookmark(frame.document, i);
            ImGui::PopID();
            return;
        }
        ImGui::SameLine();
        ImGui::SetNextItemWidth(-FLT_MIN);
        ImGui::InputText("##name", &frame.document.bookmarks[i].name);
        ImGui::PopID();
    }
}

void drawPictureFormat(FrameKind& kind) {
    int chosen = static_cast<int>(kind);
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 16);
    if (ImGui::Combo("of F12", &chosen, "PNG: what is shown\0EXR: light before the tone mapper\0"))
        kind = static_cast<FrameKind>(chosen);
}

void drawFileCameras(PanelFrame& frame) {
    if (!frame.stage.modelCopy()) return;
    const std::vector<CopyCamera> cameras = frame.stage.modelCopy()->cameras();
    for (size_t i = 0; i < cameras.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        if (ImGui::Button("go")) useCamera(frame.document, cameras[i]);
        ImGui::SameLine();
        ImGui::TextUnformatted(cameras[i].name.c_str());
        ImGui::PopID();
    }
    if (cameras.empty()) quietText("the file has no cameras");
}

} // namespace

void drawCameraPanel(PanelFrame& frame) {
    Camera& camera = frame.document.view.camera;
    ImGui::PushItemWidth(-ImGui::GetFontSize() * 12);
    if (ImGui::CollapsingHeader("Lens", ImGuiTreeNodeFlags_DefaultOpen)) drawLens(camera);
    if (ImGui::CollapsingHeader("Exposure", ImGuiTreeNodeFlags_DefaultOpen)) drawExposure(camera.exposure);
    ImGui::PopItemWidth();
    if (ImGui::CollapsingHeader("Bookmarks", ImGuiTreeNodeFlags_DefaultOpen)) drawBookmarks(frame);
    if (ImGui::CollapsingHeader("Saved pictures", ImGuiTreeNodeFlags_DefaultOpen))
        drawPictureFormat(frame.state.pictureKind);
    ImGui::PushID("file");
    if (ImGui::CollapsingHeader("Cameras of the file", ImGuiTreeNodeFlags_DefaultOpen)) drawFileCameras(frame);
    ImGui::PopID();
}

} // namespace filament_core::view
