// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/PanelFrame.h"
#include "tools/view/panels/PanelText.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace filament_core::view {
namespace {

constexpr std::array kLanes{ TimelineLane::App, TimelineLane::Driver, TimelineLane::Device, TimelineLane::Workers };
constexpr float kLeastBar = 1.5f; // pixels, so that short jobs are seen

ImU32 colorOfFrame(uint64_t frame, TimelineLane lane) {
    const float hue = static_cast<float>(frame * 7 % 12) / 12, value = lane == TimelineLane::App ? 0.75f : 0.6f;
    return ImColor::HSV(hue, 0.55f, value);
}

void drawBar(ImDrawList& list, TimelineBar const& bar, ImVec2 least, ImVec2 most) {
    list.AddRectFilled(least, most, colorOfFrame(bar.frame, bar.lane), 2);
    const ImVec2 text = ImGui::CalcTextSize(bar.name.c_str());
    if (text.x + 4 < most.x - least.x) list.AddText({ least.x + 2, least.y + 1 }, IM_COL32_WHITE, bar.name.c_str());
    if (ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(least, most))
        ImGui::SetTooltip("frame %llu, %s: %s", static_cast<unsigned long long>(bar.frame), bar.name.c_str(),
                          millisecondsText(bar.end - bar.begin).c_str());
}

void drawLanes(Timeline const& timeline) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 origin = ImGui::GetCursorScreenPos();
    const float line = ImGui::GetFontSize(), names = line * 5, height = line * 1.6f;
    const float width = std::max(ImGui::GetContentRegionAvail().x - names, 1.0f);
    for (size_t lane = 0; lane < kLanes.size(); ++lane)
        list.AddText({ origin.x, origin.y + static_cast<float>(lane) * height }, ImGui::GetColorU32(ImGuiCol_Text),
                     toString(kLanes[lane]));
    for (TimelineBar const& bar : timeline.bars) {
        const auto pixel = [&](double milliseconds) {
            return origin.x + names + static_cast<float>(milliseconds / timeline.milliseconds) * width;
        };
        const float top = origin.y + static_cast<float>(bar.lane) * height;
        const float begin = pixel(bar.begin), end = std::max(pixel(bar.end), begin + kLeastBar);
        drawBar(list, bar, { begin, top }, { end, top + height - 2 });
    }
    ImGui::Dummy({ names + width, height * static_cast<float>(kLanes.size()) });
}

/// What is known of every frame without a trace.
void drawFrameLanes(PanelFrame const& frame) {
    const Timeline timeline = timelineOf(frame.history.timings());
    if (timeline.bars.empty()) return quietText("no frame has been timed");
    quietText(fmt::format("{} frames, {}", frame.history.timings().size(), millisecondsText(timeline.milliseconds)));
    drawLanes(timeline);
    ImGui::PushStyleColor(ImGuiCol_Text, kQuietColor);
    ImGui::TextWrapped("The device's passes and the workers' load are lengths, from where their frame began.");
    ImGui::PopStyleColor();
}

} // namespace

void drawTimelinePanel(PanelFrame& frame) {
    ImGui::Checkbox("record jobs", &frame.state.recordsJobs);
    tooltip("what every thread does, job by job: opens the engine again, with a trace.\nWithout it nothing is "
            "recorded, and jobs "
            "cost nothing more.");
    if (frame.state.recordsJobs)
        drawJobTimeline(frame);
    else
        drawFrameLanes(frame);
    ImGui::Separator();
    for (const FrameNumber number :
         { FrameNumber::FrameMilliseconds, FrameNumber::LatencyMilliseconds, FrameNumber::PrepareMilliseconds,
           FrameNumber::RecordMilliseconds, FrameNumber::ReplayMilliseconds })
        quietText(fmt::format("{:8} {}", nameOf(number), millisecondsText(frame.history.latest(number))));
}

} // namespace filament_core::view
