// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/PanelFrame.h"
#include "tools/view/panels/PanelText.h"

#include <fmt/format.h>

#include <algorithm>

namespace filament_core::view {
namespace {

std::string valueText(FrameNumber number, float value) {
    const std::string unit = unitOf(number);
    return unit.empty() ? fmt::format("{:.0f}", value) : fmt::format("{:.4g} {}", value, unit);
}

void drawHistory(FrameHistory const& history, FrameNumber number) {
    const std::span<const float> values = history.values(number);
    if (values.empty()) return;
    const auto [least, most] = std::ranges::minmax(values);
    const std::string label = fmt::format("{}: {}  ({} to {})", nameOf(number), valueText(number, values.back()),
                                          valueText(number, least), valueText(number, most));
    ImGui::PushID(static_cast<int>(number));
    ImGui::PlotLines("##plot", values.data(), static_cast<int>(values.size()), 0, label.c_str(), 0,
                     most > 0 ? most * 1.25f : 1.0f, { ImGui::GetContentRegionAvail().x, ImGui::GetFontSize() * 3 });
    ImGui::PopID();
}

void drawLatency(LatencyMeter const& latency) {
    const Percentiles input = latency.milliseconds(), inFlight = latency.inFlight();
    if (input.count == 0) return quietText("input to window: no input yet");
    quietText(fmt::format("input to window: median {}, p95 {}", millisecondsText(input.median),
                          millisecondsText(input.p95)));
    quietText(fmt::format("frames in flight: median {:.0f}, p95 {:.0f}", inFlight.median, inFlight.p95));
    const std::vector<float> values = latency.history();
    const std::string label = fmt::format("input to window, last {} inputs", input.count);
    ImGui::PlotLines("##latency", values.data(), static_cast<int>(values.size()), 0, label.c_str(), 0,
                     static_cast<float>(input.worst) * 1.25f,
                     { ImGui::GetContentRegionAvail().x, ImGui::GetFontSize() * 3 });
}

} // namespace

void drawStatisticsPanel(PanelFrame& frame) {
    const EngineStatistics statistics = frame.stage.engine().statistics();
    DeviceDescription const& device = frame.stage.engine().device();
    ImGui::TextWrapped("%s: %s", toString(device.backend), device.device.c_str());
    quietText(fmt::format("{} pipelines, {} programs; {} on the device", statistics.pipelinesCreated,
                          statistics.programsCreated, bytesText(statistics.deviceBytes)));
    const std::string waited = millisecondsText(statistics.latency.backPressureMedian);
    quietText(fmt::format("waited {} for the driver thread", waited.empty() ? "not" : waited));
    drawLatency(frame.latency);
    if (ImGui::BeginChild("plots"))
        for (uint8_t i = 0; i < static_cast<uint8_t>(FrameNumber::Count); ++i)
            drawHistory(frame.history, static_cast<FrameNumber>(i));
    ImGui::EndChild();
}

void drawMessagePanel(PanelFrame& frame) {
    if (frame.state.messages.empty()) return quietText("nothing to say");
    if (ImGui::Button("clear")) frame.state.messages.clear();
    if (ImGui::BeginChild("messages"))
        for (size_t i = frame.state.messages.size(); i-- > 0;)
            ImGui::TextWrapped("%s", frame.state.messages[i].c_str());
    ImGui::EndChild();
}

} // namespace filament_core::view
