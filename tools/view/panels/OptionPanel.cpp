// SPDX-License-Identifier: Apache-2.0
#include "tools/view/panels/PanelFrame.h"
#include "tools/view/panels/PanelText.h"
#include "tools/view/panels/SectionModel.h"

#include <filament_core/RenderPreset.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace filament_core::view {
namespace {

/// "-0.31 ms, error 1.2 %" or "".
std::string costText(PanelFrame const& frame, Option const& option, std::string const& current,
                     std::string_view value) {
    if (!isRated(option)) return {};
    const double milliseconds = frame.changes.medianMilliseconds().value_or(frame.history.latestMilliseconds());
    const auto cost = tabledCost(defaultQualityCosts(), frame.stage.engine().device().backend, option.name, current,
                                 value, milliseconds);
    if (!cost) return {};
    const std::string time = milliseconds > 0 ? differenceText(cost->milliseconds) + ", " : std::string();
    return fmt::format("{}error {:.2g} %", time, cost->error * 100);
}

std::string helpOf(PanelFrame const& frame, Option const& option, std::string const& value) {
    std::string text = fmt::format("{}: {}\n{}\ndefault: {}", option.name, rangeOf(option), option.description,
                                   defaultValue(option));
    for (const std::string_view word : option.values) {
        const std::string cost = costText(frame, option, value, word);
        if (!cost.empty()) text += fmt::format("\n{} {}: {}", word == value ? ">" : " ", word, cost);
    }
    if (MeasuredChange const* change = frame.changes.changeOf(option.name))
        text += fmt::format("\nmeasured here, {} frames each: {} to {}: {}", change->frames, change->from, change->to,
                            differenceText(change->milliseconds));
    return text;
}

void drawChoice(PanelFrame& frame, Option const& option, std::string const& value) {
    if (!ImGui::BeginCombo("##value", value.c_str())) return;
    for (const std::string_view word : option.values) {
        const std::string cost = costText(frame, option, value, word);
        const std::string label = cost.empty() ? std::string(word) : fmt::format("{}    {}", word, cost);
        if (ImGui::Selectable(label.c_str(), word == value)) editOption(frame, option, word);
    }
    ImGui::EndCombo();
}

void drawNumbers(PanelFrame& frame, Option const& option, std::string const& value) {
    std::vector<float> numbers = optionNumbers(option, value);
    if (numbers.empty()) return;
    const auto least = static_cast<float>(option.least), most = static_cast<float>(option.most);
    bool isChanged = false;
    if (option.kind == OptionKind::Integer && most - least <= 64) {
        auto whole = static_cast<int>(numbers[0]);
        isChanged = ImGui::SliderInt("##value", &whole, static_cast<int>(least), static_cast<int>(most), "%d",
                                     ImGuiSliderFlags_AlwaysClamp);
        numbers[0] = static_cast<float>(whole);
    } else if (option.components == 1) {
        isChanged = numberField("##value", numbers[0], least, most, most - least > 100);
    } else if (option.components == 3 && matchesFilter(option.name, "color")) {
        isChanged = ImGui::ColorEdit3("##value", numbers.data(), ImGuiColorEditFlags_Float | ImGuiColorEditFlags_HDR);
    } else {
        isChanged = ImGui::DragScalarN("##value", ImGuiDataType_Float, numbers.data(), static_cast<int>(numbers.size()),
                                       0.005f, &least, &most, "%.3g", ImGuiSliderFlags_AlwaysClamp);
    }
    for (float& number : numbers) number = std::clamp(number, least, most);
    if (isChanged) editOption(frame, option, optionText(option, numbers));
}

void drawOptionValue(PanelFrame& frame, Option const& option, std::string const& value) {
    ImGui::SetNextItemWidth(-FLT_MIN);
    switch (option.kind) {
    case OptionKind::Switch: {
        bool isOn = value == "on";
        if (ImGui::Checkbox("##value", &isOn)) editOption(frame, option, isOn ? "on" : "off");
        return;
    }
    case OptionKind::Choice:
        return drawChoice(frame, option, value);
    case OptionKind::Integer:
        return option.onlyValues ? drawChoice(frame, option, value) : drawNumbers(frame, option, value);
    case OptionKind::Number:
        return drawNumbers(frame, option, value);
    }
}

void drawOption(PanelFrame& frame, Option const& option) {
    const std::string value = optionValue(option, &frame.document.view), standard = defaultValue(option);
    const bool isChanged = value != standard;
    ImGui::PushID(option.name.data()); // a literal, as all names
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::AlignTextToFramePadding();
    if (isChanged)
        ImGui::TextColored(kEditedColor, "%s", option.name.data());
    else
        ImGui::TextUnformatted(option.name.data());
    tooltip(ImGui::IsItemHovered() ? helpOf(frame, option, value) : std::string());
    ImGui::TableNextColumn();
    drawOptionValue(frame, option, value);
    ImGui::TableNextColumn();
    if (MeasuredChange const* change = frame.changes.changeOf(option.name))
        quietText(differenceText(change->milliseconds));
    if (isChanged) {
        if (ImGui::SmallButton("x")) editOption(frame, option, standard);
        tooltip("default: " + standard);
    }
    ImGui::PopID();
}

/// Which axis, where on it within what is drawn, and which side stays.
void drawFirstPlane(PanelFrame& frame) {
    const AxisPlane now = axisPlaneOf(frame.document.view.section.planes[0]);
    Box bounds = frame.stage.bounds();
    if (bounds.empty()) bounds = { double3(-1), double3(1) };
    AxisPlane wanted = now;
    ImGui::SetNextItemWidth(ImGui::GetFontSize() * 5);
    if (ImGui::BeginCombo("section", kSectionAxes[static_cast<size_t>(now.axis)])) {
        for (const SectionAxis axis : { SectionAxis::None, SectionAxis::X, SectionAxis::Y, SectionAxis::Z }) {
            const bool isChosen = ImGui::Selectable(kSectionAxes[static_cast<size_t>(axis)], axis == now.axis);
            if (isChosen && axis != now.axis) wanted = throughMiddle(axis, bounds);
        }
        ImGui::EndCombo();
    }
    tooltip("section.plane1: cuts the model at right angles to an axis");
    if (now.axis != SectionAxis::None && now.axis != SectionAxis::Other) {
        const int axis = static_cast<int>(now.axis) - static_cast<int>(SectionAxis::X);
        const double least = bounds.min[axis], most = bounds.max[axis];
        ImGui::SameLine();
        if (ImGui::Button(now.keepsAbove ? "above" : "below")) wanted.keepsAbove = !now.keepsAbove;
        tooltip("the side that stays");
        ImGui::SameLine();
        ImGui::SetNextItemWidth(-FLT_MIN);
        ImGui::SliderScalar("##section place", ImGuiDataType_Double, &wanted.meters, &least, &most, "%.3f m");
    }
    if (wanted != now) setFirstPlane(frame.document, wanted);
}

void drawPresets(PanelFrame& frame) {
    constexpr std::array kPresets{ RenderPreset::Fast, RenderPreset::Balanced, RenderPreset::Fine,
                                   RenderPreset::Cinematic };
    for (const RenderPreset preset : kPresets) {
        if (ImGui::Button(toString(preset))) applyPreset(frame.document.view, preset);
        ImGui::SameLine();
    }
    ImGui::Checkbox("changed only", &frame.state.onlyChangedOptions);
}

/// Whether the group has a row to show.
bool showsOption(PanelFrame const& frame, Option const& option) {
    if (!matchesFilter(option.name, frame.state.optionFilter)) return false;
    return !frame.state.onlyChangedOptions || optionValue(option, &frame.document.view) != defaultValue(option);
}

void drawOptionGroup(PanelFrame& frame, OptionGroup const& group) {
    const auto isShown = [&](Option const* option) { return showsOption(frame, *option); };
    if (std::ranges::none_of(group.options, isShown)) return;
    if (!ImGui::CollapsingHeader(group.title, ImGuiTreeNodeFlags_DefaultOpen)) return;
    if (!ImGui::BeginTable(group.title, 3, ImGuiTableFlags_RowBg)) return;
    ImGui::TableSetupColumn("name", ImGuiTableColumnFlags_WidthStretch, 1.2f);
    ImGui::TableSetupColumn("value", ImGuiTableColumnFlags_WidthStretch, 1);
    ImGui::TableSetupColumn("cost", ImGuiTableColumnFlags_WidthFixed, ImGui::GetFontSize() * 5);
    for (Option const* option : group.options)
        if (isShown(option)) drawOption(frame, *option);
    ImGui::EndTable();
}

} // namespace

void editOption(PanelFrame& frame, Option const& option, std::string_view value) {
    const std::string before = optionValue(option, &frame.document.view);
    if (const Result<void> done = setOption(frame.document.view, option.name, value); !done) {
        frame.state.addMessage(done.error().message);
        return;
    }
    const std::string after = optionValue(option, &frame.document.view);
    if (before != after) frame.changes.changed(option.name, before, after);
}

void drawOptionPanel(PanelFrame& frame) {
    drawPresets(frame);
    filterField("##option filter", frame.state.optionFilter);
    drawFirstPlane(frame);
    if (ImGui::BeginChild("options")) {
        for (OptionGroup const& group : frame.options) drawOptionGroup(frame, group);
    }
    ImGui::EndChild();
}

} // namespace filament_core::view
