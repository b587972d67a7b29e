// SPDX-License-Identifier: Apache-2.0
#include "tools/view/camera/PathSampling.h"
#include "tools/view/panels/PanelFrame.h"
#include "tools/view/panels/PathModel.h"

#include <fmt/format.h>

#include <imgui_stdlib.h>

namespace filament_core::view {
namespace {

constexpr float kLongestClosing = 600; // seconds

void drawPathChoice(PanelFrame& frame) {
    PathState& state = frame.state.path;
    ImGui::SetNextItemWidth(-ImGui::GetFontSize() * 7);
    if (ImGui::BeginCombo("##path", frame.document.paths[state.path].name.c_str())) {
        for (size_t i = 0; i < frame.document.paths.size(); ++i) {
            ImGui::PushID(static_cast<int>(i));
            if (ImGui::Selectable(frame.document.paths[i].name.c_str(), i == state.path)) state = { .path = i };
            ImGui::PopID();
        }
        ImGui::EndCombo();
    }
    ImGui::SameLine();
    if (ImGui::Button("new")) addPath(frame.document, state);
    ImGui::SameLine();
    if (ImGui::Button("delete")) removePath(frame.document, state);
}

/// Returns false once the list of keys has changed: the others are drawn in the next frame.
bool drawKey(PanelFrame& frame, CameraPath& path, size_t key) {
    PathState& state = frame.state.path;
    const double first = path.keys.front().seconds;
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    if (ImGui::Selectable(fmt::format("{}", key + 1).c_str(), state.key == key)) selectKey(frame.document, state, key);
    ImGui::TableNextColumn();
    ImGui::SetNextItemWidth(-FLT_MIN);
    auto seconds = static_cast<float>(path.keys[key].seconds - first);
    if (ImGui::DragFloat("##seconds", &seconds, 0.02f, 0, 0, "%.2f s"))
        retimeKey(path, key, first + static_cast<double>(seconds));
    ImGui::TableNextColumn();
    int places = 0;
    if (ImGui::ArrowButton("up", ImGuiDir_Up)) places = -1;
    ImGui::SameLine();
    if (ImGui::ArrowButton("down", ImGuiDir_Down)) places = 1;
    ImGui::SameLine();
    const bool isRemoved = ImGui::Button("x");
    if (places != 0) moveKey(path, state, key, places);
    if (isRemoved) removeKey(path, state, key);
    return places == 0 && !isRemoved;
}

void drawKeys(PanelFrame& frame, CameraPath& path) {
    const float height = ImGui::GetFontSize() * 14;
    if (!ImGui::BeginTable("keys", 3, ImGuiTableFlags_SizingStretchProp | ImGuiTableFlags_ScrollY, { 0, height }))
        return;
    ImGui::TableSetupColumn("key", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFontSize() * 2);
    ImGui::TableSetupColumn("time");
    ImGui::TableSetupColumn("edit", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFontSize() * 6);
    bool isSame = true;
    for (size_t i = 0; isSame && i < path.keys.size(); ++i) {
        ImGui::TableNextRow();
        ImGui::PushID(static_cast<int>(i));
        isSame = drawKey(frame, path, i);
        ImGui::PopID();
    }
    ImGui::EndTable();
}

void drawKeyButtons(PanelFrame& frame, CameraPath& path) {
    PathState& state = frame.state.path;
    if (ImGui::Button("add this view")) addKey(path, state, frame.document.view.camera);
    tooltip("a key after the selected one, half-way to the next; without one 2 s after the last");
    if (state.key) {
        ImGui::SameLine();
        if (ImGui::Button("change to this view")) replaceKey(path, state, frame.document.view.camera);
    }
    ImGui::Checkbox("closed", &path.isClosed);
    tooltip("goes on from the last key to the first one");
    if (!path.isClosed) return;
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 6);
    auto seconds = static_cast<float>(path.closingSeconds);
    if (ImGui::DragFloat("s to the first", &seconds, 0.02f, 0.01f, kLongestClosing, "%.2f",
                         ImGuiSliderFlags_AlwaysClamp))
        path.closingSeconds = static_cast<double>(seconds);
}

void drawTime(PanelFrame& frame, CameraPath const& path) {
    PathState& state = frame.state.path;
    const double duration = durationOf(path);
    if (!(duration > 0)) return quietText("a motion needs two keys");
    if (ImGui::Button(state.isPlaying ? "stop" : "play")) togglePathPlaying(frame.document, state);
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-FLT_MIN);
    auto seconds = static_cast<float>(state.seconds);
    const std::string format = fmt::format("%.2f of {:.2f} s", duration);
    if (ImGui::SliderFloat("##time", &seconds, 0, static_cast<float>(duration), format.c_str(),
                           ImGuiSliderFlags_AlwaysClamp))
        scrubPath(frame.document, state, static_cast<double>(seconds));
}

void drawRecordingProgress(PanelFrame& frame) {
    auto const& [isRunning, done, total] = frame.inputs.recording;
    const float share = total > 0 ? static_cast<float>(done) / static_cast<float>(total) : 0.0f;
    ImGui::ProgressBar(share, { -ImGui::GetFontSize() * 5, 0 }, fmt::format("{} of {} frames", done, total).c_str());
    ImGui::SameLine();
    if (ImGui::Button("cancel")) frame.requests.stopsRecording = true;
}

void drawRecording(PanelFrame& frame) {
    if (frame.inputs.recording.isRunning) return drawRecordingProgress(frame);
    RecordingSettings& state = frame.state.recording;
    int kind = static_cast<int>(state.kind);
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 9);
    if (ImGui::Combo("##kind", &kind, "PNG\0EXR\0video\0")) state.kind = static_cast<FrameKind>(kind);
    tooltip("EXR is light before the tone mapper; a video needs the ffmpeg command");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 5);
    ImGui::DragInt("frames/s", &state.framesPerSecond, 0.2f, 1, 240, "%d", ImGuiSliderFlags_AlwaysClamp);
    if (ImGui::Button("record")) frame.requests.recordsPath = true;
}

void drawFileButtons(PanelFrame& frame) {
    FileDialog& dialog = frame.fileDialog;
    if (!frame.document.paths.empty()) {
        if (ImGui::Button("save ...")) dialog.open(FilePurpose::SavePath, "camera-path.json");
        ImGui::SameLine();
    }
    if (ImGui::Button("load ...")) dialog.open(FilePurpose::OpenPath);
}

} // namespace

void drawPathPanel(PanelFrame& frame) {
    drawFileButtons(frame);
    if (frame.document.paths.empty()) {
        ImGui::SameLine();
        if (ImGui::Button("new")) addPath(frame.document, frame.state.path);
        quietText("a path is a list of views that a camera passes");
        return;
    }
    shownPath(frame.document, frame.state.path);
    drawPathChoice(frame);
    if (frame.document.paths.empty()) return; // the last one was deleted
    CameraPath& path = shownPath(frame.document, frame.state.path);
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::InputTextWithHint("##name", "name", &path.name);
    drawKeys(frame, path);
    drawKeyButtons(frame, path);
    ImGui::Separator();
    drawTime(frame, path);
    ImGui::Separator();
    if (durationOf(path) > 0) drawRecording(frame);
}

} // namespace filament_core::view
