// SPDX-License-Identifier: Apache-2.0
// Which thread ran which job when, in the last frames.
#include "tools/view/panels/JobLanes.h"
#include "tools/view/panels/PanelFrame.h"
#include "tools/view/panels/PanelText.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace filament_core::view {
namespace {

constexpr uint32_t kFramesShown = 3;
constexpr float kLeastPixels = 1.5f; // of a bar
constexpr double kWheelZoom = 0.8;   // for a notch
constexpr uint32_t kHues = 12;

/// The same name has the same colour; stolen jobs are lighter, waits are dark.
ImU32 colorOfJob(JobBar const& bar) {
    if (isWait(bar)) return IM_COL32(55, 55, 55, 255);
    uint32_t hash = 2166136261u; // FNV-1a
    for (const char c : std::string_view(bar.name)) hash = (hash ^ static_cast<unsigned char>(c)) * 16777619u;
    const float hue = static_cast<float>(hash % kHues) / kHues;
    const bool isPhase = bar.kind == JobSpan::Kind::Phase, isStolen = bar.kind == JobSpan::Kind::StolenJob;
    return ImColor::HSV(hue, isPhase ? 0.25f : 0.6f, isStolen ? 0.85f : 0.6f);
}

std::string helpOf(JobLane const& lane, JobBar const& bar) {
    const char* kind = bar.kind == JobSpan::Kind::StolenJob ? "\nmade by another thread" : "";
    const std::string frame = bar.frame >= 0 ? fmt::format(", frame {}", bar.frame) : "";
    return fmt::format("{}: {}{}\n{}{}", bar.name, millisecondsText((bar.end - bar.begin) * 1e3), frame, lane.name,
                       kind);
}

/// Where lanes are on the screen.
struct LanePlace {
    ImVec2 origin{};
    float names = 0, width = 1, row = 1;
    TimeWindow window{};
    bool isHovered = false;

    float pixel(double seconds) const {
        return origin.x + names + static_cast<float>((seconds - window.begin) / window.seconds()) * width;
    }
    double seconds(float pixel) const {
        return window.begin + static_cast<double>((pixel - origin.x - names) / width) * window.seconds();
    }
    double secondsOfPixel() const { return window.seconds() / static_cast<double>(width); }
};

/// Draws one lane; returns its height.
float drawLane(ImDrawList& list, LanePlace const& place, JobLane const& lane, float top) {
    const std::string lost = lane.lost > 0 ? fmt::format(", {} lost", lane.lost) : std::string();
    const std::string name = fmt::format("{:3.0f} % {}{}", busyShare(lane, place.window) * 100, lane.name, lost);
    list.PushClipRect({ place.origin.x, top }, { place.origin.x + place.names - 4, top + place.row * 2 }, true);
    list.AddText({ place.origin.x, top }, ImGui::GetColorU32(ImGuiCol_Text), name.c_str());
    list.PopClipRect();
    const double least = place.secondsOfPixel() * static_cast<double>(kLeastPixels);
    for (JobBar const& bar : visibleBars(lane, place.window, least)) {
        const float begin = place.pixel(bar.begin), end = std::max(place.pixel(bar.end), begin + kLeastPixels);
        const float up = top + static_cast<float>(bar.row) * place.row, down = up + place.row - 1;
        list.AddRectFilled({ begin, up }, { end, down }, colorOfJob(bar));
        if (ImGui::CalcTextSize(bar.name).x + 4 < end - begin)
            list.AddText({ begin + 2, up }, IM_COL32_WHITE, bar.name);
        if (place.isHovered && ImGui::IsMouseHoveringRect({ begin, up }, { end, down }))
            ImGui::SetTooltip("%s", helpOf(lane, bar).c_str());
    }
    return static_cast<float>(lane.rows) * place.row + place.row * 0.4f;
}

TimeWindow shownWindow(PanelState const& state, JobLanes const& jobs) {
    return state.jobWindow ? *state.jobWindow : newestFrames(jobs, kFramesShown);
}

float heightOf(JobLanes const& lanes, float row) {
    float height = 0;
    for (JobLane const& lane : lanes.lanes) height += static_cast<float>(lane.rows) * row + row * 0.4f;
    return height;
}

/// The wheel looks closer, a drag moves, a double click shows the newest frames again. Of the last item.
void followMouse(PanelState& state, LanePlace const& place, TimeWindow const& whole) {
    ImGuiIO const& io = ImGui::GetIO();
    if (place.isHovered && io.MouseWheel != 0)
        state.jobWindow = zoomed(place.window, place.seconds(io.MousePos.x),
                                 std::pow(kWheelZoom, static_cast<double>(io.MouseWheel)), whole);
    if (ImGui::IsItemActive() && io.MouseDelta.x != 0)
        state.jobWindow = panned(place.window, -static_cast<double>(io.MouseDelta.x) * place.secondsOfPixel(), whole);
    if (place.isHovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) state.jobWindow.reset();
}

void drawLanes(PanelState& state, JobLanes const& jobs, TimeWindow const& window) {
    const float line = ImGui::GetFontSize();
    LanePlace place{ .origin = ImGui::GetCursorScreenPos(), .names = line * 10, .row = line * 1.2f };
    place.width = std::max(ImGui::GetContentRegionAvail().x - place.names, 1.0f);
    place.window = window;
    if (!(window.seconds() > 0)) return;
    const ImVec2 size{ place.names + place.width, heightOf(jobs, place.row) };
    ImGui::InvisibleButton("lanes", size);
    place.isHovered = ImGui::IsItemHovered();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(place.origin, { place.origin.x + size.x, place.origin.y + size.y }, true);
    float top = place.origin.y;
    for (JobLane const& lane : jobs.lanes) top += drawLane(list, place, lane, top);
    list.PopClipRect();
    followMouse(state, place, jobs.whole);
}

} // namespace

void drawJobTimeline(PanelFrame& frame) {
    PanelState& state = frame.state;
    frame.requests.readsJobs = !state.holdsJobs;
    ImGui::SameLine();
    ImGui::Checkbox("hold", &state.holdsJobs);
    tooltip("stays with the frames that are shown");
    JobLanes const& jobs = frame.inputs.jobs;
    if (jobs.isEmpty()) return quietText("nothing has been recorded yet");
    const TimeWindow window = shownWindow(state, jobs);
    ImGui::PushTextWrapPos(0);
    quietText(fmt::format("{} of {}; the wheel looks closer, a drag moves, a double click shows the newest {} frames",
                          millisecondsText(window.seconds() * 1e3), millisecondsText(jobs.whole.seconds() * 1e3),
                          kFramesShown));
    ImGui::PopTextWrapPos();
    constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoScrollWithMouse; // the wheel looks closer
    if (ImGui::BeginChild("job lanes", { 0, ImGui::GetContentRegionAvail().y * 0.7f }, false, kFlags))
        drawLanes(state, jobs, window);
    ImGui::EndChild();
}

} // namespace filament_core::view
